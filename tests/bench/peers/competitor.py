"""A competitor: a child process that renders a frame when told to (peer.h)."""
import os
import signal
import subprocess


class Trouble(Exception):
    """Something that ends the benchmark; its text is for a person."""


class Competitor:
    """`processors`: the only ones it may use."""

    def __init__(self, name, command, processors, log, environment=None):
        self.name = name
        self.milliseconds = []
        self.log = log
        with open(log, "w") as errors:
            self.process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors, text=True,
                env={**os.environ, **(environment or {})}, start_new_session=True,
                preexec_fn=lambda: os.sched_setaffinity(0, processors))

    def wait_ready(self):
        self.note = self.answer("ready")

    def answer(self, kind):
        line = self.process.stdout.readline()
        word, _, rest = line.rstrip("\n").partition(" ")
        if word == kind:
            return rest
        with open(self.log) as file:
            words = file.read().strip()
        raise Trouble(f"{self.name} does not answer: {words or line.strip() or 'it ended'}")

    def order(self, line, kind):
        try:
            print(line, file=self.process.stdin, flush=True)
        except BrokenPipeError:
            pass  # answer() tells why
        return self.answer(kind)

    def go(self, frames, counted=True):
        milliseconds = float(self.order(f"go {frames}", "ms"))
        if counted:
            self.milliseconds.append(milliseconds)

    def picture(self, path):
        self.order(f"picture {path}", "done")

    def processor_seconds(self):
        """What it and its children have used so far."""
        ticks = 0
        for name in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{name}/stat") as file:
                    fields = file.read().rpartition(")")[2].split()
            except (FileNotFoundError, ProcessLookupError):
                continue
            if int(fields[3]) == self.process.pid:  # session
                ticks += int(fields[11]) + int(fields[12])
        return ticks / os.sysconf("SC_CLK_TCK")

    def end(self):
        """Ends it by its own way if that works, else by force."""
        try:
            self.process.stdin.close()
            self.process.wait(20)
        except (BrokenPipeError, subprocess.TimeoutExpired):
            pass
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
