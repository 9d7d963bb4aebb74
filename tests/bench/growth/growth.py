#!/usr/bin/env python3
"""Whether a frame's time grows as its work does and no faster: s2 with 1, 4 and 16
times its triangles, and at heights from 540 to 4320 lines. Printed: the best
frame's time in the node's steps, the straight line through all (t = a + b x, of
least relative squares), and how far the times lie off it."""
import argparse
import json
import os
import subprocess
import sys
import tempfile

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "examples")
STEPS = ("dice", "fill", "scanline")
MILLION = 1e6


def scene(dice, height, frames):
    with open(os.path.join(EXAMPLES, "s2.json")) as file:
        film = json.load(file)
    for material in film["materials"].values():
        material["sides"] = 1
    film.update(dice=dice, size=[height * 16 // 9, height], frames=frames)
    return film


def best_frame(mars, film, folder):
    """Seconds by step and work counts of the node's quickest frame."""
    path, report = os.path.join(folder, "film.json"), os.path.join(folder, "report.json")
    with open(path, "w") as file:
        json.dump(film, file)
    subprocess.run([mars, "render", path, "--backend", "threads", "--nodes", "1", "--sink", "none", "--quiet",
                    "--no-coherence", "--report", report], check=True)
    with open(report) as file:
        frames = json.load(file)["frames"]
    nodes = [frame["nodes"][0] for frame in frames[1:]]
    return min(nodes, key=lambda node: sum(node["seconds"][step] for step in STEPS))


def line_through(xs, ts):
    """a, b of t = a + b x with the least sum of squared relative errors."""
    weights = [1 / (t * t) for t in ts]
    sum_of = lambda values: sum(w * v for w, v in zip(weights, values))
    s, sx, st = sum_of([1] * len(xs)), sum_of(xs), sum_of(ts)
    sxx, sxt = sum_of([x * x for x in xs]), sum_of([x * t for x, t in zip(xs, ts)])
    b = (s * sxt - sx * st) / (s * sxx - sx * sx)
    return (st - b * sx) / s, b


def show(title, unit, xs, nodes):
    times = [1000 * sum(node["seconds"][step] for step in STEPS) for node in nodes]
    a, b = line_through(xs, times)
    print(f"{title}\n  {unit:>22} {'ms':>8} " + " ".join(f"{step:>9}" for step in STEPS) + "  off the line  memory")
    for x, t, node in zip(xs, times, nodes):
        steps = " ".join(f"{1000 * node['seconds'][step]:9.1f}" for step in STEPS)
        off = 100 * (t / (a + b * x) - 1)
        print(f"  {x:22.2f} {t:8.1f} {steps} {off:12.1f} % {node['work']['memory'] / MILLION:7.0f} MB")
    print(f"  t = {a:.1f} ms + {b:.2f} ms x\n", flush=True)


def main():
    parser = argparse.ArgumentParser(prog="mars bench growth", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--frames", type=int, default=8, help="rendered of each; the best counts")
    wanted = parser.parse_args()
    mars = os.path.join(wanted.build, "bin", "mars")
    with tempfile.TemporaryDirectory() as folder:
        finer = [best_frame(mars, scene(dice, 1080, wanted.frames), folder) for dice in (16, 32, 64)]
        larger = [best_frame(mars, scene(16, height, wanted.frames), folder) for height in (540, 1080, 2160, 4320)]
    show("s2 at 1080 lines, its quads in 1, 4 and 16", "million triangles", [1.6384, 6.5536, 26.2144], finer)
    show("s2 of 540 to 4320 lines", "million pixels shown", [node["work"]["pixels"] / MILLION for node in larger], larger)


if __name__ == "__main__":
    sys.exit(main())
