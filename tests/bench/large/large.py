#!/usr/bin/env python3
"""mars bench large: the film of 10^7 polygons at 3840x2160 on simulated machines
of 16 to 4096 nodes.

Each run is appended to a file of JSON lines, and none that is there is made
again. The table and the picture are of all runs in the file: for each platform
and number of nodes the groups that took the least time.

With --walls no run is simulated: three films are counted exactly, and forecast
for 1 to 4096 nodes, with what binds. The table and the picture of that are
walls.md and walls.svg.

Half the film on 1024 nodes takes 10 GB of memory. --nodes 16,64 --size half
--platforms fat-tree takes minutes.
"""
import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import film
import platforms
import walls
from curve import best_runs, draw, table
from figures import figures_of


def arguments():
    parser = argparse.ArgumentParser(prog="mars bench large", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--nodes", default="16,64,256,1024,4096",
                        help="with --walls: from 1 to the most (default: %(default)s)")
    parser.add_argument("--platforms", default="fat-tree,dragonfly,ethernet", help="default: %(default)s")
    parser.add_argument("--groups", help="numbers to try (default: some for each number of nodes)")
    parser.add_argument("--writers", default="host,nodes", help="who writes the frames (default: %(default)s)")
    parser.add_argument("--size", choices=film.SIZES, default="whole",
                        help="of the film; half has a quarter of polygons and pixels (default: %(default)s)")
    parser.add_argument("--frames", help="only these, as for mars render")
    parser.add_argument("--walls", action="store_true", help="what binds three films on 1 to 4096 nodes")
    parser.add_argument("--films", default=",".join(walls.FILMS), help="with --walls (default: %(default)s)")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("large"),
                        help="folder for runs.jsonl, curve.svg and table.md (default: %(default)s)")
    return parser.parse_args()


def groups_to_try(nodes, intervals):
    """Divisors of the intervals keep groups busy alike. With files of the host any number does."""
    fitting = [n for n in (intervals, intervals // 2, intervals // 4) if n <= nodes // 4]
    return fitting[:2] or [max(1, nodes // 4)]


def simulate(bin_folder, film_file, platform, writer, nodes, groups, frames):
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        command = [bin_folder / "mars-simulated", film_file, "--sink", "none", "--write", writer, "--platform", platform,
                   "--nodes", str(nodes), "--groups", str(groups), "--report", report.name]
        if frames:
            command += ["--frames", frames]
        before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        run = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if run.returncode:
            sys.exit(f"{nodes} nodes in {groups} groups: {run.stderr.strip()[-400:]}")
        cost = {"wall": time.monotonic() - began, "most_bytes": after.ru_maxrss * 1024,
                "processor": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime}
        return json.loads(pathlib.Path(report.name).read_text()), cost


def known_runs(path):
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def main():
    options = arguments()
    size = film.SIZES[options.size]
    options.output.mkdir(parents=True, exist_ok=True)
    if options.walls:
        walls.run(options.build / "bin" / "mars", options.output, options.films.split(","),
                  options.platforms.split(","), max(map(int, options.nodes.split(","))),
                  lambda path: film.write_film(path, size))
        return
    runs_file = options.output / "runs.jsonl"
    film_file = options.output / f"{options.size}.json"
    film.write_film(film_file, size)
    runs = known_runs(runs_file)
    for name in options.platforms.split(","):
        for writer in options.writers.split(","):
            platform = platforms.platform_of(options.build, name)
            for nodes in map(int, options.nodes.split(",")):
                tries = map(int, options.groups.split(",")) if options.groups else groups_to_try(nodes, size.intervals)
                for groups in tries:
                    key = {"platform": name, "writer": writer, "nodes": nodes, "groups": groups,
                           "frames": options.frames or "all", "size": options.size, "costs": platform}
                    if any(all(run[part] == key[part] for part in key) for run in runs):
                        continue
                    report, cost = simulate(options.build / "bin", film_file, name, writer, nodes, groups,
                                            options.frames)
                    runs.append({**key, **figures_of(report, platform, nodes, size), "cost": cost})
                    with runs_file.open("a") as out:
                        out.write(json.dumps(runs[-1]) + "\n")
                    print(f"{name}, {writer} writes, {nodes} nodes, {groups} groups: "
                          f"{runs[-1]['film_seconds']:.3f} s", flush=True)
    best = best_runs(runs)
    (options.output / "table.md").write_text(table(best))
    draw(best, options.output / "curve.svg")
    print(table(best))


if __name__ == "__main__":
    main()
