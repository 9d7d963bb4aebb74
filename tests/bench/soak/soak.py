#!/usr/bin/env python3
"""mars bench soak: a film is rendered into one folder while faults are made at random:
processes of the job killed and stopped, whenever it starts, draws or ends; files of
the folder damaged; the film edited and put back; on a virtual cluster
(cluster/testbed, as root; 16 nodes on 4 hosts) also links cut and slowed and the
disk filled. With --here this machine alone renders it, and anybody may do so.

If mars itself is killed, the same command is given again, as a person would. If the
film is there before all faults were made, some of its frames are taken away and the
same command goes on. At the end that command is given once more, undisturbed, and
what a run does not notice, damage in finished frames, `mars verify` must find and
`mars verify --repair` mend.

Then all frames must be there with the pixels of an undisturbed rendering by
threads; no process and no temporary file may be left, and no process's own memory
or descriptors may have grown. The exit code is 1 otherwise.

The same seed makes the same faults, but what they hit depends on time."""
import argparse
import contextlib
import json
import os
import pathlib
import random
import re
import resource
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
from damage import Source, take_away  # noqa: E402
from disturbances import ON_A_CLUSTER, Disturber  # noqa: E402
from growth import Samples  # noqa: E402
from one_machine import OneMachine  # noqa: E402
from plan import END, NOW, SHARES, START, plan  # noqa: E402
from rendering import Rendering, frames_in  # noqa: E402
from report import summary, wrong  # noqa: E402
from schedule import Schedule  # noqa: E402

NODES = {True: 4, False: 16}  # on one machine, on a cluster
DICE = 96             # much work for few pixels: small files
RESTARTS = 100        # of mars without a new frame: faults may be closer than a job's start is long
PERIOD = 0.03         # seconds between two looks
AGAIN = 1             # seconds until mars is started again
TAKEN = (0.2, 0.8)    # of the frames, for another round
LAST_ROUNDS = 12      # frames, where only faults at a job's end are left to make
FAILURES = 8          # of mars, which nothing explains, in a row, and the film is given up
SLOWEST = 5           # times as long as faults and film should take, and the film is given up
VERIFIED = 300        # seconds that a look at the whole folder may take
SETTLED = 60          # seconds in which everything must have ended


def arguments():
    parser = argparse.ArgumentParser(prog="mars bench soak", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--count", type=int, default=100, help="of faults; default: 100")
    parser.add_argument("--every", type=float, default=5, help="seconds between faults on average; default: 5")
    parser.add_argument("--frames", type=int, default=480, help="of the film; default: 480")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6),
                        help="default: chosen, printed")
    parser.add_argument("--faults", metavar="A,B", default=",".join(SHARES), help="default: %(default)s")
    parser.add_argument("--here", action="store_true", help="on this machine alone, without " + ", ".join(ON_A_CLUSTER))
    parser.add_argument("--backend", choices=("mpi", "threads"), default="mpi", help="threads: with --here")
    parser.add_argument("--write", choices=("auto", "host", "nodes"), default="auto",
                        help="who writes the frames' files; default: auto")
    parser.add_argument("-o", dest="output", type=pathlib.Path, default=pathlib.Path("soak"),
                        help="folder for report.json, report.txt and mars's lines; default: soak")
    wanted = parser.parse_args()
    wanted.kinds = wanted.faults.split(",")
    if not set(wanted.kinds) <= set(SHARES):
        parser.error(f"--faults takes {', '.join(SHARES)}")
    if wanted.frames <= 0 or wanted.every <= 0 or wanted.count < 0:
        parser.error("--frames and --every are above 0, --count is not below")
    if wanted.backend == "threads" and not wanted.here:
        parser.error("--backend threads goes with --here")
    wanted.skipped = [kind for kind in wanted.kinds if wanted.here and kind in ON_A_CLUSTER]
    wanted.kinds = [kind for kind in wanted.kinds if kind not in wanted.skipped]
    if not wanted.kinds:
        parser.error("--here makes none of these faults")
    return wanted


def say(text):
    print(f"{time.strftime('%H:%M:%S')}  {text}", flush=True)


def last_words(lines):
    """What a program says last, a line, after which its error begins."""
    return " / ".join(re.split(r"(?m)^(?=mars: )", lines)[-1].splitlines()[-4:])


