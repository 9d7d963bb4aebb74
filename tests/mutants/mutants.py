#!/usr/bin/env python3
"""Judges the tests by mutants: MARS with one small mistake, such as < for <=, which a test should find.

  mutants.py list --seed 50 --count 30 [--check BUILD]   chooses mutants and writes tests/mutants/list.txt
  mutants.py run --build DIR [--tier quick|all] [--only N,...]

`list` spreads the mutants over the rooms of MAP.md by their lines, at most three in a room and at least one in each of
PLACES. The same seed chooses the same mutants of the same sources. With --check, BUILD's compiler looks whether a
mutant compiles. Some mutants change nothing that anybody could notice: write "passed over" instead of the mutant's
number, and the reason after a colon, and list again: the next one is taken.

`run` finds the list's mutants by their text, so lines may have moved, and compiles all of them into one build of a copy
of the sources in DIR, where the environment variable MUTANT_OF_MARS turns one on. All tests run once without a mutant;
those that fail then are left out. Then the tests run as each mutant until one fails twice: those of the quick tier
(labels unit, film and word) and, with --tier all, then the others. DIR/results.json keeps what was found, and a later
run goes on from there if the sources are the same. Exit code 1 where the quick tests find less than four mutants of
five or, with --tier all, where no test finds one of them."""

import argparse
import collections
import hashlib
import json
import pathlib
import random
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import trials
from candidates import KINDS, Mutant, Source, with_choices

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = ROOT / "tests/mutants/list.txt"
MOST_IN_A_ROOM = 3
PLACES = ["topology", "hal", "node/raster", "node/shading", "node/shadow", "node/geometry", "node/shape",
          "host/content/modeler", "host/content/animator", "host/content/importer", "host/content/film",
          "host/content/(keys|document)", "host/images", "host/render", "host/preview", "host/editing",
          "host/experiments", "host/videos", "host/shell", "host/studio", "host/(cli|child)"]


def read_list(text):
    """The mutants by their numbers, and the reason for each that is passed over."""
    numbered, passed_over = {}, {}
    for block in text.split("\n\n"):
        if begin := re.match(r"(?:(\d+)|passed over) (\S+):(\d+) (\w+)(?:: (.*))?\n", block):
            sides = [tuple(re.findall(rf"^  {sign} (.*)", block, re.M)) for sign in ("-", r"\+")]
            mutant = Mutant(begin[2], int(begin[3]), begin[4], *sides)
            if begin[1]:
                numbered[int(begin[1])] = mutant
            else:
                passed_over[mutant] = begin[5]
    return numbered, passed_over


def block_of(mark, mutant, why=""):
    return "\n".join([f"{mark} {mutant.place()}{why}", *(f"  - {line}" for line in mutant.before),
                      *(f"  + {line}" for line in mutant.after)])


def sources_of_rooms(root):
    """The paths of sources, by the folder in a table of MAP.md to which they belong: the one that is deepest."""
    rooms, files = [], collections.defaultdict(list)
    for row in re.findall(r"^\| (`(?:topology|hal|node|host)/[^|]*) \|", (root / "MAP.md").read_text(), re.M):
        first, *beside = [name.rstrip("/") for name in re.findall("`([^`]+)`", row)]
        rooms += [first, *(f"{first.rpartition('/')[0]}/{other}" for other in beside)]
    for path in sorted(file.relative_to(root).as_posix() for file in root.glob("*/**/*.cpp")):
        if around := [room for room in rooms if path.startswith(room + "/")]:
            files[max(around, key=len)].append(path)
    return files


class Chooser:
    def __init__(self, root, seed, passed_over, compiles):
        self.root, self.seed, self.compiles = root, seed, compiles
        self.passed_over = {mutant.key(): (mutant, why) for mutant, why in passed_over.items()}
        self.rooms, self.places = sources_of_rooms(root), collections.defaultdict(dict)
        for room, files in self.rooms.items():
            place = next((place for place in PLACES if re.match(f"{place}(/|$)", room)), "elsewhere")
            self.places[place][room] = sum((root / file).read_text().count("\n") for file in files)

    def choose(self, count):
        counts = {place: int(place != "elsewhere") for place in self.places}
        while sum(counts.values()) < count:
            counts[max(counts, key=lambda place: sum(self.places[place].values()) / (counts[place] + 1))] += 1
        choice, chosen, taken = random.Random(self.seed), [], collections.Counter()
        for place in sorted(place for place in counts for _ in range(counts[place])):
            lines = {room: lines for room, lines in self.places[place].items() if taken[room] < MOST_IN_A_ROOM}
            room = choice.choices(list(lines), lines.values())[0]
            taken[room] += 1
            chosen.append(self.mutant_in(room, chosen))
        return chosen

    def mutant_in(self, room, chosen):
        """Each kind of mutant is as probable as the others, however many there are of it."""
        kinds = list(KINDS)
        random.Random(f"{self.seed} {len(chosen)}").shuffle(kinds)
        sources = [Source(file, (self.root / file).read_text()) for file in self.rooms[room]]
        found = [mutant for source in sources for mutant in source.mutants()]
        rank = lambda mutant: hashlib.sha256(repr((self.seed, mutant.key())).encode()).hexdigest()
        for mutant in sorted(found, key=lambda mutant: (kinds.index(mutant.kind), rank(mutant), mutant.line)):
            is_near = any(other.file == mutant.file and abs(other.line - mutant.line) < 10 for other in chosen)
            if mutant.key() not in self.passed_over and not is_near:
                if self.compiles(mutant):
                    return mutant
                self.passed_over[mutant.key()] = mutant, "does not compile"
        raise SystemExit(f"{room} has no mutant left")


