#!/usr/bin/env python3
"""What skins cost: a crowd of figures whose vertices follow up to four bones each, beside its rigid twin, whose joints
have the faces of which most corners follow them, and the same crowd blended by dual quaternions.

Both draw whole frames in turn, and so does Mesa's llvmpipe, which bends the figures in its vertex shader; from the
order to the composed frame; all figures bend in each. Printed are milliseconds a frame, best and middle, and ratios of
the best. It fails if llvmpipe's picture is another."""
import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "peers"))
import pictures  # noqa: E402
from competitor import Competitor, Trouble  # noqa: E402

WARMING = 3
MOST_RMS = 1.0  # of 255, between ours and llvmpipe's picture
LLVMPIPE_SAMPLES = [1, 4]
BONES = 18     # of a figure
HEIGHT = 3.0   # of a figure, in units
RADIUS = 0.3


def rings_of(triangles):
    """Rings and vertices a ring of a tube of about `triangles` triangles."""
    around = max(6, round(math.sqrt(triangles / 4)))
    return max(2, round(triangles / (2 * around))), around


def weights_at(height):
    """[bone, weight, ...] of a place along the figure, 0 to 1."""
    place = height * BONES - 0.5
    pairs = []
    for bone in range(max(0, math.floor(place) - 1), min(BONES - 1, math.floor(place) + 2) + 1):
        share = max(0.0, 1 - abs(place - bone) / 1.6) ** 2
        if share > 0:
            pairs += [bone, round(share, 6)]
    return pairs


def tube(triangles):
    """Vertices in the unit cube, their bones, faces of three corners."""
    rings, around = rings_of(triangles)
    vertices, bones, faces = [], [], []
    for ring in range(rings + 1):
        height = ring / rings
        thick = 0.5 * (0.55 + 0.45 * abs(math.sin(9 * height)))
        for k in range(around):
            turn = 2 * math.pi * k / around
            vertices.append([round(0.5 + thick * f(turn), 6) for f in (math.cos, math.sin)] + [round(height, 6)])
            bones.append(weights_at(height))
    for ring in range(rings):
        for k in range(around):
            a, b = ring * around + k, ring * around + (k + 1) % around
            faces += [[a, b, b + around], [a, b + around, a + around]]
    return vertices, bones, faces


def joints():
    part = HEIGHT / BONES
    return [{"name": f"bone{bone}", "place": [0, 0, part if bone else 0],
             **({"parent": f"bone{bone - 1}"} if bone else {})} for bone in range(BONES)]


def box_of(low, high):
    return {"sbb": [[-RADIUS, -RADIUS, low * HEIGHT], [RADIUS, RADIUS, high * HEIGHT]], "material": "cloth"}


def skinned(triangles):
    vertices, bones, faces = tube(triangles)
    all_joints = joints()
    all_joints[0]["segment"] = {"shape": "body", "skin": {"joints": [joint["name"] for joint in all_joints]},
                                **box_of(0, 1)}
    mesh = {"vertices": vertices, "faces": faces, "bones": bones, "crease": 180}
    return {"joints": all_joints, "shapes": {"body": {"mesh": mesh}}}


def heaviest(pairs):
    return max(zip(pairs[1::2], pairs[::2]))[1]


def rigid(triangles):
    vertices, bones, faces = tube(triangles)
    of_bone = [[] for _ in range(BONES)]
    for face in faces:
        followed = [heaviest(bones[corner]) for corner in face]
        of_bone[statistics.multimode(followed)[0]].append(face)
    all_joints, shapes = joints(), {}
    for bone, own in enumerate(of_bone):
        used = sorted({corner for face in own for corner in face})
        number = {corner: i for i, corner in enumerate(used)}
        low, high = (f(vertices[corner][2] for corner in used) for f in (min, max))
        places = [vertices[corner][:2] + [round((vertices[corner][2] - low) / (high - low), 6)] for corner in used]
        shapes[f"part{bone}"] = {"mesh": {"vertices": places, "crease": 180,
                                          "faces": [[number[corner] for corner in face] for face in own]}}
        all_joints[bone]["segment"] = {"shape": f"part{bone}", **box_of(low - bone / BONES, high - bone / BONES)}
    return {"joints": all_joints, "shapes": shapes}


def dual(triangles):
    """The skinned figure, blended by dual quaternions."""
    model = skinned(triangles)
    for joint in model["joints"]:
        if "skin" in joint.get("segment", {}):
            joint["segment"]["skin"]["blend"] = "dual-quaternions"
    return model


