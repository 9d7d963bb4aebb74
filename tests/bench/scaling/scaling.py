#!/usr/bin/env python3
"""How fast a film renders on more and more nodes: a strong and weak scaling study
on this machine, on the machines of a hostfile, or in a Slurm job. Every run
becomes a line of DIR/runs.jsonl, at once. Then a table is printed, and a report
with pictures is made: DIR/report.html (this takes Matplotlib).
docs/experiments.md says what it shows.

With --against PROGRAM, another mars, each run is made by both in turns: A is
PROGRAM, B is this mars. Then it says what differs (mars bench compare DIR).

Words after -- are options of mars render, for every run:
  mars bench scaling FILM -- --frames 0-9 --no-coherence"""
import argparse
import importlib.util
import json
import os
import shlex
import shutil
import subprocess
import sys
import time

import environment
import runs
import study
from study import Trouble

PLOTTED = importlib.util.find_spec("matplotlib") is not None


def words(convert=str):
    return lambda text: [convert(word) for word in text.split(",")]


def powers_of_two(most):
    return [2**k for k in range(most.bit_length())]


def read_command_line(arguments):
    split = arguments.index("--") if "--" in arguments else len(arguments)
    parser = argparse.ArgumentParser(prog="mars bench scaling", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("films", nargs="*", metavar="FILM",
                        help="a film; or NODES:FILM for a weak study with a film for each number of nodes")
    parser.add_argument("--nodes", type=words(int), metavar="N,N", help="default: 1, 2, 4, ... up to the processors")
    parser.add_argument("--study", type=words(), metavar="strong,weak",
                        help="strong: the same film on all numbers of nodes; weak: pictures of as many pixels a node; "
                             "default: both, with --against strong")
    parser.add_argument("--hostfile", help="machines to use, as for mars render")
    for axis in study.AXES:
        where = "a film's key" if axis == "dice" else "as for mars render"
        parser.add_argument(f"--{axis}", type=words(), metavar="A,B", help=f"each in turn; {where}")
    parser.add_argument("--against", metavar="PROGRAM", help="compare with another mars, which takes turns with this one")
    parser.add_argument("--repeats", type=int, help="runs of each configuration that count; default: 5, with --against 20")
    parser.add_argument("--warm-up", type=int, default=1, help="runs of each before, that do not; default: 1")
    parser.add_argument("--seed", type=int, default=1, help="of the order in which configurations take turns")
    parser.add_argument("-o", dest="folder", metavar="DIR", default="scaling",
                        help="for the runs and the report; seen by all machines; default: scaling")
    parser.add_argument("--read", nargs="+", metavar="RUNS.jsonl", help="report these studies' runs; render nothing")
    wanted = parser.parse_args(arguments[:split])
    wanted.options = arguments[split + 1:]
    if bool(wanted.films) == bool(wanted.read):
        parser.error("name the films to render, or with --read the runs to report")
    wanted.study = wanted.study or (["strong"] if wanted.against else study.KINDS)
    if not set(wanted.study) <= set(study.KINDS):
        parser.error(f"--study takes {', '.join(study.KINDS)}")
    if wanted.against and not shutil.which(wanted.against):
        parser.error(f"--against takes a program mars: there is none at {wanted.against}")
    if wanted.repeats is None:
        wanted.repeats = 20 if wanted.against else 5
    if wanted.repeats < 1 or wanted.warm_up < 0 or min(wanted.nodes or [1]) < 1:
        parser.error("--repeats and --nodes count from 1, --warm-up from 0")
    return wanted


def picture_size(build, film):
    done = subprocess.run([os.path.join(build, "bin", "mars"), "info", film], capture_output=True, text=True)
    if done.returncode != 0:
        raise Trouble(done.stderr.strip())
    width, _, height = environment.found(r"^size\s+(.*)", done.stdout).split()
    return int(width), int(height)


def pairs_of(films):
    """(nodes, film) of each NODES:FILM; none where films are no pairs."""
    parts = [film.partition(":") for film in films]
    pairs = [(int(nodes), film) for nodes, colon, film in parts if colon and nodes.isdigit()]
    if pairs and len(pairs) < len(films):
        raise Trouble("either all films are NODES:FILM or none")
    return sorted(pairs)


def configurations(wanted):
    axes = {axis: getattr(wanted, axis) for axis in study.AXES}
    pairs = pairs_of(wanted.films)
    if pairs and wanted.nodes:
        raise Trouble("NODES:FILM names the nodes already: leave --nodes out")
    if pairs:
        return list(study.weak_pairs(pairs, axes))
    nodes = sorted(set(wanted.nodes or powers_of_two(environment.processors(wanted.hostfile)[0])))
    own_size = lambda film: picture_size(wanted.build, film)
    of_kind = {"strong": lambda: study.strong(wanted.films, nodes, axes),
               "weak": lambda: study.weak(wanted.films, nodes, axes, own_size)}
    return list(dict.fromkeys(each for kind in study.KINDS if kind in wanted.study for each in of_kind[kind]()))


def header_of(wanted, arguments):
    command = ["mars", "bench", "scaling", *arguments[arguments.index("--build") + 2:]]
    return {"format": runs.FORMAT, "command": shlex.join(command), "folder": os.getcwd(), "seed": wanted.seed,
            "repeats": wanted.repeats, "warm_up": wanted.warm_up, "began": time.strftime("%Y-%m-%dT%H:%M:%S%z")}


def progress(done, count, began, line):
    left = (time.monotonic() - began) / done * (count - done)
    series = line["series"]
    settings = "".join(f", {axis} {value}" for axis, value in series["settings"].items())
    result = "failed" if "failure" in line else f"{line['seconds']:.3f} s"
    print(f"{done} of {count}: {series['film']}, {series['kind']}{settings}, nodes {line['nodes']}: {result}; "
          f"{left:.0f} s left", flush=True)


def programs(wanted):
    """By the setting `program`, which a study of one program does not have."""
    own = os.path.join(wanted.build, "bin", "mars")
    return dict(zip(study.PROGRAMS, (shutil.which(wanted.against), own))) if wanted.against else {None: own}


def make_folder(folder):
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise Trouble(f"{folder}: no folder for the study: {error.strerror} (name another with -o)") from None


def measure(wanted, arguments):
    """Runs all, and writes each run as it ends. Returns the file's name."""
    make_folder(wanted.folder)
    path = os.path.join(wanted.folder, "runs.jsonl")
    if os.path.exists(path):
        raise Trouble(f"{path} has a study already: name another folder with -o, or report it with --read {path}")
    turns = study.turns(configurations(wanted), wanted.warm_up, wanted.repeats, wanted.seed)
    turns = list(study.in_pairs(turns, wanted.seed) if wanted.against else turns)
    runners = {program: runs.Runner(mars, os.path.abspath(wanted.folder), wanted.hostfile, wanted.options)
               for program, mars in programs(wanted).items()}
    began = time.monotonic()
    with open(path, "w") as file:
        print(json.dumps(header_of(wanted, arguments)), file=file)
        for done, (configuration, repeat) in enumerate(turns, 1):
            line = runners[configuration.setting("program")].run(configuration, repeat)
            print(json.dumps(line), file=file, flush=True)
            progress(done, len(turns), began, line)
    return path


def show(paths, folder):
    """Prints the table and makes the report. Returns the exit code: 1 where a run failed."""
    if not PLOTTED:
        print(f"Without Matplotlib no table and report are made (Debian: python3-matplotlib). Where it is:\n"
              f"  mars bench scaling --read {' '.join(paths)} -o {folder}")
        return 0
    import answers
    import changes
    import findings
    import report
    import results
    import table
    found = results.Results([runs.read(path) for path in paths])
    print("\n" + table.text(found))
    if found.compares:
        print(answers.tables(changes.of_programs(found)))
    print("\n\n".join(findings.all_of(found)))
    print(f"\nReport: {report.write(found, folder)}")
    return 1 if found.failures else 0


def main():
    arguments = sys.argv[1:]
    wanted = read_command_line(arguments)
    paths = wanted.read or [measure(wanted, arguments)]
    make_folder(wanted.folder)
    return show(paths, wanted.folder)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Trouble as trouble:
        sys.exit(f"mars bench scaling: {trouble}")
    except KeyboardInterrupt:
        sys.exit("mars bench scaling: stopped; --read reports the runs until now")