class Soak:
    def __init__(self, wanted, machines, folder):
        self.wanted, self.machines, self.folder = wanted, machines, folder
        self.mars_file = wanted.build.resolve() / "bin" / "mars"
        self.nodes = NODES[wanted.here]
        self.out = folder / "disk" / "film"
        self.samples = Samples(machines)
        self.log = open(wanted.output / "mars.log", "w")
        self.report = {"seed": wanted.seed, "frames": wanted.frames, "every": wanted.every, "kinds": wanted.kinds,
                       "skipped": wanted.skipped, "faults": [], "starts": [], "rounds": 1,
                       "given_up": ""}

    def mars(self, *words, code=0):
        """What a command of mars prints that must end well, beside the cluster."""
        done = subprocess.run([self.mars_file, *map(str, words)], env=self.machines.environment, capture_output=True,
                              text=True, cwd=self.folder, timeout=VERIFIED)
        print(f"--- mars {' '.join(map(str, words))}: {done.returncode}\n{done.stdout}{done.stderr}", file=self.log,
              flush=True)
        if done.returncode not in (0, code):
            raise RuntimeError(f"mars {words[0]} failed: {done.stderr.strip()}")
        return done.stdout

    def render_words(self, *more):
        words = [self.mars_file, "render", self.film, "--nodes", self.nodes, "--restarts", RESTARTS, "--write",
                 self.wanted.write, *more]
        if self.wanted.here:
            groups = ["--groups", 2] if self.wanted.backend == "mpi" else []
            return [*words, "--backend", self.wanted.backend, *groups]
        return [*words, "--hostfile", self.machines.folder / "hostfile", "--groups", 2]

    # ---- before

    def prepare(self):
        """The film and its undisturbed pixels."""
        self.frames = self.wanted.frames
        self.film = film.write_film(self.folder / "film.json", self.frames, dice=DICE)
        words = [self.mars_file, "render", self.film, "-o", "alone", "--backend", "threads", "--nodes", self.nodes]
        alone = Rendering(self.machines, words, folder=self.folder)
        if alone.wait(3600) != 0:
            raise RuntimeError(f"the undisturbed rendering failed:\n{alone.text()}")
        self.report.update(undisturbed_hash=self.hash_of("alone"), undisturbed_seconds=time.monotonic() - alone.began)
        self.sound_film = (self.folder / "alone" / "film.mars").read_bytes()
        shutil.rmtree(self.folder / "alone")
        say(f"{self.frames} frames, undisturbed by threads in {self.report['undisturbed_seconds']:.0f} s: "
            + self.report["undisturbed_hash"])

    def hash_of(self, folder):
        return self.mars("verify", folder).split()[-1]

    # ---- the film

    def run(self):
        self.begin()
        while not self.is_over():
            now = time.monotonic()
            self.undo(now)
            self.look_for_moments(now)
            self.make_faults(now)
            self.look_now_and_then(now)
            time.sleep(PERIOD)
        self.undo(float("inf"))
        self.report["seconds"] = time.monotonic() - self.began

    def begin(self):
        wanted, self.began = self.wanted, time.monotonic()
        self.most = SLOWEST * (wanted.count * wanted.every + self.report["undisturbed_seconds"]) + 300
        self.disturber = Disturber(self.machines, self.out, Source(self.film))
        self.disturber.film = self.sound_film
        self.schedule = Schedule(plan(wanted.seed, wanted.count, wanted.kinds, wanted.every), self.began)
        self.undoing = []  # (time, fault)
        self.rendering, self.killed, self.failures = None, -1e9, 0
        self.jobs, self.ending, self.sampled, self.shown = set(), False, 0, 0

    def is_over(self):
        """Starts mars where none runs, until one ends well after the last fault."""
        if self.rendering is None:
            self.start()
        elif self.rendering.code is not None:
            self.rendering.wait(5)
            if self.note_end() == "well":
                if not self.schedule.left():
                    return True
                self.begin_round()
            elif self.failures >= FAILURES:
                return self.give_up("mars fails each time")
            time.sleep(AGAIN)
            self.start()
        if time.monotonic() - self.began > self.most:
            return self.give_up("it takes too long")
        return False

    def give_up(self, why):
        say("given up: " + why)
        self.report["given_up"] = why
        self.machines.end_what_is_left()
        return True

    def start(self):
        """As a person does, who has put the film back."""
        self.undo(float("inf"), "source")
        self.rendering = Rendering(self.machines, self.render_words("-o", self.out), folder=self.folder)
        self.ending, self.disturber.drawing = False, False
        self.frames_before = len(frames_in(self.out))

    def begin_round(self):
        """The film is there, and faults are left: some of its frames are taken away."""
        self.report["rounds"] += 1
        dice = random.Random(f"{self.wanted.seed}/round {self.report['rounds']}")
        count = LAST_ROUNDS if self.schedule.only_moments_left() else round(dice.uniform(*TAKEN) * self.frames)
        frames = sorted(frames_in(self.out))
        for frame in dice.sample(frames, min(count, len(frames))):
            take_away(self.out / f"frame-{frame:04}.png")
        say(f"round {self.report['rounds']}: {count} frames are taken away, {self.schedule.left()} faults are left")

    def note_end(self):
        """A mars that was killed is no failure; a start soon afterwards may find the old job still at work; and a frame
        at which two nodes were killed may be left out."""
        lines, code = self.rendering.text(), self.rendering.code
        began, ended = (seconds - self.began for seconds in (self.rendering.began, time.monotonic()))
        killed = self.killed >= self.rendering.began and (code < 0 or code > 128 or "stopped by" in lines)
        claimed = "another run" in lines and self.rendering.began - self.killed < 120
        aside = "were killed each time" in lines
        faults = [fault for fault in self.report["faults"] if fault["seconds"] >= began]
        how = ("well" if code == 0 else "killed" if killed else "claimed" if claimed else "aside" if aside
               else "failed")
        hit = [fault["number"] for fault in faults]
        self.report["starts"].append({"began": began, "ended": ended, "code": code, "how": how, "faults": hit,
                                      "last": last_words(lines)})
        print(f"--- start at {began:.1f} s, ended at {ended:.1f} s with {code} ({how})\n{lines}", file=self.log,
              flush=True)
        say(f"mars ended with {code} ({how})" + ("" if how in ("well", "killed") else ": " + last_words(lines)))
        self.failures = self.failures + 1 if how == "failed" else 0
        if how == "failed" and "frames.json" in lines:
            self.repair()
        return how

    def repair(self):
        """As a person does to whom mars refuses the folder. What it cannot mend, the next start shows."""
        with contextlib.suppress(RuntimeError, subprocess.TimeoutExpired):
            self.mars("verify", self.out, "--repair", "--backend", "threads", code=1)

    # ---- faults

    def look_for_moments(self, now):
        """One fault for each job that starts, and for each that ends."""
        jobs = set(self.machines.processes("mpirun", "mars-threads"))
        if jobs and not jobs & self.jobs:
            self.frames_before = len(frames_in(self.out))
            self.disturber.drawing = False
            self.schedule.come(START, now)
        self.jobs = jobs or self.jobs
        there = len(frames_in(self.out))
        self.disturber.drawing = self.disturber.drawing or there > self.frames_before
        if there == self.frames and self.frames_before < there and not self.ending:
            self.ending = True
            self.schedule.come(END, now)

    def make_faults(self, now):
        for planned in self.schedule.take(now):
            fault = self.disturber.make(planned)
            if fault:
                self.note(planned, fault, now)
            else:
                self.schedule.put_back(planned, now)

    def note(self, planned, fault, now):
        if fault.kills == "mars":
            self.killed = now
        if fault.undo:
            self.undoing.append((now + fault.lasts, fault))
        self.report["faults"].append({
            "number": planned.number, "seconds": now - self.began, "kind": planned.kind, "moment": planned.moment,
            "what": fault.what, "kills": fault.kills, "lasts": fault.lasts, "frames": len(frames_in(self.out))})
        say(f"fault {planned.number} at {now - self.began:.1f} s, {planned.kind}"
            + ("" if planned.moment == NOW else f" {planned.delay:.2f} s after a job's {planned.moment}")
            + f": {fault.what}" + (f" for {fault.lasts:.1f} s" if fault.undo else ""))

    def undo(self, now, place=None):
        for each in [each for each in self.undoing if each[0] <= now and place in (None, each[1].place)]:
            self.undoing.remove(each)
            self.disturber.undo(each[1])

    # ---- what is seen meanwhile

    def look_now_and_then(self, now):
        if self.disturber.drawing and now - self.sampled > 1:
            self.samples.take()
            self.sampled = now
        if now - self.shown > 10:
            self.show()
            self.shown = now

    def show(self):
        line = self.rendering.lines[-1][1] if self.rendering.lines else ""
        say(f"{len(frames_in(self.out))} of {self.frames} frames after {time.monotonic() - self.began:.0f} s; "
            f"mars: {line[:100]}")

    # ---- after

    def finish(self):
        """The same command once more, and what only a look at all frames finds."""
        began = time.monotonic()
        self.render_undisturbed()
        found = self.wrong_frames()
        if found:
            self.repair()
            self.render_undisturbed()
        self.report.update(wrong_frames=found, finish_seconds=time.monotonic() - began)

    def render_undisturbed(self):
        self.start()
        if self.rendering.wait(600) is None:
            self.rendering.process.terminate()
            self.rendering.wait(30)
        self.note_end()

    def wrong_frames(self):
        """{frame: why} as mars verify finds them; none where it refuses the folder."""
        try:
            lines = self.mars("verify", self.out, code=1).splitlines()
        except (RuntimeError, subprocess.TimeoutExpired) as refused:
            say(str(refused))
            return {"all": str(refused)}
        return {found[1]: found[2] for line in lines if (found := re.match(r"frame (\d+): (.*)", line))}

    def judge(self, files_before):
        left, seconds = self.machines.wait_until_idle(SETTLED)
        files = self.machines.own_files()
        grown_files = {host: sorted(set(files[host]) - set(files_before[host])) for host in files}
        report = self.report
        report.update(
            frames_there=len(frames_in(self.out)), hash=self.final_hash(), settled_seconds=seconds,
            processes_left=[f"{process.program} {process.number} on {process.host}" for process in left],
            files_left={host: names for host, names in grown_files.items() if names},
            in_folder=sorted(name for name in os.listdir(self.out) if not name.startswith("frame-")),
            growth=self.samples.growth())
        report["wrong"] = list(wrong(report))

    def final_hash(self):
        try:
            return self.hash_of(self.out)
        except (RuntimeError, subprocess.TimeoutExpired) as refused:
            return str(refused)