def film(model, figures, size, frames, samples):
    """Figures on a square, each bending another way."""
    side = math.ceil(math.sqrt(figures))
    actors = []
    for number in range(figures):
        place = [1.4 * (number % side - (side - 1) / 2), 1.4 * (number // side - (side - 1) / 2), 0]
        keys = [{"frame": frame, "pose": {f"bone{bone}": [9 * math.sin(number + frame), 9 * math.cos(2 * number + frame), 4]
                                          for bone in range(1, BONES)}} for frame in range(0, frames + 8, 8)]
        keys = [key for key in keys if key["frame"] < frames]
        actors.append({"name": f"figure{number}", "model": "figure", "place": place, "keys": keys})
    far = 1.25 * side
    return {"frames": frames, "size": size, "samples": samples, "color": "coded", "background": [0.7, 0.8, 0.9],
            "camera": {"eye": [0, -2.1 * far, 1.1 * far], "at": [0, 0, 1.1], "fov": 40},
            "lights": [{"direction": [0.4, -0.7, 0.8], "intensity": 0.9}],
            "materials": {"cloth": {"color": [0.75, 0.5, 0.3], "sides": 1, "exponent": 32}},
            "models": {"figure": model}, "actors": actors}


class Heat:
    """All competitors on `column` processors. `folder`: for their files."""

    def __init__(self, wanted, column, folder):
        self.wanted, self.column, self.folder = wanted, column, folder
        self.processors = sorted(os.sched_getaffinity(0))[:column]
        self.competitors = []

    def program(self, name):
        return os.path.join(self.wanted.build, "bench", "peers", name)

    def begin(self, name, command):
        self.competitors.append(Competitor(name, command, self.processors, os.path.join(self.folder, name + ".log")))

    def begin_all(self):
        wanted = self.wanted
        for name, make in (("skinned", skinned), ("rigid", rigid), ("dual", dual)):
            path = os.path.join(self.folder, name + ".json")
            with open(path, "w") as file:
                json.dump(film(make(wanted.triangles), wanted.figures, wanted.size, WARMING + wanted.rounds + 1,
                               wanted.samples), file)
            self.begin(name, [self.program("bench-ours-threads"), path, "whole", str(self.column)])
        peer = self.program("peer-llvmpipe-crowd")
        if not os.path.exists(peer) or wanted.samples not in LLVMPIPE_SAMPLES:
            return
        crowd = os.path.join(self.folder, "crowd")
        subprocess.run([self.program("bench-crowd"), os.path.join(self.folder, "skinned.json"), crowd], check=True)
        # Mesa's main thread prepares what its others draw: which number is best differs.
        for threads in self.column - 1, self.column:
            self.begin(f"llvmpipe {threads}", [peer, crowd, str(threads), str(wanted.samples)])

    def run(self):
        """Milliseconds of each round, by competitor."""
        for competitor in self.competitors:
            competitor.wait_ready()
        for number in range(WARMING + self.wanted.rounds):
            for competitor in self.competitors:
                taken = competitor.go(1)
                if number >= WARMING:
                    competitor.milliseconds.append(taken)
        self.check_alike()
        return {competitor.name: competitor.milliseconds for competitor in self.competitors}

    def check_alike(self):
        files = {}
        for competitor in self.competitors:
            files[competitor.name] = os.path.join(self.folder, competitor.name.replace(" ", "-") + ".ppm")
            competitor.picture(files[competitor.name])
        for name, file in files.items():
            if name.startswith("llvmpipe") and (rms := pictures.rms(files["skinned"], file)) > MOST_RMS:
                raise Trouble(f"the picture of {name} differs from ours by {rms:.2f} of 255, more than {MOST_RMS}")

    def end(self):
        for competitor in self.competitors:
            competitor.end()


def measure(wanted, column):
    with tempfile.TemporaryDirectory() as folder:
        heat = Heat(wanted, column, folder)
        try:
            heat.begin_all()
            return heat.run()
        finally:
            heat.end()


def line_of(column, times):
    text = ", ".join(f"{name} {min(ms):.1f} ({statistics.median(ms):.1f})" for name, ms in times.items())
    best = {name: min(ms) for name, ms in times.items()}
    text += f"; skinned / rigid {best['skinned'] / best['rigid']:.2f}, dual / skinned {best['dual'] / best['skinned']:.2f}"
    peers = [ms for name, ms in best.items() if name.startswith("llvmpipe")]
    if peers:
        text += f", llvmpipe / skinned {min(peers) / best['skinned']:.2f}"
    return f"{column} processor{'s' if column > 1 else ''}: {text}"


def read_command_line():
    parser = argparse.ArgumentParser(prog="mars bench skins", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--figures", default=100, type=int)
    parser.add_argument("--triangles", default=10000, type=int, help="of each figure, about")
    parser.add_argument("--size", default=[1920, 1080], type=lambda text: [int(n) for n in text.split("x")],
                        help="of the pictures, as 1920x1080")
    parser.add_argument("--samples", default=1, type=int, help="a pixel")
    parser.add_argument("--rounds", default=15, type=int)
    parser.add_argument("--columns", default="1,2" if os.cpu_count() > 1 else "1",
                        type=lambda text: [int(n) for n in text.split(",")], help="numbers of processors")
    parser.add_argument("-o", dest="output", metavar="FILE", type=argparse.FileType("w"), help="what was measured, as JSON")
    return parser.parse_args()


def main():
    wanted = read_command_line()
    rings, around = rings_of(wanted.triangles)
    print(f"{wanted.figures} figures of {2 * rings * around} triangles and {BONES} bones, ms a frame: best (middle)")
    results = {}
    for column in wanted.columns:
        results[column] = measure(wanted, column)
        print(line_of(column, results[column]), flush=True)
    if wanted.output:
        with wanted.output as file:
            json.dump(results, file, indent=1)


if __name__ == "__main__":
    try:
        main()
    except Trouble as trouble:
        sys.exit(f"mars bench skins: {trouble}")
