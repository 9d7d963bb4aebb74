#!/usr/bin/env python3
"""mars bench soak: a film that is rendered on a virtual cluster (cluster/testbed, as
root) by 16 nodes on 4 hosts while faults are made at random, 20 seconds apart on
average and 60 after a cut. If mars itself is killed, it is started again; nothing
else is done for the film.

In the end all frames must be there with the pixels of an undisturbed rendering by
threads; no process, no file in /tmp and /dev/shm of a host may be left, and no
program's memory or descriptors may have grown. The exit code is 1 otherwise.

The same seed makes the same faults, but what they hit depends on time."""
import argparse
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "faults"))
import film  # noqa: E402
from cluster import Cluster  # noqa: E402
from disturbances import AFTER_CUT, EVERY, KINDS, Disturber  # noqa: E402
from growth import Samples  # noqa: E402
from rendering import Rendering, frames_in  # noqa: E402

NODES = 16
DICE = 192            # much work for few pixels: small files
FRAME_BYTES = 120000  # of a frame's file, at most
TRIED = 96            # frames whose time says how many take the minutes asked for
AGAIN = 3             # seconds until a mars that could not begin is started again
SLOWEST = 6           # times as long as undisturbed, and the film is given up
SETTLED = 60          # seconds in which everything must have ended


def arguments():
    parser = argparse.ArgumentParser(prog="mars bench soak", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--minutes", type=float, default=15, help="that the film takes undisturbed; default: 15")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6),
                        help="default: chosen, printed")
    parser.add_argument("--faults", metavar="A,B", default=",".join(KINDS), help="default: %(default)s")
    parser.add_argument("--every", type=float, default=EVERY, help="seconds between faults on average; default: 20")
    parser.add_argument("-o", dest="output", type=pathlib.Path, default=pathlib.Path("soak"),
                        help="folder for report.json, report.txt and mars's lines; default: soak")
    wanted = parser.parse_args()
    wanted.kinds = wanted.faults.split(",")
    if not set(wanted.kinds) <= set(KINDS):
        parser.error(f"--faults takes {', '.join(KINDS)}")
    if wanted.minutes <= 0 or wanted.every <= 0:
        parser.error("--minutes and --every are above 0")
    return wanted


def say(text):
    print(f"{time.strftime('%H:%M:%S')}  {text}", flush=True)


