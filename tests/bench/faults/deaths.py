#!/usr/bin/env python3
"""mars bench deaths: renders a small film on this machine again and again, and each
time one process of the job dies at a random moment of its life, from its fork to the
end of MPI_Finalize: a node, the host, mpirun, or the one process of threads. Every
time all frames must be there, with the pixels of an undisturbed rendering, and no
process may be left. The exit code is 1 otherwise.

With --apart, each of 4 nodes lies on a machine of its own as far as MARS knows, and a
node dies, or stands still for ever, when it is about to send a message to another: in the
ring of machines, in the exchange of triangles, or within a team.

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

import apart
import film
from death import NAMED, SIGNALS, Death

LIBRARY = "death.so"  # planted/death.cpp, beside this benchmark's `run`
NODES, FRAMES = 3, 12
MOST = 300  # seconds that a rendering may take: Open MPI may hang after a SIGSEGV, which MARS waits for 120 s
LIFE = 1500  # milliseconds from a start in which a death may fall: later ones find it ended
LATE = 0.5  # of all deaths, at a random moment; the others at one that has a name


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
    """Of a film's renderings in `folder`; `is_apart`: of nodes that take each other for other machines'."""

    def __init__(self, build, folder, is_apart=False):
        self.folder, self.is_apart = folder, is_apart
        self.mars = (apart.copy_programs(build, folder / "bin") if is_apart else build / "bin") / "mars"
        self.library = build / "bench" / "deaths" / LIBRARY
        self.plan, self.taken = folder / "plan", folder / "plan.taken"
        self.film = (apart.write_film(folder / "film.json") if is_apart else
                     film.write_film(folder / "film.json", FRAMES, size=(96, 54)))
        self.command("render", self.film, "-o", "alone", "--backend", "threads", "--quiet")
        self.pixels = self.hash_of("alone")

    def command(self, *words):
        return subprocess.run([self.mars, *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              check=True)

    def hash_of(self, name):
        return self.command("verify", name).stdout.split()[-1]

    def files_of(self, name):
        return {path.name: path.read_bytes() for path in (self.folder / name).glob("frame-*")}

    def words_for(self, death):
        if self.is_apart:
            return ["--nodes", str(apart.NODES), "--backend", "mpi", *apart.words_for(death)]
        return ["--nodes", str(NODES), "--backend", "threads" if death.program == "mars-threads" else "mpi"]

    def start(self, death):
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        return subprocess.Popen([self.mars, "render", self.film, "-o", "out", *self.words_for(death)],
                                cwd=self.folder, env={**os.environ, **death.environment(self.library, self.plan)},
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def render(self, death):
        """(what went wrong or "", whether anything died, how often the job was begun again, seconds)"""
        began, mars = time.monotonic(), self.start(death)
        lines = self.follow(mars)
        wrong = self.wrong(mars.returncode, lines)
        left = [file for file in (self.plan, self.taken) if file.exists()]
        for file in left:
            file.unlink()
        return wrong, not left, sum("starting again" in line for line in lines), time.monotonic() - began

    def wrong(self, code, lines):
        if code != 0:
            return f"mars ended with {code}: " + " / ".join(lines[-6:])
        if (pixels := self.hash_of("out")) != self.pixels:
            return f"other pixels: {pixels}"
        if self.files_of("out") != self.files_of("alone"):
            return "the same pixels in other files"
        return f"still running: {left}" if (left := working_in(self.folder)) else ""

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
    parser.add_argument("--apart", action="store_true", help="nodes that are apart, and deaths in their messages")
    wanted = parser.parse_args()
    wanted.build = wanted.build.resolve()
    if wanted.apart and not apart.is_possible():
        parser.error("--apart needs user namespaces (unshare --user)")
    return wanted


def main():
    wanted = arguments()
    chance, wrongs, died, again = random.Random(wanted.seed), 0, 0, 0
    with tempfile.TemporaryDirectory(prefix="mars-deaths-", ignore_cleanup_errors=True) as folder:
        deaths = Deaths(wanted.build, pathlib.Path(folder), wanted.apart)
        for number in range(1, wanted.count + 1):
            death = (apart.random_death if wanted.apart else random_death)(chance)
            wrong, happened, restarts, seconds = deaths.render(death)
            wrongs, died, again = wrongs + bool(wrong), died + happened, again + (restarts > 0)
            print(f"{number:4} {seconds:5.1f} s  {death}: {'begun again' if restarts else 'went on'}"
                  + ("" if happened else ", had ended before")
                  + (f"\n     WRONG: {wrong}" if wrong else ""), flush=True)
    print(f"seed {wanted.seed}: {wanted.count} renderings, {died} deaths, {again} jobs begun again, {wrongs} wrong")
    return 1 if wrongs else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("mars bench deaths: stopped")
