"""A competitor: a child process that renders a frame on demand (peer.h); or several, each with frames of its own."""
import json
import os
import signal
import subprocess


class Trouble(Exception):
    """Something that ends the benchmark; its text is for a person."""


class Competitor:
    """`processors`: the only ones it may use. `frames`: the folder of the files that it writes; none: it writes none."""

    def __init__(self, name, command, processors, log, environment=None, frames=None):
        self.name = name
        self.frames = frames
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

    def say(self, line):
        try:
            print(line, file=self.process.stdin, flush=True)
        except BrokenPipeError:
            pass  # answer() tells why

    def go(self, frames):
        """Milliseconds a frame. Files of the turn before are removed first."""
        for name in os.listdir(self.frames) if self.frames else ():
            if name.endswith(".png"):
                os.remove(os.path.join(self.frames, name))
        self.say(f"go {frames}")
        return float(self.answer("ms"))

    def picture(self, path):
        self.say(f"picture {path}")
        self.answer("done")

    def cost(self):
        """What shadows cost it (struct Cost of peer.h)."""
        self.say("cost")
        return json.loads(self.answer("cost"))

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


class Team:
    """Competitors that share a turn's frames, each with whole frames on a processor of its own."""

    def __init__(self, name, members):
        self.name, self.members = name, members
        self.milliseconds = []
        self.rendered = [0] * len(members)

    def wait_ready(self):
        for member in self.members:
            member.wait_ready()
        self.note = self.members[0].note

    def go(self, frames):
        shares = [frames // len(self.members) + (k < frames % len(self.members)) for k in range(len(self.members))]
        for member, share in zip(self.members, shares):
            member.say(f"go {share}")
        times = [share * float(member.answer("ms")) for member, share in zip(self.members, shares)]
        self.rendered = [before + share for before, share in zip(self.rendered, shares)]
        self.cycle = frames
        return max(times) / frames

    def picture(self, path):
        """The frame that a turn of all frames ends with."""
        left = -self.rendered[0] % self.cycle
        if left:
            self.members[0].go(left)
        self.members[0].picture(path)

    def processor_seconds(self):
        return sum(member.processor_seconds() for member in self.members)

    def end(self):
        for member in self.members:
            member.end()