def compiler_of(build):
    """Whether a mutant compiles as its source does in a build, in which nothing is written."""
    commands = collections.defaultdict(list)
    home = re.search(r"CMAKE_HOME_DIRECTORY:INTERNAL=(.*)", (build / "CMakeCache.txt").read_text())[1]
    for entry in json.loads((build / "compile_commands.json").read_text()):
        together = pathlib.Path(entry["file"]).read_text() if "/Unity/" in entry["file"] else ""
        for file in re.findall(r'#include "(.*)"', together) or [entry["file"]]:
            commands[file.removeprefix(home + "/")].append(entry)

    def compiles(mutant):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "mutant.cpp"
            source.write_text(with_choices((ROOT / mutant.file).read_text(), {1: mutant}))
            codes = []
            for entry in commands[mutant.file]:
                words = shlex.split(entry["command"])
                words = [words[0], f"-I{ROOT}", *words[1:words.index("-o")], "-Werror=vla", "-fsyntax-only", source]
                codes.append(subprocess.run(words, cwd=entry["directory"], capture_output=True).returncode)
        return codes != [] and not any(codes)

    return compiles


def write_list(seed, count, build):
    passed_over = read_list(LIST.read_text())[1] if LIST.exists() else {}
    chooser = Chooser(ROOT, seed, passed_over, compiler_of(build) if build else lambda mutant: True)
    blocks = [f"# {count} mutants of seed {seed}, chosen by tests/mutants/mutants.py, and those that were passed over."]
    blocks += [block_of(number, mutant) for number, mutant in enumerate(chooser.choose(count), 1)]
    blocks += [block_of("passed over", mutant, f": {why}") for mutant, why in chooser.passed_over.values()]
    LIST.write_text("\n\n".join(blocks) + "\n")


def copy_sources(root, folder, numbered):
    """Copies the sources, in which each mutant becomes a choice; what is right already stays untouched, so that a later
    build compiles little. Returns a digest of all, and the numbers of the mutants that are there."""
    tracked = subprocess.run(["git", "ls-files", "-z"], cwd=root, check=True, capture_output=True, text=True).stdout
    contents = {name: (root / name).read_bytes() for name in tracked.split("\0") if (root / name).is_file()}
    there = {}
    for number, mutant in numbered.items():
        same = [each for each in Source(mutant.file, contents.get(mutant.file, b"").decode()).mutants()
                if each.key() == mutant.key()]
        if same:
            there[number] = min(same, key=lambda each: abs(each.line - mutant.line))
    for file in {mutant.file for mutant in there.values()}:
        within = {number: mutant for number, mutant in there.items() if mutant.file == file}
        contents[file] = with_choices(contents[file].decode(), within).encode()
    for left in folder.rglob("*"):
        if left.is_file() and left.relative_to(folder).as_posix() not in contents:
            left.unlink()
    for name, content in contents.items():
        copy = folder / name
        if not copy.is_file() or copy.read_bytes() != content:
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(content)
        shutil.copymode(root / name, copy)
    return hashlib.sha256(repr(sorted(contents.items())).encode()).hexdigest(), set(there)


def kept_results(path, digest):
    """The results that an earlier run has written of the same sources; none where they cannot be read."""
    nothing = {"digest": digest, "reference": {}, "mutants": {}}
    if not path.exists():
        return nothing
    try:
        kept = json.loads(path.read_text())
        if {key: type(value) for key, value in kept.items()} != {key: type(value) for key, value in nothing.items()}:
            raise ValueError
    except (ValueError, AttributeError):
        print(f"{path} is damaged: all tests run again", flush=True)
        return nothing
    return kept if kept["digest"] == digest else nothing


