#!/usr/bin/env python3
"""How often mars bench scaling and compare answer wrongly on this machine: studies of
a program and itself, none of which may be called slower or faster, then studies
of it and a copy whose nodes take a tenth more of their processors. --load keeps
processors busy meanwhile.

Exit code: 1 where equals were called different or a tenth was not found."""
import argparse
import contextlib
import io
import os
import shutil
import subprocess
import sys
import tempfile
import time

import answers
import changes
import results
import runs
import scaling
import study

HERE = os.path.dirname(os.path.abspath(__file__))
TEAPOT = os.path.join(HERE, "..", "..", "..", "examples", "teapot.json")
STUDY = [TEAPOT, "--size", "480x270", "--backend", "threads", "--nodes", "2", "--warm-up", "0"]
FRAMES = ["--", "--frames", "0-9", "--no-coherence"]
BUSY = "import os, sys\nwhile os.getppid() == int(sys.argv[1]):\n  for _ in range(1000000): pass"


def read_command_line():
    parser = argparse.ArgumentParser(prog="mars bench verdicts", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--load", type=int, default=0, metavar="N", help="busy loops beside; default: %(default)s")
    parser.add_argument("--equal", type=int, default=20, metavar="N", help="studies of equals; default: %(default)s")
    parser.add_argument("--planted", type=int, default=3, metavar="N",
                        help="studies of a copy that is slower; default: %(default)s")
    parser.add_argument("--repeats", type=int, default=60, metavar="N", help="of a study; default: %(default)s")
    parser.add_argument("--apart", action="store_true", help="two studies one after the other instead of --against")
    return parser.parse_args()


@contextlib.contextmanager
def load(count):
    """Busy loops, which also end when this program is killed."""
    loops = [subprocess.Popen([sys.executable, "-c", BUSY, str(os.getpid())]) for _ in range(count)]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def planted(build, name, folder):
    """A folder like a build's, whose mars-threads has a slowdown of planted/."""
    binaries = os.path.join(folder, name, "bin")
    os.makedirs(binaries)
    shutil.copy(os.path.join(build, "bin", "mars"), binaries)
    shutil.copy(os.path.join(build, "bench", "scaling", name, "bin", "mars-threads"), binaries)
    return os.path.dirname(binaries)


class Pairs:
    """Makes studies of two builds' programs, and compares them."""

    def __init__(self, wanted, folder):
        self.wanted, self.folder, self.count = wanted, folder, 0

    def study(self, build, *words):
        self.count += 1
        path = os.path.join(self.folder, str(self.count))
        arguments = ["--build", build, *STUDY, "--repeats", str(self.wanted.repeats), "--seed", str(self.count), *words, "-o", path,
                     *FRAMES]
        with contextlib.redirect_stdout(io.StringIO()):
            scaling.measure(scaling.read_command_line(arguments), arguments)
        return results.Results([runs.read(path)])

    def compared(self, other):
        """A is of the build `other`."""
        if self.wanted.apart:
            return changes.of_studies(self.study(other), self.study(self.wanted.build))
        return changes.of_programs(self.study(self.wanted.build, "--against", os.path.join(other, "bin", "mars")))


def called_different(comparison):
    return any(change.holds for change in (*comparison.times, *comparison.steps, *comparison.machines))


def line(comparison):
    times = [f"{name} {answers.bounds_text(change)}, {answers.answer(change)}"
             for name, change in zip(("film's time", "processors' seconds"), comparison.times)]
    cause = comparison.cause() if comparison.changed else None
    loads = [load for found in comparison.conditions for load in found.load]
    return "; ".join([*times, *([f"step {cause.name} {answers.answer(cause)}"] if cause else []),
                      f"load {min(loads):.1f} to {max(loads):.1f}"])


def count_called_different(pairs, kind, count, other):
    """Prints each comparison. Returns how many of them found A and B to differ."""
    found = 0
    for number in range(1, count + 1):
        comparison = pairs.compared(other)
        found += called_different(comparison)
        print(f"{kind} {number} of {count}: {line(comparison)}", flush=True)
    return found


def main():
    wanted = read_command_line()
    began = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="mars-verdicts-") as folder, load(wanted.load):
        slower = planted(wanted.build, "slow-tenth", folder)
        pairs = Pairs(wanted, folder)
        wrong = count_called_different(pairs, "equal", wanted.equal, wanted.build)
        right = count_called_different(pairs, "a tenth more in A", wanted.planted, slower)
    print(f"{wrong} of {wanted.equal} pairs of equals were called different, {right} of {wanted.planted} with a tenth more were; "
          f"{time.monotonic() - began:.0f} s.")
    return int(wrong > 0 or right < wanted.planted)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except study.Trouble as trouble:
        sys.exit(f"mars bench verdicts: {trouble}")
