#!/usr/bin/env python3
"""Runs fuzz targets, one after another, and prints how many inputs each took, how many a second, and what was found:

  fuzz.py BUILD                      every target for --seconds (default: 20)
  fuzz.py BUILD --runs N TARGET ...  these targets, for N inputs each

BUILD has the targets: build/fuzz with libFuzzer, other builds with MARS's own driver. Inputs that reach further stay in
BUILD/fuzz/TARGET and are used again; what was found lies in BUILD/fuzz/found-TARGET-*. Exit code 1 where anything was.

  fuzz.py BUILD --keep               adds to tests/fuzz/corpus the inputs that reach what none there reaches
"""

import argparse
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
LONGEST_INPUT = 20  # seconds
MOST_MEMORY = 2048  # MiB


def has_libfuzzer(build):
    return "fuzzer-no-link" in (build / "CMakeCache.txt").read_text()


def corpus_of(target):
    return HERE / "corpus" / target


def targets_of(build):
    if has_libfuzzer(build):
        return sorted(program.name for program in (build / "bin/fuzz").iterdir())
    return subprocess.run([build / "bin/fuzz-targets"], check=True, capture_output=True, text=True).stdout.split()


def libfuzzer_words(build, target, found, work, args):
    words = [build / "bin/fuzz" / target, f"-artifact_prefix={found}-", f"-timeout={LONGEST_INPUT}",
             f"-rss_limit_mb={MOST_MEMORY}", "-print_final_stats=1", f"-seed={args.seed}", "-verbosity=1"]
    words += [f"-runs={args.runs}"] if args.runs else [f"-max_total_time={args.seconds}"]
    return words + [work, corpus_of(target)]


def plain_words(build, target, found, args):
    limit = ["--runs", str(args.runs)] if args.runs else ["--seconds", str(args.seconds)]
    return [build / "bin/fuzz-targets", target, *limit, "--seed", str(args.seed), "--crash", found, corpus_of(target)]


def executions_in(text):
    found = re.findall(r"number_of_executed_units: (\d+)|^(\d+) executions", text, re.M)
    return int(next(filter(None, found[-1]))) if found else 0


def run_target(build, target, args):
    """Whether nothing was found."""
    work = build / "fuzz" / target
    work.mkdir(parents=True, exist_ok=True)
    found = build / "fuzz" / f"found-{target}"
    libfuzzer = has_libfuzzer(build)
    words = libfuzzer_words(build, target, found, work, args) if libfuzzer else plain_words(build, target, found, args)
    begin = time.monotonic()
    done = subprocess.run(words, capture_output=True, errors="replace")
    seconds = time.monotonic() - begin
    executions = executions_in(done.stdout + done.stderr)
    print(f"{target:14} {executions:10} executions {executions / seconds:10.0f} a second"
          f"   {'' if done.returncode == 0 else 'FOUND'}", flush=True)
    if done.returncode != 0:
        print(done.stderr[-3000:], file=sys.stderr, flush=True)
    return done.returncode == 0


def keep(build, target):
    work = build / "fuzz" / target
    words = [build / "bin/fuzz" / target, "-merge=1", "-max_len=4096", corpus_of(target), work]
    subprocess.run(words, check=True, capture_output=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("targets", nargs="*", metavar="TARGET")
    parser.add_argument("--seconds", type=int, default=20, help="of each target")
    parser.add_argument("--runs", type=int, default=0, help="inputs of each target, instead")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", action="store_true")
    args = parser.parse_intermixed_args()
    known = targets_of(args.build)
    if unknown := set(args.targets) - set(known):
        parser.error(f"{args.build} has no target {', '.join(sorted(unknown))}")
    targets = args.targets or known
    if args.keep:
        for target in targets:
            keep(args.build, target)
        return 0
    return 0 if all([run_target(args.build, target, args) for target in targets]) else 1


if __name__ == "__main__":
    sys.exit(main())
