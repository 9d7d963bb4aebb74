#!/usr/bin/env python3
"""mars bench identity: whether films have the same bits however they are rendered. Random films
(random_film.py) are rendered in several random ways each: over threads, processes and MPI, by 1 to 9
nodes in any groups and teams, with and without cuts and coherence, by each instruction set, with little memory, by every
mapping, with and without a program that watches. One way of a film draws it from nothing with one node. All ways of a film
give the same picture: some films in layers, with alpha, as faces of a panorama, by one eye of two, or a part of the picture,
which is compared with the whole. What a watcher of 8-bit frames has at last is compared with the frame's file.

Then commands edit each film at random (random_edits.py), and it is rendered in as many ways again. One
more way renders the edited film into the folder of the film before its edits, where mars render draws
only the frames that have changed. With --kills, renderings of the film and of its video are killed at random and finished
(killed.py).

For each film, the command prints its seed, its pixels' hash and what it is; for an edited film the
edits; for a way that gives other files, or that fails, the command that shows it. The exit code is 1 if there is
one."""
import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent.parent / "programs"))
from exr_reader import Exr  # noqa: E402
from killed import Killed  # noqa: E402
from png_reader import png_rows  # noqa: E402
from random_edits import random_edit  # noqa: E402
from random_film import RandomFilm  # noqa: E402
from watcher import Watcher  # noqa: E402

CONTINUED = {"--backend": "threads", "--nodes": "2"}
PLAIN = {"--backend": "threads", "--nodes": "1", "--no-coherence": None}
PLAIN_WORDS = ["--backend", "threads", "--nodes", "1"]
PLAIN_EXR = ["--format", "exr", "--compression", "none"]
PARTS = ["--crop", "--margin"]  # options of a part of the picture, with their values
LONGEST = 120  # seconds of one rendering


