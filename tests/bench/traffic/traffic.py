#!/usr/bin/env python3
"""What a node sends in a keyframe: messages, those without a byte, and bytes, to nodes and to the host.
tests/bench/traffic/README.md says what is counted and how."""
import argparse
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "peers"))
import films  # noqa: E402
import messages_sent  # noqa: E402
import shadow_traffic  # noqa: E402

ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
KEYFRAMES = 2  # counted in each run, beside the first


class Film:
    """A scene with one keyframe, and with KEYFRAMES more."""

    def __init__(self, scene, folder, size=None):
        film = films.load(scene, size)
        self.whole = not films.turning(film)
        frames = 1 if self.whole else films.INTERVAL
        save = lambda times: films.save(films.lengthened(film, times * frames),
                                        os.path.join(folder, f"{scene}-{times}.json"))
        self.short, self.long = save(1), save(1 + KEYFRAMES)
        self.about = "a keyframe" if self.whole else f"a keyframe and its {frames - 1} inbetweens"


def on_threads(build, film, nodes, each):
    program = os.path.join(build, "bench", "traffic", "bench-traffic")
    count = lambda path: messages_sent.counted(program, path, nodes, each, "whole" if film.whole else "all")
    return messages_sent.in_between(count(film.short), count(film.long), KEYFRAMES)


def by_trace(build, film, nodes, backend, folder):
    def trace(film_path):
        path = os.path.join(folder, "trace.json")
        words = [os.path.join(build, "bin", "mars"), "render", film_path, "--backend", backend, "--nodes", str(nodes),
                 "--groups", "1", "--sink", "none", "--quiet", "--trace", path] + ["--no-coherence"] * film.whole
        subprocess.run(words, check=True, env={**os.environ, **ROOT})
        return messages_sent.traced(path)
    return messages_sent.in_between(trace(film.short), trace(film.long), KEYFRAMES)


def builds_of(wanted):
    """The other build first: before, after."""
    others = {wanted.against: wanted.against} if wanted.against else {}
    return {**others, "this build": wanted.build}


def layouts(wanted):
    """Numbers of nodes, in all and on each machine; each pair once."""
    on_each = lambda nodes, each: nodes if each == "all" else min(int(each), nodes)
    return dict.fromkeys((nodes, on_each(nodes, each)) for each in wanted.each for nodes in wanted.nodes)


def measure(scene, wanted, folder):
    film, builds = Film(scene, folder), builds_of(wanted)
    for nodes, each in layouts(wanted):
        where = "on one machine" if each == nodes else f"{each} on each machine"
        messages_sent.show(f"{scene}, {film.about}, {nodes} nodes, {where}, a node:",
                           {name: on_threads(build, film, nodes, each) for name, build in builds.items()}, nodes)
    for nodes in wanted.mpi:
        messages_sent.show(f"{scene}, {film.about}, {nodes} nodes, MPI on one machine, a node:",
                           {name: by_trace(build, film, nodes, "mpi", folder) for name, build in builds.items()}, nodes)


def main():
    parser = argparse.ArgumentParser(prog="mars bench traffic", description=__doc__)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--against", metavar="BUILD", help="the folder of another build, to be counted beside this one")
    parser.add_argument("--scenes", nargs="+", default=["s1", "s2"], choices=["s1", "s1m", "s2", "s3"],
                        help="default: s1 s2")
    parser.add_argument("--nodes", type=int, nargs="+", default=[16, 64, 256], help="default: 16 64 256")
    parser.add_argument("--each", nargs="+", default=["1", "4", "all"], help="nodes on each machine; default: 1 4 all")
    parser.add_argument("--mpi", type=int, nargs="+", default=[], metavar="NODES",
                        help="also this many nodes as MPI processes of this machine, by their trace")
    parser.add_argument("--shadows", action="store_true",
                        help="instead: what shadows add to s3s and demo")
    parser.add_argument("--size", default="480x270", help="of pictures with --shadows; default: 480x270")
    wanted = parser.parse_args()
    if wanted.shadows:
        with tempfile.TemporaryDirectory() as folder:
            return shadow_traffic.show(wanted.build, wanted.nodes, [int(side) for side in wanted.size.split("x")], folder)
    with tempfile.TemporaryDirectory() as folder:
        for scene in wanted.scenes:
            measure(scene, wanted, folder)


if __name__ == "__main__":
    sys.exit(main())