class Judge:
    """`kept` is what DIR/results.json has: how tests end without a mutant, and which test finds which mutant."""

    def __init__(self, folder, digest, tiers):
        self.path, self.logs, self.tiers = folder / "results.json", folder / "logs", tiers
        self.tests = [test for test in trials.tests_of(folder / "build") if test.tier() in tiers]
        self.kept = kept_results(self.path, digest)
        self.reference = self.kept["reference"]

    def save(self):
        written = self.path.with_suffix(".new")
        written.write_text(json.dumps(self.kept, indent=1))
        written.replace(self.path)

    def run_reference(self):
        tests = [test for test in self.tests if test.name not in self.reference]
        for test, outcome, seconds in trials.outcomes(tests, 0, lambda test: test.limit, self.logs / "0"):
            self.reference[test.name] = {"outcome": outcome, "seconds": seconds}
            self.save()
            if outcome != "passed":
                print(f"{test.name} is left out: {outcome} without a mutant", flush=True)

    def limit_of(self, test):
        return 3 * self.reference[test.name]["seconds"] + 20

    def find(self, number, mutant, tier):
        """The test of a tier that finds a mutant; a test that fails once and then passes finds nothing."""
        begin, unsure, logs = time.monotonic(), [], self.logs / str(number)
        tests = [test for test in self.tests
                 if test.tier() == tier and self.reference[test.name]["outcome"] == "passed"]
        tests.sort(key=lambda test: (-test.nearness(mutant.file), self.reference[test.name]["seconds"]))
        for test, outcome, _ in trials.outcomes(tests, number, self.limit_of, logs):
            seconds = time.monotonic() - begin
            if outcome not in ("passed", "skipped"):
                if next(trials.outcomes([test], number, self.limit_of, logs / "again"))[1] != "passed":
                    return {"found": test.name, "how": outcome, "seconds": seconds, "unsure": unsure}
                unsure.append(test.name)
        return {"found": None, "how": "", "seconds": time.monotonic() - begin, "unsure": unsure}

    def judge(self, number, mutant):
        """The tier in which a test finds the mutant, or nothing."""
        kept = self.kept["mutants"].setdefault(repr(mutant.key()), {})
        for tier in self.tiers:
            if tier not in kept:
                kept[tier] = self.find(number, mutant, tier)
                self.save()
            found = kept[tier]
            print(f"{number:3}  {mutant.place():72} {tier:5}  {found['seconds']:6.1f} s  "
                  f"{found['found'] or 'not found'} {found['how']}", flush=True)
            if found["found"]:
                return tier
        return None


def run(folder, tiers, only):
    numbered, folder = read_list(LIST.read_text())[0], folder.resolve()
    if unknown := sorted((only or set()) - numbered.keys()):
        sys.exit(f"mutants: {LIST.relative_to(ROOT)} has no {unknown[0]}; its last is {max(numbered)}")
    digest, there = copy_sources(ROOT, folder / "tree", numbered)
    tree, build = folder / "tree", folder / "build"
    subprocess.run(["cmake", "-S", tree, "-B", build, "--preset", "release", "-DBUILD_TESTING=ON"], check=True)
    targets = {"quick": ["all"], "all": ["later", "tests/bench/all"]}
    subprocess.run(["cmake", "--build", build, "--target", *(name for tier in tiers for name in targets[tier])], check=True)
    judge = Judge(folder, digest, tiers)
    judge.run_reference()
    gone = (only or numbered.keys()) - there
    for number in sorted(gone):
        print(f"{number:3}  {numbered[number].place()}: its text is gone; list the mutants again")
    judged = {number: judge.judge(number, numbered[number]) for number in sorted(there & (only or there))}
    counts = collections.Counter(judged.values())
    print(f"{len(judged)} mutants; " + "; ".join(f"found in tier {tier}: {counts[tier]}" for tier in tiers))
    for number, tier in judged.items():
        if not tier:
            print(f"No test finds {block_of(number, numbered[number])}")
    too_few = 5 * counts["quick"] < 4 * len(judged) or ("all" in tiers and counts[None])
    return 1 if gone or too_few else 0


def numbers(text):
    return {int(number) for number in text.split(",")}


def end_by(number, _):
    """Ends as by an exception, so that the tests that run end, too."""
    sys.exit(128 + number)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    lister = commands.add_parser("list", help="chooses mutants")
    lister.add_argument("--seed", type=int, default=50)
    lister.add_argument("--count", type=int, default=30)
    lister.add_argument("--check", type=pathlib.Path, metavar="BUILD", help="whose compiler looks at each mutant")
    runner = commands.add_parser("run", help="runs the tests as each mutant")
    runner.add_argument("--build", type=pathlib.Path, required=True, metavar="DIR")
    runner.add_argument("--tier", choices=["quick", "all"], default="quick")
    runner.add_argument("--only", type=numbers, metavar="N,...")
    args = parser.parse_args()
    for ending in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
        signal.signal(ending, end_by)
    if args.command == "list":
        return write_list(args.seed, args.count, args.check)
    return run(args.build, ["quick", "all"] if args.tier == "all" else ["quick"], args.only)


if __name__ == "__main__":
    sys.exit(main())