def arguments(words=None):
    parser = argparse.ArgumentParser(prog="mars bench identity", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--films", type=int, default=20, metavar="N", help="how many films; default: %(default)s")
    parser.add_argument("--ways", type=int, default=10, metavar="N", help="ways to render each; default: %(default)s")
    parser.add_argument("--edits", type=int, default=3, metavar="N", help="edits of each film; default: %(default)s")
    parser.add_argument("--kills", action="store_true", help="kill renderings of each film and finish them")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the first film; default: %(default)s")
    parser.add_argument("--keep", type=pathlib.Path, metavar="DIR", help="write the films there, to look at them")
    return parser.parse_args(words)


def casts(path):
    return any(light.get("shadow") for light in json.loads(path.read_text()).get("lights", []))


def random_way(choose, mpi, film):
    """Options of mars render, and its environment."""
    nodes = choose.randint(1, 9)
    way = {"--backend": choose.choice(["threads", "threads", *(["mpi"] if mpi else [])]), "--nodes": str(nodes)}
    if choose.random() < 0.6:
        way["--groups"] = str(choose.randint(1, nodes))
    if choose.random() < 0.4:
        way["--sharers"] = str(choose.randint(1, nodes))
    if choose.random() < 0.3:
        way["--cut"] = str(choose.randint(1, 8))
    if choose.random() < 0.4:
        way["--exchange"] = choose.choice(["send", "again"])
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
        environment["MARS_MEMORY"] = choose.choice(["24", "32"] if casts(film) else ["1", "2", "8"])  # shadows need some
    if random.Random(f"writers of {way}").random() < 0.4:  # of its own: ways of a seed stay
        way["--write"] = "nodes"
    elif nodes > 1 and random.Random(f"watchers of {way}").random() < 0.4:
        way["--watch"] = str(film.parent / "watcher")
    return way, environment


def form(path):
    """Options of the film's files: the same in all ways."""
    forms = [[], [], ["--alpha"], ["--format", "png16", "--alpha"], ["--format", "exr", "--alpha"],
             ["--format", "exr", "--compression", "piz"], ["--name", "shot_####", "--first-number", "1001"]]
    return random.Random(f"form of {path.stem}").choice(forms)


def part(choose, width, height):
    """A crop of a picture, and a margin around it or around the whole."""
    left, top = choose.randrange(width), choose.randrange(height)
    crop = f"{left},{top},{choose.randint(1, width - left)}x{choose.randint(1, height - top)}"
    return choose.choice([["--crop", crop], ["--crop", crop, "--margin", str(choose.randint(0, max(width, height)))],
                          ["--margin", str(choose.randint(1, max(width, height)))]])


def output(path):
    """Options of what the film's files show: the same in all ways."""
    film, choose = json.loads(path.read_text()), random.Random(f"output of {path.stem}")
    projection = film["camera"].get("projection", "perspective")
    is_exr, words = "exr" in form(path), []
    width, height = film["size"]
    if projection == "panorama":
        if choose.random() < 0.5:
            return []
        words, is_exr = ["--faces", *([] if is_exr else ["--format", "exr"])], True
    if projection == "perspective" and film["camera"].get("interaxial"):
        words += ["--eye", choose.choice(["left", "right"])]
    if is_exr and choose.random() < 0.7:
        of_any = ["ids", "normal,unshadowed", "depth"]  # faces have no motion
        words += ["--layers", choose.choice(of_any if "--faces" in words else [*of_any, "all", "depth,motion"])]
    has_part = projection != "panorama" and choose.random() < 0.35
    return words + (part(choose, width, height) if has_part else [])


def is_shown_as_it_is(path):
    """Whether a watcher sees just the colours of the film's files."""
    changing = {"--alpha", "--format", *PARTS}.intersection(form(path) + output(path))
    return not changing and json.loads(path.read_text())["camera"].get("projection") != "panorama"


class Refused(RuntimeError):
    """A command that ended with exit code 1."""


class Films:
    def __init__(self, build, folder):
        self.mars = os.path.abspath(build / "bin" / "mars")
        self.folder = pathlib.Path(folder)

    def run(self, words, environment=None):
        done = subprocess.run([self.mars, *words], capture_output=True, text=True, timeout=LONGEST,
                              env={**os.environ, **(environment or {})})
        if done.returncode != 0:
            raise (Refused if done.returncode == 1 else RuntimeError)(f"{shown([self.mars, *words], environment)}: {done.stderr.strip()}")
        return done.stdout

    def write(self, seed):
        """The film's file."""
        film, path = RandomFilm(seed), self.folder / f"film-{seed}.json"
        path.write_text(json.dumps(film.json, indent=1))
        for command in film.commands:
            self.change(path, command)
        return path

    def change(self, path, command):
        self.run([str(path) if word == "FILM" else word for word in command])

    def edit(self, path, choose):
        """Edits the film; the words of the command. MARS may refuse it: then there are none, and the film is as it was."""
        before = path.read_bytes()
        command = random_edit(choose, json.loads(before))
        try:
            self.change(path, command)
        except Refused as refused:
            if path.read_bytes() != before:
                raise RuntimeError(f"a command that failed has changed the film: {refused}") from refused
            return []
        return command

    def words(self, path, way, frames="frames"):
        options = [word for name, value in way.items() for word in ([name] if value is None else [name, value])]
        return ["render", str(path), "-o", str(self.folder / frames), "--quiet", "--force", *form(path), *output(path), *options]

    def hash(self, path, way, environment, frames="frames"):
        """Of the pixels in the folder `frames`, into which the film is rendered; what is in it stays, except in "frames"."""
        if frames == "frames":
            shutil.rmtree(self.folder / frames, ignore_errors=True)
        watcher = Watcher(way["--watch"]) if "--watch" in way else None
        try:
            self.run(self.words(path, way, frames), environment)
        except Refused as refused:  # the film's shadows need more memory: then they have to do with the least
            least = re.search(r"set MARS_MEMORY to (\d+) or more", str(refused))
            if not least or "MARS_MEMORY" not in environment:
                raise
            self.run(self.words(path, way, frames), environment | {"MARS_MEMORY": least[1]})
        if watcher:
            self.check_watcher(watcher, path, frames)
        return self.pixels(frames)

    def pixels(self, frames):
        return re.search(r"^pixels \(.*\) (\w+)$", self.run(["verify", str(self.folder / frames)]), re.MULTILINE)[1]

    def check_watcher(self, watcher, path, frames):
        watcher.end()
        if watcher.whole != 1:
            raise RuntimeError("the watcher's last picture is no whole frame")
        if is_shown_as_it_is(path) and watcher.colors() != png_rows(self.files(frames)[watcher.frame]):
            raise RuntimeError(f"the watcher has other pixels of frame {watcher.frame}")

    def content(self, path, way, environment):
        """That hash of the film, rendered into an empty folder, and a hash of the bytes of its files."""
        pixels, sum_of_files = self.hash(path, way, environment), hashlib.sha256()
        for file in self.files("frames"):
            sum_of_files.update(f"{file.name} {file.stat().st_size} ".encode() + file.read_bytes())
        return pixels, sum_of_files.hexdigest()

    def files(self, frames):
        return sorted(file for file in (self.folder / frames).iterdir() if file.suffix in (".png", ".exr"))

    def crops_differ(self, path):
        """Which frames of a film that is rendered in part are not as that part of the whole picture."""
        whole, words = [], iter(output(path))
        for word in words:
            if word in PARTS:
                next(words)
            else:
                whole.append(word)
        alpha = [word for word in form(path) if word == "--alpha"]
        for frames, shown in (("part", output(path)), ("whole", whole)):
            shutil.rmtree(self.folder / frames, ignore_errors=True)
            self.run(["render", str(path), "-o", str(self.folder / frames), "--quiet", *alpha, *PLAIN_WORDS, *PLAIN_EXR,
                      *(word for word in shown if word not in PLAIN_EXR)])
        return [a.name for a, b in zip(self.files("part"), self.files("whole"), strict=True) if not is_part(Exr(a), Exr(b))]

    def edited(self, path, choose, count):
        """Edits the film `count` times. The commands, and the hash of its pixels in the folder of the film before."""
        before = json.loads(path.read_text())
        shutil.rmtree(self.folder / "before", ignore_errors=True)
        self.hash(path, CONTINUED, {}, "before")
        commands = [command for command in (self.edit(path, choose) for _ in range(count)) if command]
        after = json.loads(path.read_text())
        replaced = any(before.get(key) != after.get(key) for key in ("size", "samples"))
        return commands, self.hash(path, CONTINUED | ({"--overwrite": None} if replaced else {}), {}, "before")


def is_part(part, whole):
    """Whether two files have the same pixels where both have any."""
    left, top, *_ = struct.unpack("<4i", part.attributes["dataWindow"])
    first, behind = max(left, 0), min(left + part.width, whole.width)
    lines = range(max(top, 0), min(top + part.height, whole.height))
    return part.channels.keys() == whole.channels.keys() and all(
        part.channels[name][y - top][first - left:behind - left] == whole.channels[name][y][first:behind]
        for name in whole.channels for y in lines)


def shown(words, environment):
    return " ".join([f"{name}={value}" for name, value in (environment or {}).items()] + [shlex.quote(word) for word in words])


def described(path):
    film = json.loads(path.read_text())
    width, height = film["size"]
    text = f"{width}x{height}, {film['samples']} samples, {film['frames']} frames, {len(film['actors'])} actors"
    lights = f", {len(film['lights'])} lights" if "lights" in film else ""
    return " ".join([text + lights, *output(path)])


def compare(films, path, ways):
    """The pixels' hash of the plain way, and the commands of those that give another, or other bytes of files; of a film
    in part, also the command of the plain way if that is no part of the whole picture."""
    expected = films.content(path, PLAIN, {})
    wrong = []
    for way, environment in ways:
        command = shown(["mars", *films.words(path, way)], environment)
        try:
            if films.content(path, way, environment) != expected:
                wrong.append(command)
        except RuntimeError as failure:
            wrong.append(f"{command}: {failure}")
    if any(word in PARTS for word in output(path)) and (frames := films.crops_differ(path)):
        wrong.append(f"{shown(['mars', *films.words(path, PLAIN)], {})} is no part of the whole picture in {', '.join(frames)}")
    return expected[0], wrong


def keep(path, name, folder):
    if folder:
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, folder / name)


