#!/usr/bin/env python3
"""How near pictures of 1, 2, 4, 8 and 16 samples a pixel come to a reference, and
whether edges crawl.

The reference has 16 samples in each of 4 x 4 pixels for one, averaged as light.
Printed is the root of the mean square difference of the encoded levels, of 255,
at the first, the middle and the last frame, beside Embree's where the film is a
measuring scene. The fan turns by a fraction of a pixel a frame: printed is by
how much its mean light varies over all frames. README.md beside this program
tells more. It fails if the demo at 16 samples is too far from its reference."""
import argparse
import copy
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "peers"))
import films  # noqa: E402

FINER = 4                    # reference pixels along a pixel's side
MOST_RMS = {("demo", 16): 1.5}  # of 255, at 960x540
SCENES = ["s1", "s1m", "s2", "s3"]
DICED = ["demo", "visit", "meadow", "teapot"]
PENUMBRA_FRAMES = 6
FINEST = 256                 # quads along a patch's side
MOST_BY_DICING = 0.05        # of 255, that adaptive dicing may add with several samples


class Trouble(Exception):
    """Something that ends the benchmark; its text is for a person."""


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise Trouble(done.stderr.strip())
    return done.stdout


class Film:
    """A film of the examples. `folder`: for what is made of it."""

    def __init__(self, build, name, size, folder, path=None):
        self.build, self.name, self.size, self.folder = build, name, size, folder
        self.path = path or os.path.join(films.EXAMPLES, name + ".json")
        if name in SCENES:
            self.path = films.save(films.load(name), os.path.join(folder, name + ".json"))
        with open(self.path) as file:
            film = json.load(file)
        self.count = film["frames"]
        self.color = film.get("color", "linear")

    def diced(self, rate=None):
        """The same film with rate x rate quads a patch, or as finely as before. No light casts shadows: 65,536 quads
        would take long."""
        with open(self.path) as file:
            film = films.without_shadows(json.load(file))
        film["models"] = {name: os.path.join(films.EXAMPLES, model) if isinstance(model, str) else model
                          for name, model in film["models"].items()}
        other = copy.copy(self)
        other.name = f"{self.name}-{rate or 'adaptive'}"
        other.path = films.save({**film, "dice": rate} if rate else film, os.path.join(self.folder, other.name + ".json"))
        return other

    def shown(self):
        return sorted({0, self.count // 2, self.count - 1})

    def program(self, name):
        return os.path.join(self.build, "bench", name)

    def render(self, samples, frames, finer=1):
        """The picture of each frame."""
        folder = os.path.join(self.folder, f"{self.name}-{samples}-{finer}")
        width, height = (side * finer for side in self.size)
        run([os.path.join(self.build, "bin", "mars"), "render", self.path, "--backend", "threads", "--quiet", "-o", folder,
             "--samples", str(samples), "--size", f"{width}x{height}", "--frames", ",".join(map(str, frames)),
             "--overwrite"])
        return [os.path.join(folder, f"frame-{frame:04}.png") for frame in frames]

    def references(self, frames):
        pictures = self.render(16, frames, FINER)
        for picture in pictures:
            run([self.program("quality/bench-pictures"), "shrink", str(FINER), self.color, picture, picture])
        return pictures

    def embree(self, samples, frames):
        """As render(); nothing where Embree cannot draw this film."""
        program = self.program("peers/peer-embree")
        if self.name not in SCENES or not os.path.exists(program):
            return []
        film = os.path.join(self.folder, "sized.json")
        films.save(films.load(self.name, self.size), film)
        mesh, prefix = os.path.join(self.folder, "mesh"), os.path.join(self.folder, f"embree-{samples}")
        run([self.program("peers/bench-mesh"), film, mesh])
        pictures, orders = [f"{prefix}-{frame}.ppm" for frame in frames], []
        for before, frame, picture in zip([-1] + frames, frames, pictures):
            orders += [f"go {frame - before}", f"picture {picture}"]
        run([program, mesh, "1", "whole", str(samples), "none"], input="\n".join(orders) + "\n")
        return pictures

    def rms(self, pictures, references):
        return [float(run([self.program("quality/bench-pictures"), "rms", *pair])) for pair in zip(pictures, references)]

    def lights(self, samples):
        """The mean light of every frame."""
        pictures = self.render(samples, range(self.count))
        return [float(line) for line in run([self.program("quality/bench-pictures"), "light", *pictures]).split()]


def measure(film, samples):
    """For MARS and Embree, by samples and frame, the distance to the reference."""
    frames = film.shown()
    references = film.references(frames)
    ours = {s: film.rms(film.render(s, frames), references) for s in samples}
    embrees = {s: film.rms(film.embree(s, frames), references) for s in samples}
    return {"film": film.name, "frames": frames, "MARS": ours, "Embree": embrees}


def measure_dicing(film, samples):
    """By samples, the distance of adaptively and of finely diced pictures to a finely diced reference."""
    plain, fine, frames = film.diced(), film.diced(FINEST), [film.count // 2]
    references = fine.references(frames)
    return {s: [one.rms(one.render(s, frames), references)[0] for one in (plain, fine)] for s in samples}


def print_dicing(build, size, names, samples, folder):
    """Whether adaptive dicing is as good as it must be with several samples."""
    print(f"RMS of 255: adaptive dicing, {FINEST} x {FINEST} quads a patch")
    good = True
    for name in names:
        for s, (adaptive, fine) in measure_dicing(Film(build, name, size, folder), samples).items():
            print(f"  {name}, {s} samples".ljust(27) + f"{adaptive:8.3f}{fine:8.3f}", flush=True)
            good &= s == 1 or adaptive - fine <= MOST_BY_DICING
    if not good:
        raise Trouble(f"adaptive dicing adds more than {MOST_BY_DICING} with several samples")


def penumbra_film(wide):
    """A bar over a floor that is seen from above, whose shadow has a penumbra `wide` pixels wide at 960x540, and moves by
    0.4 pixels a frame."""
    def box(low, high):
        return {"joints": [{"name": "box", "segment": {"shape": "box", "sbb": [low, high], "material": "white"}}]}

    return {
        "frames": PENUMBRA_FRAMES, "size": [960, 540], "camera": {"eye": [0, -0.01, 40], "at": [0, 0, 0], "fov": 12},
        "lights": [{"direction": [0.6, 0.2, 1], "shadow": True, "size": 14.25 * wide / 64}],
        "materials": {"white": {"color": [1, 1, 1], "ambient": 0.1, "diffuse": 0.9, "specular": 0}},
        "models": {"floor": box([-30, -30, -1], [30, 30, 0]), "bar": box([-1.5, -30, 0], [1.5, 30, 0.1])},
        "actors": [{"name": "floor", "model": "floor"},
                   {"name": "bar", "model": "bar",
                    "keys": [{"frame": 0, "place": [0, 0, 4], "turn": [0, 0, 7]},
                             {"frame": PENUMBRA_FRAMES - 1, "place": [0.0062 * (PENUMBRA_FRAMES - 1), 0, 4],
                              "turn": [0, 0, 7]}]}]}


def print_penumbra(build, size, samples, folder):
    """How grainy a penumbra is, and how much more it changes from frame to frame than the reference does."""
    print("penumbra, RMS of 255".ljust(28) + "".join(f"{s:>8}" for s in samples) + "  samples")
    for wide in 16, 64:
        path = films.save(penumbra_film(wide), os.path.join(folder, f"penumbra-{wide}.json"))
        film = Film(build, f"penumbra-{wide}", size, folder, path)
        frames = range(PENUMBRA_FRAMES)
        references = film.references(frames)
        pictures = {s: film.render(s, frames) for s in samples}
        grain = [max(film.rms(pictures[s], references)) for s in samples]
        due = film.rms(references[1:], references)
        flicker = [max(film.rms(pictures[s][1:], pictures[s])) for s in samples]
        print(f"  {wide} pixels: from reference".ljust(28) + "".join(f"{rms:8.2f}" for rms in grain))
        print("    from frame to frame".ljust(28) + "".join(f"{rms:8.2f}" for rms in flicker) +
              f"  (reference {max(due):.2f})", flush=True)


def variation(lights):
    """Greatest less least, in parts of the mean."""
    return (max(lights) - min(lights)) * len(lights) / sum(lights)


def print_distances(result):
    samples = list(result["MARS"])
    print(f"\n{result['film']}, RMS of 255".ljust(28) + "".join(f"{s:>8}" for s in samples) + "  samples")
    for name in "MARS", "Embree":
        for k, frame in enumerate(result["frames"]):
            if all(result[name].values()):
                print(f"  {name}, frame {frame}".ljust(27) + "".join(f"{result[name][s][k]:8.2f}" for s in samples))
    sys.stdout.flush()


def print_variation(build, size, samples, folder):
    fan = Film(build, "fan", size, folder)
    print(f"\nfan's light, {fan.count} frames".ljust(28) + "".join(f"{s:>8}" for s in samples) + "  samples")
    print("  varies by".ljust(27) + "".join(f"{100 * variation(fan.lights(s)):7.2f}%" for s in samples))


def check(result):
    for samples, distances in result["MARS"].items():
        most = MOST_RMS.get((result["film"], samples))
        if most and max(distances) >= most:
            raise Trouble(f"{result['film']} with {samples} samples differs from its reference by {max(distances):.2f} of "
                          f"255; less than {most} is wanted")


def read_command_line():
    def names(text):
        return text.split(",")

    def numbers(text):
        return [int(n) for n in text.split(",")]

    def size(text):
        return [int(n) for n in text.split("x")]

    parser = argparse.ArgumentParser(prog="mars bench quality", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--dicing", action="store_true",
                        help=f"compare adaptive dicing with {FINEST} x {FINEST} quads a patch instead; takes minutes")
    parser.add_argument("--penumbra", action="store_true",
                        help="measure the grain of penumbras 16 and 64 pixels wide, and how much it moves, instead")
    parser.add_argument("--films", type=names, help="of the examples (demo,s1,s3; with --dicing " + ",".join(DICED) + ")")
    parser.add_argument("--samples", type=numbers, help="(1,2,4,8,16; with --dicing 1,4,16)")
    parser.add_argument("--size", default="960x540", type=size, help="of the pictures")
    return parser.parse_args()


def main():
    wanted = read_command_line()
    results = []
    with tempfile.TemporaryDirectory() as folder:
        if wanted.dicing:
            return print_dicing(wanted.build, wanted.size, wanted.films or DICED, wanted.samples or [1, 4, 16], folder)
        samples = wanted.samples or [1, 2, 4, 8, 16]
        if wanted.penumbra:
            return print_penumbra(wanted.build, wanted.size, samples, folder)
        for name in wanted.films or ["demo", "s1", "s3"]:
            results.append(measure(Film(wanted.build, name, wanted.size, folder), samples))
            print_distances(results[-1])
        print_variation(wanted.build, wanted.size, samples, folder)
    for result in results:
        check(result)


if __name__ == "__main__":
    try:
        main()
    except Trouble as trouble:
        sys.exit(f"mars bench quality: {trouble}")