class Soak:
    def __init__(self, wanted, cluster, folder):
        self.wanted, self.cluster, self.folder = wanted, cluster, folder
        self.out = folder / "disk" / "film"
        self.samples = Samples(cluster)
        self.log = open(wanted.output / "mars.log", "w")
        self.report = {"seed": wanted.seed, "minutes": wanted.minutes, "kinds": wanted.kinds, "faults": [],
                       "starts": []}

    def mars(self, *words):
        """A command of mars that must end well, beside the cluster."""
        done = subprocess.run([self.cluster.mars, *map(str, words)], env=self.cluster.environment,
                              capture_output=True, text=True, cwd=self.folder)
        if done.returncode != 0:
            raise RuntimeError(f"mars {words[0]} failed: {done.stderr.strip()}")
        return done.stdout

    def render_words(self, *more):
        return [self.cluster.mars, "render", self.film, "--hostfile", self.cluster.folder / "hostfile", "--nodes",
                NODES, "--groups", 2, *more]

    # ---- before

    def prepare(self):
        """The film of the length asked for, and its undisturbed pixels."""
        self.film = film.write_film(self.folder / "film.json", TRIED, dice=DICE)
        trial = Rendering(self.cluster, self.render_words("--sink", "none"), folder=self.folder)
        if trial.wait(600) != 0:
            raise RuntimeError(f"the undisturbed trial failed:\n{trial.text()}")
        seconds = float(re.findall(r"([\d.]+) seconds", trial.text())[-1])
        intervals = max(4, round(self.wanted.minutes * 60 / seconds * TRIED / film.INTERVAL))
        self.frames = intervals * film.INTERVAL
        film.write_film(self.film, self.frames, dice=DICE)
        say(f"{TRIED} frames took {seconds:.1f} s: the film has {self.frames}; now its undisturbed pixels, by threads")
        began = time.monotonic()
        self.mars("render", self.film, "-o", "alone", "--backend", "threads", "--nodes", NODES, "--quiet")
        self.report.update(frames=self.frames, threads_seconds=time.monotonic() - began,
                           undisturbed_hash=self.hash_of("alone"), undisturbed_seconds=seconds * self.frames / TRIED)
        shutil.rmtree(self.folder / "alone")

    def hash_of(self, folder):
        return self.mars("verify", folder).split()[-1]

    # ---- the film

    def run(self):
        self.began = time.monotonic()
        self.random = random.Random(self.wanted.seed)
        self.disturber = Disturber(self.cluster, self.out, self.random)
        self.undoing, self.kind, self.rendering, self.killed = [], None, None, -1e9
        self.plan_next(0)
        sampled = shown = 0
        while not self.is_over():
            now = time.monotonic()
            self.undo(now)
            if now >= self.next:
                self.disturb(now)
            if now - sampled > 5:
                self.samples.take()
                sampled = now
            if now - shown > 10:
                self.show()
                shown = now
            time.sleep(0.1)
        self.undo(float("inf"))
        self.report["seconds"] = time.monotonic() - self.began

    def is_over(self):
        """Starts mars where none runs, until one ends well."""
        if self.rendering is None:
            self.start()
        elif self.rendering.code is not None:
            self.rendering.wait(5)
            self.note_end()
            if self.rendering.code == 0:
                return True
            time.sleep(AGAIN)
            self.start()
        if time.monotonic() - self.began > SLOWEST * max(60, self.report["undisturbed_seconds"]):
            say("given up: it takes too long")
            return True
        return False

    def start(self):
        self.rendering = Rendering(self.cluster, self.render_words("-o", self.out), folder=self.folder)

    def note_end(self):
        """A mars that was killed is no failure, and a start soon afterwards may find the old job still at work."""
        lines, code = self.rendering.text(), self.rendering.code
        began, ended = (seconds - self.began for seconds in (self.rendering.began, time.monotonic()))
        claimed = "another run" in lines and self.rendering.began - self.killed < 120
        killed = self.killed >= self.rendering.began
        how = "well" if code == 0 else "killed" if killed else "claimed" if claimed else "failed"
        self.report["starts"].append({"began": began, "ended": ended, "code": code, "how": how,
                                      "last": lines.splitlines()[-3:]})
        print(f"--- start at {began:.1f} s, ended at {ended:.1f} s with {code} ({how})\n{lines}", file=self.log,
              flush=True)
        say(f"mars ended with {code} ({how})" + ("" if how == "well" else ": " + " / ".join(lines.splitlines()[-1:])))

    # ---- faults

    def plan_next(self, least):
        self.next = time.monotonic() + max(least, self.random.expovariate(1 / self.wanted.every))

    def disturb(self, now):
        """What finds nothing to hit is tried again a moment later."""
        self.kind = self.kind or self.random.choice(self.wanted.kinds)
        fault = self.disturber.make(self.kind)
        if fault is None:
            self.next = now + 0.5
            return
        if self.kind == "kill-mars":
            self.killed = now
        if fault.undo:
            self.undoing.append((now + fault.lasts, fault))
        self.report["faults"].append({"seconds": now - self.began, "kind": self.kind, "what": fault.what,
                                      "lasts": fault.lasts, "frames": len(frames_in(self.out))})
        say(fault.what + (f" for {fault.lasts:.0f} s" if fault.undo else ""))
        self.plan_next(AFTER_CUT if self.kind == "cut" else 0)
        self.kind = None

    def undo(self, now):
        for each in [each for each in self.undoing if each[0] <= now]:
            self.undoing.remove(each)
            self.disturber.undo(each[1])
            say("over: " + each[1].what)

    def show(self):
        said = [line for _, line in self.rendering.lines[-1:]]
        say(f"{len(frames_in(self.out))} of {self.frames} frames after {time.monotonic() - self.began:.0f} s; "
            f"mars: {' '.join(said)[:100]}")

    # ---- after

    def judge(self, files_before):
        left, seconds = self.cluster.wait_until_idle(SETTLED)
        files = self.cluster.own_files()
        grown_files = {host: sorted(set(files[host]) - set(files_before[host])) for host in files}
        report = self.report
        report.update(
            frames_there=len(frames_in(self.out)), hash=self.final_hash(), settled_seconds=seconds,
            processes_left=[f"{process.program} {process.number} on {process.host}" for process in left],
            files_left={host: names for host, names in grown_files.items() if names},
            in_folder=sorted(name for name in os.listdir(self.out) if not name.startswith("frame-")),
            growth=self.samples.growth())
        report["wrong"] = list(self.wrong(report))

    def final_hash(self):
        try:
            return self.hash_of(self.out)
        except RuntimeError as wrong:
            return str(wrong)

    @staticmethod
    def wrong(report):
        if report["frames_there"] != report["frames"]:
            yield f"{report['frames'] - report['frames_there']} frames are missing"
        if report["hash"] != report["undisturbed_hash"]:
            yield f"other pixels than undisturbed: {report['hash']}"
        for start in report["starts"]:
            if start["how"] == "failed":
                yield f"mars ended with {start['code']} after {start['ended']:.0f} s: {' / '.join(start['last'][-1:])}"
        if report["starts"] and report["starts"][-1]["how"] != "well":
            yield "no mars ended well"
        if report["processes_left"]:
            yield f"still running: {', '.join(report['processes_left'])}"
        for host, names in report["files_left"].items():
            yield f"files left on {host}: {', '.join(names)}"
        for name in report["in_folder"]:
            if name not in ("frames.json", "film.mars"):
                yield f"left in the film's folder: {name}"
        for program, growth in report["growth"].items():
            if growth["grew"]:
                yield f"{program} grew: memory {growth['memory_kb']} kB, descriptors {growth['descriptors']}"


