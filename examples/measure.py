#!/usr/bin/env python3
"""Milliseconds a frame of the measuring scenes s1, s1m, s2, s3, rendering alone (no files written).

usage: measure.py BINARIES [--nodes 1,2] [--backend mpi|threads] [--culled] [--frames N]

Whole frames: every frame from scratch, one group; the time between one frame's arrival in the host's memory and
the next one's. s3's inbetweens: a node's own time for one. Printed: the best and, in brackets, the middle.
docs/measuring.md says what these figures mean."""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

EXAMPLES = os.path.dirname(os.path.abspath(__file__))


def load(name, culled, frames):
    """The scene with as many frames as wanted, its one-sided twin where culled."""
    with open(os.path.join(EXAMPLES, name + ".json")) as file:
        film = json.load(file)
    film["frames"] = max(frames, film["frames"])
    if culled:
        for material in film["materials"].values():
            material["sides"] = 1
    return film


def render(binaries, backend, nodes, film, folder, *options):
    scene, report = os.path.join(folder, "scene.json"), os.path.join(folder, "report.json")
    with open(scene, "w") as file:
        json.dump(film, file)
    subprocess.run([os.path.join(binaries, "mars"), "render", scene, "--backend", backend, "--nodes", str(nodes),
                    "--sink", "none", "--quiet", "--groups", "1", "--report", report, *options], check=True)
    with open(report) as file:
        return json.load(file)


def whole_frames(report):
    arrivals = sorted(frame["seconds"] for frame in report["frames"])
    return [b - a for a, b in zip(arrivals[2:], arrivals[3:])]


def inbetweens(report):
    own = [frame for frame in report["frames"] if frame["kind"] == "inbetween"]
    return [sum(seconds for step, seconds in frame["nodes"][0]["seconds"].items() if step != "credit")
            for frame in own[2:]]


def milliseconds(times):
    return f"{1000 * min(times):6.1f} ({1000 * statistics.median(times):.1f})"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries")
    parser.add_argument("--nodes", default="1,2")
    parser.add_argument("--backend", default="mpi")
    parser.add_argument("--culled", action="store_true", help="back faces dropped, as the peers do")
    parser.add_argument("--frames", type=int, default=16)
    wanted = parser.parse_args()
    counts = [int(n) for n in wanted.nodes.split(",")]
    print("ms a frame, best (middle)".ljust(28) + "".join(f"{n} node{'s' if n > 1 else ''}".rjust(18) for n in counts))
    with tempfile.TemporaryDirectory() as folder:
        for scene in ("s1", "s1m", "s2", "s3"):
            film = load(scene, wanted.culled, wanted.frames)
            row = [whole_frames(render(wanted.binaries, wanted.backend, n, film, folder, "--no-coherence"))
                   for n in counts]
            print((scene + ", from scratch").ljust(28) + "".join(milliseconds(t).rjust(18) for t in row), flush=True)
        row = [render(wanted.binaries, wanted.backend, n, load("s3", wanted.culled, 30), folder) for n in counts]
        print("s3, an inbetween's own time".ljust(28) + "".join(milliseconds(inbetweens(r)).rjust(18) for r in row))
        film_time = [max(f["seconds"] for f in r["frames"]) for r in row]
        print("s3, the film / its frames".ljust(28) + "".join(f"{1000 * t / 30:.1f}".rjust(18) for t in film_time))


if __name__ == "__main__":
    sys.exit(main())