def mount(place, megabytes):
    place.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "tmpfs", place], check=True)


@contextlib.contextmanager
def places(wanted):
    """The machines, and a folder that all of them see."""
    bin_folder = wanted.build.resolve() / "bin"
    environment = {**os.environ, "PATH": f"{bin_folder}:{os.environ['PATH']}"}
    with tempfile.TemporaryDirectory(prefix="mars-soak-", dir="/var/tmp", ignore_cleanup_errors=True) as name:
        folder = pathlib.Path(name)
        if wanted.here:
            (folder / "disk").mkdir()
            with OneMachine(folder, environment) as machine:
                yield machine, folder
            return
        try:
            mount(folder / "disk", 2048)
            with Cluster(os.environ.get("TESTBED", f"soak-{os.getpid()}"), environment) as cluster:
                yield cluster, folder
        finally:
            subprocess.run(["umount", "--lazy", folder / "disk"], check=False)


def main():
    wanted = arguments()
    if not wanted.here and os.geteuid() != 0:
        sys.exit("mars bench soak: needs root: it makes a virtual cluster; --here does without")
    wanted.output.mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("mars bench soak: stopped"))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))  # of those that are killed by SEGV and ABRT
    say(f"seed {wanted.seed}")
    if wanted.skipped:
        say(f"not on one machine: {', '.join(wanted.skipped)}")
    with places(wanted) as (machines, folder):
        soak = Soak(wanted, machines, folder)
        soak.prepare()
        files = machines.own_files()
        soak.run()
        soak.finish()
        soak.judge(files)
        machines.end_what_is_left()
    (wanted.output / "report.json").write_text(json.dumps(soak.report, indent=1) + "\n")
    (wanted.output / "report.txt").write_text(summary(soak.report) + "\n")
    print(summary(soak.report))
    return 1 if soak.report["wrong"] else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("mars bench soak: stopped")
