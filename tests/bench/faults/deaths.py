#!/usr/bin/env python3
"""mars bench deaths: renders a small film on this machine again and again, and each
time one process of the job dies at a random moment of its life, from its fork to the
end of MPI_Finalize: a node, the host, mpirun, or the one process of threads. Every
time all frames must be there, with the pixels of an undisturbed rendering, and no
process may be left. The exit code is 1 otherwise.

The same seed makes the same plans, but what they hit depends on time."""
import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass

import film

LIBRARY = "death.so"  # planted/death.cpp, beside this benchmark's `run`
NODES, FRAMES = 3, 12
MOST = 300  # seconds that a rendering may take: Open MPI may hang after a SIGSEGV, which MARS waits for 120 s
LIFE = 1500  # milliseconds from a start in which a death may fall: later ones find it ended
SIGNALS = (signal.SIGKILL, signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGTERM)
NAMED = ("fork", "link", "init", "initialized", "finalize", "finalized")
LATE = 0.5  # of all deaths, at a random moment; the others at one that has a name


@dataclass
class Death:
    """One, as planted/death.cpp plans it."""
    program: str  # a pattern, as a shell's
    rank: int     # -1: any
    moment: str   # a name, or milliseconds from its fork
    signal: int

    def __str__(self):
        rank = f" {self.rank}" if self.rank >= 0 else ""
        when = self.moment if self.moment in NAMED else f"{self.moment} ms"
        return f"{signal.Signals(self.signal).name} of {self.program}{rank} at {when}"

    def environment(self, library, plan):
        """For mars: `plan` is a file that is gone, and `plan`.taken too, once it has happened."""
        plan.write_text(f"{self.program} {self.rank} {self.moment} {int(self.signal)}\n")
        others = os.environ.get("LD_PRELOAD")
        return {"DEATH": str(plan), "LD_PRELOAD": f"{library}:{others}" if others else str(library)}


def random_death(chance, nodes=NODES, life=LIFE):
    """Of a job over MPI, or of threads."""
    victims = (("mars-node", chance.randint(1, nodes), NAMED), ("mars-host", 0, NAMED), ("mpirun*", -1, ("fork",)),
               ("mars-threads", -1, ("fork", "link")))
    program, rank, named = chance.choices(victims, weights=(5, 3, 1, 1))[0]
    late = chance.random() < LATE
    # Early moments are more likely: there a job has many states.
    moment = f"{life * chance.random() ** 2:.1f}" if late else chance.choice(named)
    return Death(program, rank, moment, chance.choice(SIGNALS))


def working_in(folder):
    """The processes that do: what mars starts stays in its folder."""
    found = []
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            if os.readlink(f"/proc/{entry}/cwd") == str(folder):
                found.append(int(entry))
        except OSError:
            continue
    return found


class Deaths:
    def __init__(self, wanted, folder):
        self.mars, self.folder = wanted.build / "bin" / "mars", folder
        self.library = wanted.build / "bench" / "deaths" / LIBRARY
        self.film = film.write_film(folder / "film.json", FRAMES, size=(96, 54))
        self.command("render", self.film, "-o", "alone", "--backend", "threads", "--quiet")
        self.pixels = self.hash_of("alone")

    def command(self, *words):
        return subprocess.run([self.mars, *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              check=True)

    def hash_of(self, name):
        return self.command("verify", name).stdout.split()[-1]

    def render(self, death):
        """(what went wrong or "", whether anything died, how often the job was begun again, seconds)"""
        plan, out = self.folder / "plan", self.folder / "out"
        shutil.rmtree(out, ignore_errors=True)
        backend = "threads" if death.program == "mars-threads" else "mpi"
        environment = {**os.environ, **death.environment(self.library, plan)}
        words = [self.mars, "render", self.film, "-o", out, "--nodes", str(NODES), "--backend", backend]
        began = time.monotonic()
        mars = subprocess.Popen(words, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        lines, wrong = self.follow(mars), ""
        if mars.returncode != 0:
            wrong = f"mars ended with {mars.returncode}: " + " / ".join(lines[-6:])
        elif (pixels := self.hash_of("out")) != self.pixels:
            wrong = f"other pixels: {pixels}"
        elif left := working_in(self.folder):
            wrong = f"still running: {left}"
        left = [file for file in (plan, pathlib.Path(f"{plan}.taken")) if file.exists()]
        died = not left
        for file in left:
            file.unlink()
        return wrong, died, sum("starting again" in line for line in lines), time.monotonic() - began

    def follow(self, mars):
        """Its lines; its processes are ended if it does not end."""
        try:
            return mars.communicate(timeout=MOST)[0].splitlines()
        except subprocess.TimeoutExpired:
            for each in working_in(self.folder):
                os.kill(each, signal.SIGKILL)
            return mars.communicate()[0].splitlines() + [f"it did not end within {MOST} s"]


def arguments():
    parser = argparse.ArgumentParser(prog="mars bench deaths", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--count", type=int, default=100, help="of renderings; default: 100")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6),
                        help="default: chosen, printed")
    wanted = parser.parse_args()
    wanted.build = wanted.build.resolve()
    return wanted


def main():
    wanted, folder = arguments(), pathlib.Path(tempfile.mkdtemp(prefix="mars-deaths-"))
    chance, wrongs, died, again = random.Random(wanted.seed), 0, 0, 0
    try:
        deaths = Deaths(wanted, folder)
        for number in range(1, wanted.count + 1):
            death = random_death(chance)
            wrong, happened, restarts, seconds = deaths.render(death)
            wrongs, died, again = wrongs + bool(wrong), died + happened, again + (restarts > 0)
            print(f"{number:4} {seconds:5.1f} s  {death}: {'begun again' if restarts else 'went on'}"
                  + ("" if happened else ", had ended before")
                  + (f"\n     WRONG: {wrong}" if wrong else ""), flush=True)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    print(f"seed {wanted.seed}: {wanted.count} renderings, {died} deaths, {again} jobs begun again, {wrongs} wrong")
    return 1 if wrongs else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("mars bench deaths: stopped")
