"""A film that is rendered on the cluster while a fault is made, and what can be seen of it from outside: what mars
says, when frames are stored, and from its nodes' notes (planted/noting_node.cpp) when they began which frame."""
import pathlib
import shutil
import subprocess
import time

import cluster as clusters
import film
from rendering import BatchJob, FrameWatch, Rendering, frames_in

SCRIPT = clusters.TESTBED.parents[1] / "slurm" / "render.sbatch"
PROGRAMS = ("mars", "mars-host", "mars-loopback.so")
NODES = 8


def copy_programs(build, folder):
    """A folder of programs whose node takes notes."""
    folder.mkdir()
    for name in PROGRAMS:
        shutil.copy(build / "bin" / name, folder)
    shutil.copy(build / "bench" / "faults" / "bin" / "mars-node", folder)
    return folder


class Notes:
    """(seconds, job, process, frame) for each time that a node began a frame."""

    def __init__(self, programs):
        self.file = programs / "begun"
        self.file.unlink(missing_ok=True)

    def lines(self):
        if not self.file.exists():
            return []
        words = [line.split() for line in self.file.read_text().splitlines()]
        return [(float(seconds), job, int(process), int(frame)) for seconds, job, process, frame in words]

    def jobs_of_frames(self):
        jobs = {}
        for _, job, _, frame in self.lines():
            jobs.setdefault(frame, set()).add(job)
        return jobs

    def first_of_job_since(self, since):
        """When the first job that began to draw after `since` did so; none: no new job."""
        first = {}
        for seconds, job, _, _ in self.lines():
            first[job] = min(seconds, first.get(job, seconds))
        return min((seconds for seconds in first.values() if seconds > since), default=None)


class Scene:
    def __init__(self, cluster, disk, folder, programs, film_file, frames):
        self.cluster, self.disk, self.folder, self.programs = cluster, disk, folder, programs
        self.film, self.frames = film_file, frames
        self.out = disk.place / "film"
        self.later = []     # (seconds, what is done then), to undo a fault
        self.renderings = []
        self.at_end = []    # done when mars has ended
        self.since = None   # when the fault was made

    # ---- rendering

    def words(self, more=()):
        words = [self.programs / "mars", "render", self.film, "-o", self.out]
        if not self.batch:
            words += ["--hostfile", self.cluster.folder / "hostfile"]
        return words + list(more or ["--nodes", NODES, "--groups", 2])

    def begin(self, more=(), batch=()):
        shutil.rmtree(self.out, ignore_errors=True)
        self.more, self.batch = more, batch
        self.notes, self.watch = Notes(self.programs), FrameWatch(self.out)
        self.files_before = self.cluster.own_files()
        self.start()

    def start(self):
        if self.batch:
            words = [*self.batch, SCRIPT, *self.words(["--groups", 2])[2:]]
            self.renderings.append(BatchJob(self.cluster, words, self.folder))
            return
        self.renderings.append(Rendering(self.cluster, self.words(self.more), folder=self.folder))

    @property
    def mars(self):
        return self.renderings[-1]

    def stored(self):
        return len(frames_in(self.out))

    def wait_for_frames(self, count, seconds=300):
        end = time.monotonic() + seconds
        while len(self.watch.seen) < count:
            if self.mars.code is not None or time.monotonic() > end:
                raise RuntimeError(f"{len(self.watch.seen)} frames and no more before the fault:\n{self.mars.text()}")
            time.sleep(0.01)

    def happens(self):
        """The fault is made now."""
        self.since = time.monotonic()

    def undo_after(self, seconds, undo):
        self.later.append((time.monotonic() + seconds, undo))

    def undo_at_end(self, undo):
        self.at_end.append(undo)

    def wait(self, seconds):
        """Mars's exit code, none if it does not end in `seconds`; meanwhile faults are undone that last."""
        end = time.monotonic() + seconds
        while self.mars.code is None and time.monotonic() < end:
            self.undo(time.monotonic())
            time.sleep(0.05)
        code = self.mars.wait(2)
        self.undo(float("inf"))
        return code

    def undo(self, now):
        for each in [each for each in self.later if each[0] <= now]:
            self.later.remove(each)
            each[1]()

    def start_again(self, seconds):
        """As a person does: the same command, and once more while another run holds the folder."""
        end = time.monotonic() + seconds
        while True:
            self.start()
            code = self.wait(max(1, end - time.monotonic()))
            if code == 0 or "another run" not in self.mars.text() or time.monotonic() > end:
                return code
            time.sleep(2)

    # ---- whom a fault hits

    def process(self, program, host=None):
        """The first of them."""
        found = sorted(self.cluster.processes(program, host=host), key=lambda process: process.number)
        if not found:
            raise RuntimeError(f"no {program} runs on {host or 'any host'}:\n{self.mars.text()}")
        return found[0]

    # ---- what is seen afterwards

    def first_line(self, pattern):
        found = [line for each in self.renderings if (line := each.first_line(pattern, self.since))]
        return min(found, default=None)

    def drawing_again(self):
        """Seconds from the fault until a new job drew, or where there was none until frames were stored again after
        the longest pause; none: there was no pause of a second."""
        first = self.notes.first_of_job_since(self.since)
        if first is not None:
            return first - self.since
        times = [self.since, *(when for when in self.watch.times() if when > self.since)]
        pause, end = max(((after - before, after) for before, after in zip(times, times[1:])), default=(0, 0))
        return end - self.since if pause > 1 else None

    def drawn_twice(self):
        return sum(len(jobs) - 1 for jobs in self.notes.jobs_of_frames().values())

    def pixels(self):
        done = subprocess.run([self.programs / "mars", "verify", self.out], capture_output=True, text=True,
                              env=self.cluster.environment)
        return done.stdout.split()[-1] if done.returncode == 0 else (done.stdout + done.stderr).strip().splitlines()[-1]

    def files_left(self):
        after = self.cluster.own_files()
        return {host: names for host in after if (names := sorted(set(after[host]) - set(self.files_before[host])))}


def alone(programs, build, film_file, folder):
    """The film's pixels and seconds, undisturbed and by threads."""
    out = folder / "alone"
    mars = build / "bin" / "mars"
    began = time.monotonic()
    subprocess.run([mars, "render", film_file, "-o", out, "--backend", "threads", "--nodes", str(NODES), "--quiet"],
                   check=True)
    seconds = time.monotonic() - began
    pixels = subprocess.run([mars, "verify", out], check=True, capture_output=True, text=True).stdout.split()[-1]
    shutil.rmtree(out)
    return pixels, seconds
