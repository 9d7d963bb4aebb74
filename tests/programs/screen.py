"""A pseudo terminal in which the tests of `mars preview` and `mars play` start the program and read what it shows."""

import fcntl
import os
import pty
import re
import select
import struct
import subprocess
import termios
import time

import harness
from harness import ENVIRONMENT, SECONDS

ENTER, LEAVE = b"\x1b[?1049h", b"\x1b[?1049l"


class Screen:
    """mars in a terminal of its own, of 80 x 24 characters, whose answers to questions are `answers`. `shell`: words of
    a program that starts it."""

    def __init__(self, folder, *words, shell=(), answers=b"\x1b[?62;22c", **variables):
        self.master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        self.slave = slave
        self.before = termios.tcgetattr(slave)
        environment = {**ENVIRONMENT, "TERM": "xterm-256color", "COLORTERM": "truecolor", **variables}
        self.process = subprocess.Popen([*shell, str(harness.PROGRAMS / "mars"), *map(str, words)], stdin=slave,
                                        stdout=slave, stderr=slave, env=environment, cwd=folder, start_new_session=True,
                                        preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
        self.seen, self.answers = b"", answers

    def read(self, seconds):
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0 and select.select([self.master], [], [], left)[0]:
            more = os.read(self.master, 1 << 16)
            self.seen += more
            if b"\x1b[c" in more:
                os.write(self.master, self.answers)
            return True
        return False

    def wait_for(self, what, since=0):
        """Until `what`, a pattern, was shown after `since`; gives the match."""
        end = time.monotonic() + SECONDS
        while not (found := re.compile(what, re.S).search(self.seen, since)):
            assert time.monotonic() < end, f"never shown: {what} in {self.seen[-600:]}"
            self.read(0.1)
        return found

    def press(self, keys, what):
        since = len(self.seen)
        os.write(self.master, keys)
        return self.wait_for(what, since)

    def end(self):
        """What it ends with, once it is gone and all it said is read."""
        end = time.monotonic() + SECONDS
        while self.process.poll() is None and time.monotonic() < end:
            self.read(0.05)
        while self.read(0.1):
            pass
        return self.process.wait(timeout=1)

    def given_back(self):
        """Whether the terminal is as it was."""
        return (termios.tcgetattr(self.slave) == self.before and self.seen.count(ENTER) == self.seen.count(LEAVE) > 0
                and self.seen.rindex(LEAVE) > self.seen.rindex(ENTER) and self.seen.rindex(b"\x1b[?25h") > 0)

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        os.close(self.master)
        os.close(self.slave)
