"""A `mars render` that runs on the cluster's first host: what it says, and when its frames appear."""
import os
import re
import subprocess
import threading
import time

import cluster as clusters

FRAME = re.compile(r"frame-(\d+)\.png$")
PERIOD = 0.05  # seconds between two looks into the folder


def frames_in(folder):
    try:
        return {int(found[1]) for name in os.listdir(folder) if (found := FRAME.match(name))}
    except OSError:
        return set()


class FrameWatch:
    """When each frame was first seen in a folder: {number: seconds}. Goes on over several renderings."""

    def __init__(self, folder):
        self.folder, self.seen, self.ended = folder, {}, threading.Event()
        self.thread = threading.Thread(target=self.watch, daemon=True)
        self.thread.start()

    def watch(self):
        while not self.ended.wait(PERIOD):
            self.look()

    def look(self):
        now = time.monotonic()
        for frame in frames_in(self.folder):
            self.seen.setdefault(frame, now)

    def end(self):
        self.ended.set()
        self.thread.join()
        self.look()

    def times(self):
        return sorted(self.seen.values())


class Rendering:
    """One start of mars."""

    def __init__(self, cluster, words, host=clusters.HOSTS[0], folder="/"):
        self.began, self.lines = time.monotonic(), []
        self.process = subprocess.Popen(cluster.on(host, *words), cwd=folder, env=cluster.environment, text=True,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        start_new_session=True)
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.lines.append((time.monotonic(), line.rstrip("\n")))

    @property
    def code(self):
        """Its exit code; none while it runs."""
        return self.process.poll()

    def wait(self, seconds):
        """Its exit code; none if it still runs after `seconds`."""
        try:
            self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None
        self.reader.join(5)
        return self.process.returncode

    def first_line(self, pattern, since):
        """(seconds, line) of the first that matches, of those said after `since`."""
        return next(((when, line) for when, line in self.lines if when >= since and re.search(pattern, line)), None)

    def text(self):
        return "\n".join(line for _, line in self.lines)


class BatchJob(Rendering):
    """A job of Slurm's, of which mars is the script's program; it has ended when Slurm knows it no more as waiting or
    running. Its code is 0 if Slurm calls it completed."""

    def __init__(self, cluster, words, folder):
        self.began, self.lines, self.cluster = time.monotonic(), [], cluster
        self.output = folder / "job.out"
        self.output.write_text("")
        submit = ["sbatch", "--parsable", f"--output={self.output}", *map(str, words)]
        done = subprocess.run(cluster.on(clusters.HEAD, *submit), cwd=folder, env=cluster.environment, text=True,
                              capture_output=True, check=True)
        self.job, self.state = done.stdout.strip(), "PENDING"
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        while self.code is None:
            self.take_lines()
            self.state = self.fact("JobState")
            time.sleep(0.2)
        self.take_lines()

    def take_lines(self):
        lines = self.output.read_text().splitlines()
        self.lines += [(time.monotonic(), line) for line in lines[len(self.lines):]]

    def fact(self, name):
        """One of those that Slurm shows of the job; "" if Slurm does not answer now."""
        done = subprocess.run(self.cluster.on(clusters.HEAD, "scontrol", "--oneliner", "show", "job", self.job),
                              env=self.cluster.environment, capture_output=True, text=True)
        return next((word.split("=", 1)[1] for word in done.stdout.split() if word.startswith(name + "=")), "")

    @property
    def code(self):
        if self.state == "COMPLETED":
            return 0
        return 1 if self.state in ("FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL", "PREEMPTED", "BOOT_FAIL") else None

    def wait(self, seconds):
        self.reader.join(seconds)
        return self.code