def kill(films, path, seed, mpi, pixels):
    """What differs after renderings that were killed; prints how many were."""
    killed = Killed(films, path, random.Random(f"kills of {seed}"), ["threads", "threads", *(["mpi"] if mpi else [])])
    wrong = []
    for what, differ in (("frames", lambda: killed.frames_differ(pixels)), ("its video", killed.videos_differ)):
        try:
            if differ():
                wrong.append(f"{what} of {path.name} ({killed.how}) differ after kills")
        except RuntimeError as failure:
            wrong.append(f"{what} of {path.name} ({killed.how}), killed and finished: {failure}")
    print(f"  killed  {killed.kills} times, of renderings of frames and of a video")
    return wrong


def examine(films, seed, options, mpi):
    """Renders a film, and the same film with edits; prints both. How many ways gave other pixels."""
    choose = random.Random(f"ways of {seed}")

    def examined(name):
        pixels, wrong = compare(films, path, [random_way(choose, mpi, path) for _ in range(options.ways - 1)])
        print(f"{name:>8}  {pixels}  {described(path)}", flush=True)
        return pixels, wrong

    path = films.write(seed)
    keep(path, path.name, options.keep)
    pixels, wrong = examined(str(seed))
    if options.edits:
        commands, continued = films.edited(path, random.Random(f"edits of {seed}"), options.edits)
        keep(path, f"{path.stem}-edited.json", options.keep)
        pixels, others = examined("edited")
        for command in commands:
            print(" " * 10 + shown(["mars", *command], {}), flush=True)
        wrong += others + ([f"{continued} in the folder of the film before its edits"] if continued != pixels else [])
    if options.kills:
        wrong += kill(films, path, seed, mpi, pixels)
    for text in wrong:
        print(f"WRONG: {text}", flush=True)
    return len(wrong)


def main():
    options = arguments()
    mpi = shutil.which("mpirun") is not None and (options.build / "bin" / "mars-host").exists()
    print("over threads and MPI" if mpi else "over threads: there is no MPI here", flush=True)
    with tempfile.TemporaryDirectory(prefix="mars-identity-") as folder:
        films = Films(options.build, folder)
        failures = sum(examine(films, seed, options, mpi) for seed in range(options.seed, options.seed + options.films))
    print(f"{options.films} films in {options.ways} ways each: " + (f"{failures} gave other files" if failures else "all alike"))
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