def summary(report):
    kinds = {}
    for fault in report["faults"]:
        kinds[fault["kind"]] = kinds.get(fault["kind"], 0) + 1
    lines = [f"seed {report['seed']}: {report['frames']} frames in {report['seconds']:.0f} s with "
             f"{len(report['faults'])} faults; undisturbed {report['undisturbed_seconds']:.0f} s",
             "faults: " + ", ".join(f"{kind} {count}" for kind, count in sorted(kinds.items())),
             f"mars was started {len(report['starts'])} times; everything had ended {report['settled_seconds']:.1f} s "
             "after its end"]
    lines += [f"{program}: memory {growth['memory_kb'][0]:.0f} to {growth['memory_kb'][1]:.0f} kB, descriptors "
              f"{growth['descriptors'][0]:.0f} to {growth['descriptors'][1]:.0f}"
              for program, growth in sorted(report["growth"].items())]
    lines += [f"WRONG: {wrong}" for wrong in report["wrong"]] or [f"all frames, the same pixels: {report['hash']}"]
    return "\n".join(lines)


def mount(place, megabytes):
    place.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "tmpfs", place], check=True)


def main():
    wanted = arguments()
    if os.geteuid() != 0:
        sys.exit("mars bench soak: needs root: it makes a virtual cluster")
    wanted.output.mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("mars bench soak: stopped"))
    say(f"seed {wanted.seed}")
    folder = pathlib.Path(tempfile.mkdtemp(prefix="mars-soak-", dir="/var/tmp"))
    mount(folder / "disk", 2048)
    try:
        bin_folder = wanted.build.resolve() / "bin"
        environment = {**os.environ, "PATH": f"{bin_folder}:{os.environ['PATH']}"}
        with Cluster(os.environ.get("TESTBED", f"soak-{os.getpid()}"), environment) as cluster:
            cluster.mars = bin_folder / "mars"
            soak = Soak(wanted, cluster, folder)
            soak.prepare()
            files = cluster.own_files()
            soak.run()
            soak.judge(files)
            cluster.end_what_is_left()
    finally:
        subprocess.run(["umount", "--lazy", folder / "disk"], check=False)
        shutil.rmtree(folder, ignore_errors=True)
    (wanted.output / "report.json").write_text(json.dumps(soak.report, indent=1) + "\n")
    (wanted.output / "report.txt").write_text(summary(soak.report) + "\n")
    print(summary(soak.report))
    return 1 if soak.report["wrong"] else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("mars bench soak: stopped")
