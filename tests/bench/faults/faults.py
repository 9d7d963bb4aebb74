#!/usr/bin/env python3
"""mars bench faults: makes every fault one at a time while 8 nodes render a film on
a virtual cluster (cluster/testbed, as root), and measures what MARS does: seconds
until it is reported and until nodes draw again, frames lost and drawn twice.

Each result is written to DIR/results.json at once, and replaces an older one of the
same fault there. DIR/table.md is the table of docs/decisions/faults.md. The exit code is
1 if a frame was lost, pixels are wrong, or something was left running."""
import argparse
import json
import os
import pathlib
import signal
import sys
import tempfile

import film
import table
import wall
from cluster import Cluster
from disk import Disk
from kinds import KINDS
from rendering import frames_in
from scene import Scene, alone, copy_programs

FRAMES, DICE = 408, 96
MOST = 240       # seconds until a film has ended after its fault
SETTLED = 60     # seconds until nothing runs any more
DISK = 400       # megabytes
WALL = "wall"    # no fault, but the wall time with one


def arguments():
    names = [*(kind.name for kind in KINDS), WALL]
    parser = argparse.ArgumentParser(prog="mars bench faults", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--only", metavar="A,B", default=",".join(names), help="default: %(default)s")
    parser.add_argument("-o", dest="output", type=pathlib.Path, default=pathlib.Path("faults"),
                        help="folder for results.json, table.md and mars's lines; default: faults")
    wanted = parser.parse_args()
    unknown = set(wanted.only.split(",")) - set(names)
    if unknown:
        parser.error(f"no such fault: {', '.join(sorted(unknown))}")
    wanted.kinds = [kind for kind in KINDS if kind.name in wanted.only.split(",")]
    wanted.trouble = False  # a fault could not be made
    wanted.wall = WALL in wanted.only.split(",")
    return wanted


class Bench:
    def __init__(self, wanted, folder, cluster, disk):
        self.wanted, self.folder, self.cluster, self.disk = wanted, folder, cluster, disk
        self.programs = copy_programs(wanted.build, folder / "bin")
        self.film = film.write_film(folder / "film.json", FRAMES, dice=DICE)
        self.pixels, seconds = alone(self.programs, wanted.build, self.film, folder)
        print(f"the film: {FRAMES} frames, by threads in {seconds:.1f} s, pixels {self.pixels}", flush=True)

    def scene(self, film_file, frames):
        return Scene(self.cluster, self.disk, self.folder, self.programs, film_file, frames)

    def measure_wall(self):
        measured = wall.measure(self.scene, self.folder, DICE)
        (self.wanted.output / "wall.json").write_text(json.dumps(measured, indent=1) + "\n")
        print(wall.text(measured), flush=True)

    def measure(self, kind):
        scene = self.scene(self.film, FRAMES)
        scene.plan = kind.plan
        plan = self.programs / "plan"
        if kind.plan:
            plan.write_text(kind.plan + "\n")
        scene.begin(kind.words, kind.batch)
        try:
            if not kind.plan:
                scene.wait_for_frames(int(FRAMES * kind.part))
            kind.make(scene)
            code = scene.wait(MOST)
            plan.unlink(missing_ok=True)
            last = scene.start_again(MOST) if kind.again else code
        finally:
            plan.unlink(missing_ok=True)
            scene.undo(float("inf"))
            for undo in scene.at_end:
                undo()
            scene.watch.end()
        return self.result(kind, scene, code, last)

    def result(self, kind, scene, code, last):
        left, settled = self.cluster.wait_until_idle(SETTLED)
        line = scene.first_line(kind.says) if kind.says else None
        wrong = list(self.wrong(kind, scene, code, last, left, line))
        self.cluster.end_what_is_left()
        self.keep_lines(kind, scene)
        return {"name": kind.name, "title": kind.title, "how": kind.how,
                "reported": line[0] - scene.since if line else None, "line": line[1] if line else None,
                "again": scene.drawing_again(), "goes_on": kind.goes_on, "lost": FRAMES - len(frames_in(scene.out)),
                "twice": scene.drawn_twice(), "codes": [code, last], "settled": settled, "wrong": wrong}

    def wrong(self, kind, scene, code, last, left, line):
        if code != kind.code:
            yield f"mars ended with {code}, not {kind.code}"
        if last != 0:
            yield f"the film did not end well: {last}"
        if kind.says and line is None:
            yield "it was not reported"
        if (pixels := scene.pixels()) != self.pixels:
            yield f"other pixels: {pixels}"
        if left:
            yield "still running: " + ", ".join(f"{process.program} on {process.host}" for process in left)
        for host, names in scene.files_left().items():
            yield f"files left on {host}: {', '.join(names)}"

    def keep_lines(self, kind, scene):
        with open(self.wanted.output / f"{kind.name}.log", "w") as file:
            for each in scene.renderings:
                print(f"--- started {each.began - scene.since:.1f}", file=file)
                for when, line in each.lines:
                    print(f"{when - scene.since:8.1f}  {line}", file=file)


def keep(results, path, order):
    known = {each["name"]: each for each in json.loads(path.read_text())} if path.exists() else {}
    known.update((each["name"], each) for each in results)
    kept = [known[name] for name in order if name in known]
    path.write_text(json.dumps(kept, indent=1) + "\n")
    return kept


def show(result):
    print(f"{result['title']}: reported after {table.seconds(result['reported'])}, drawing again after "
          f"{table.seconds(result['again'])}, lost {result['lost']}, drawn twice {result['twice']}"
          + "".join(f"\n    WRONG: {wrong}" for wrong in result["wrong"]), flush=True)


def measure_all(wanted, folder):
    environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}
    with Disk(folder / "disk.img", folder / "disk", DISK) as disk, \
            Cluster(os.environ.get("TESTBED", f"faults-{os.getpid()}"), environment) as cluster:
        bench = Bench(wanted, folder, cluster, disk)
        results = []
        for kind in wanted.kinds:
            try:
                results.append(bench.measure(kind))
                show(results[-1])
            except RuntimeError as trouble:
                print(f"{kind.title}: could not be made: {trouble}", flush=True)
                cluster.end_what_is_left()
                wanted.trouble = True
            keep(results, wanted.output / "results.json", [each.name for each in KINDS])
            if kind.new_cluster:
                cluster.testbed("down")
                cluster.up()
        if wanted.wall:
            bench.measure_wall()
    return results


def main():
    wanted = arguments()
    if os.geteuid() != 0:
        sys.exit("mars bench faults: needs root: it makes a virtual cluster")
    wanted.build = wanted.build.resolve()
    wanted.output.mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("mars bench faults: stopped"))
    with tempfile.TemporaryDirectory(prefix="mars-faults-", dir="/var/tmp", ignore_cleanup_errors=True) as folder:
        results = measure_all(wanted, pathlib.Path(folder))
    text = table.markdown(keep(results, wanted.output / "results.json", [kind.name for kind in KINDS]))
    (wanted.output / "table.md").write_text(text + "\n")
    print("\n" + text)
    return 1 if wanted.trouble or any(result["wrong"] for result in results) else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("mars bench faults: stopped")
