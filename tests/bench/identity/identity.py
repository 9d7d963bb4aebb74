#!/usr/bin/env python3
"""mars bench identity: whether films have the same bits however they are rendered. Random films
(random_film.py) are rendered in several random ways each: over threads, processes and MPI, by 1 to 9
nodes in any groups, with and without coherence, by each instruction set, with little memory, by every
mapping. One way of a film draws it from nothing with one node.

Of each film: its seed, what it is, and its pixels' hash; of a way that gives others the command that
shows it. Exit code 1 where there is one."""
import argparse
import json
import os
import pathlib
import random
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

from random_film import RandomFilm

PLAIN = {"--backend": "threads", "--nodes": "1", "--no-coherence": None}
LONGEST = 120  # seconds of one rendering


def arguments(words=None):
    parser = argparse.ArgumentParser(prog="mars bench identity", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--films", type=int, default=20, metavar="N", help="how many films; default: %(default)s")
    parser.add_argument("--ways", type=int, default=10, metavar="N", help="ways to render each; default: %(default)s")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the first film; default: %(default)s")
    parser.add_argument("--keep", type=pathlib.Path, metavar="DIR", help="write the films there, to look at them")
    return parser.parse_args(words)


def random_way(choose, mpi):
    """Options of mars render, and its environment."""
    nodes = choose.randint(1, 9)
    way = {"--backend": choose.choice(["threads", "threads", *(["mpi"] if mpi else [])]), "--nodes": str(nodes)}
    if choose.random() < 0.6:
        way["--groups"] = str(choose.randint(1, nodes))
    if choose.random() < 0.3:
        way["--no-coherence"] = None
    if choose.random() < 0.5:
        way["--mapping"] = choose.choice(["greedy", "optimal", "cost"])
    if choose.random() < 0.4:
        way["--block"] = str(choose.choice([1, 3, 8, 32, 200]))
    environment = {}
    if choose.random() < 0.6:
        environment["MARS_SIMD"] = choose.choice(["sse2", "sse4", "avx2", "avx512"])
    if choose.random() < 0.3:
        environment["MARS_MEMORY"] = choose.choice(["1", "2", "8"])
    return way, environment


class Films:
    def __init__(self, build, folder):
        self.mars = os.path.abspath(build / "bin" / "mars")
        self.folder = pathlib.Path(folder)

    def run(self, words, environment=None):
        done = subprocess.run([self.mars, *words], capture_output=True, text=True, timeout=LONGEST,
                              env={**os.environ, **(environment or {})})
        if done.returncode != 0:
            raise RuntimeError(f"{shown([self.mars, *words], environment)}: {done.stderr.strip()}")
        return done.stdout

    def write(self, seed):
        """The film's file."""
        film, path = RandomFilm(seed), self.folder / f"film-{seed}.json"
        path.write_text(json.dumps(film.json, indent=1))
        for command in film.commands:
            self.run([str(path) if word == "FILM" else word for word in command])
        return path

    def words(self, path, way):
        options = [word for name, value in way.items() for word in ([name] if value is None else [name, value])]
        return ["render", str(path), "-o", str(self.folder / "frames"), "--quiet", "--force", *options]

    def hash(self, path, way, environment):
        shutil.rmtree(self.folder / "frames", ignore_errors=True)
        self.run(self.words(path, way), environment)
        return re.search(r"^pixels \(.*\) (\w+)$", self.run(["verify", str(self.folder / "frames")]), re.MULTILINE)[1]


def shown(words, environment):
    return " ".join([f"{name}={value}" for name, value in (environment or {}).items()] + [shlex.quote(word) for word in words])


def described(film):
    width, height = film["size"]
    text = f"{width}x{height}, {film['samples']} samples, {film['frames']} frames, {len(film['actors'])} actors"
    lights = f", {len(film['lights'])} lights" if "lights" in film else ""
    return text + lights


def compare(films, path, ways):
    """The pixels' hash of the plain way, and the commands of those that give another."""
    expected = films.hash(path, PLAIN, {})
    wrong = [shown(["mars", *films.words(path, way)], environment) for way, environment in ways
             if films.hash(path, way, environment) != expected]
    return expected, wrong


def main():
    options = arguments()
    mpi = shutil.which("mpirun") is not None and (options.build / "bin" / "mars-host").exists()
    print("over threads and MPI" if mpi else "over threads: there is no MPI here", flush=True)
    failures = 0
    with tempfile.TemporaryDirectory(prefix="mars-identity-") as folder:
        films = Films(options.build, folder)
        for seed in range(options.seed, options.seed + options.films):
            choose = random.Random(f"ways of {seed}")
            path = films.write(seed)
            if options.keep:
                options.keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(path, options.keep)
            pixels, wrong = compare(films, path, [random_way(choose, mpi) for _ in range(options.ways - 1)])
            print(f"{seed:6}  {pixels}  {described(json.loads(path.read_text()))}", flush=True)
            for command in wrong:
                print(f"WRONG: {command}", flush=True)
            failures += len(wrong)
    print(f"{options.films} films in {options.ways} ways each: " + (f"{failures} gave other pixels" if failures else "all alike"))
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
