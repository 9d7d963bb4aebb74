#!/usr/bin/env python3
"""What building and testing MARS costs, in processors' seconds of each target and of each test:

  costs.py BUILD                     builds afresh in the folder BUILD, runs all tests but the cluster's, prints a table
  costs.py BUILD --until TEST        ends after a stage: picture, programs, tests, quick, later-tests, later
  costs.py BUILD --against FILE      prints the costs of another run beside these
  costs.py --show FILE               prints the table of a run

BUILD/costs.json has all the figures. Every compiler, linker and test is started by `record`, which measures a process
with all processes that it waited for. Processors' seconds vary by a few percent from run to run, and with what else the
machine does by ten: compare runs of one quiet machine.
"""

import argparse
import collections
import json
import pathlib
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
QUICK = ["rule", "unit", "film", "word"]
LATER = ["world", "fault", "chance"]
MOST_ROWS = 25  # of single targets and tests
NO_RECORD = -1  # the code of a test that did not come to its end


def label_of(tiers):
    return f"^({'|'.join(tiers)})$"


def stages(build):
    """In order: name, what it is, commands. The first four are what ./bootstrap demo and test execute."""
    configure = ["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DMARS_BENCH=OFF",
                 f"-DCMAKE_PROJECT_INCLUDE={HERE / 'record.cmake'}"]
    make = ["cmake", "--build", build, "--target"]
    test = ["ctest", "--test-dir", build, "--parallel", "3", "--label-regex"]
    return {
        "picture": ("building what renders the first picture",
                    [configure + ["-DBUILD_TESTING=OFF"], make + ["mars-threads"]]),
        "programs": ("building all other programs", [make + ["all"]]),
        "tests": ("building the quick tests", [configure + ["-DBUILD_TESTING=ON"], make + ["all"]]),
        "quick": ("running the quick tests", [test + [label_of(QUICK)]]),
        "later-tests": ("building all other tests", [make + ["later", "tests/bench/all"]]),
        "later": ("running all other tests", [test + [label_of(LATER)]]),
    }


def read_records(log):
    """A record for each line of the log: kind, name, seconds that passed, processors' seconds, exit code."""
    records = []
    for line in log.read_text().splitlines() if log.exists() else []:
        kind, name, passed, user, system, code = line.rsplit(None, 4)[0].split(None, 1) + line.rsplit(None, 4)[1:]
        records.append((kind, name, float(passed), float(user) + float(system), int(code)))
    return records


def tiers_of_tests(build):
    listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, check=True)
    tiers = {}
    for test in json.loads(listed.stdout)["tests"]:
        labels = [p["value"] for p in test["properties"] if p["name"] == "LABELS"]
        tiers[test["name"]] = next((label for label in sum(labels, []) if label in QUICK + LATER), "none")
    return tiers


def run_stage(build, name, commands):
    """The stage's own records, the seconds that passed, and whether all commands succeeded."""
    log = build / "costs.log"
    before = len(read_records(log))
    begin, succeeded = time.monotonic(), True
    for command in commands:
        done = subprocess.run(list(map(str, command)), cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0 and command[0] == "cmake":
            sys.exit(f"costs: {' '.join(map(str, command))} failed:\n{done.stdout[-3000:]}")
        succeeded = succeeded and done.returncode == 0
    return read_records(log)[before:], time.monotonic() - begin, succeeded


def measure(build, until):
    shutil.rmtree(build, ignore_errors=True)
    build.mkdir(parents=True)
    costs = {"stages": {}, "targets": {}, "tests": {}}
    for name, (what, commands) in stages(build).items():
        print(f"costs: {what} ...", file=sys.stderr, flush=True)
        records, passed, succeeded = run_stage(build, name, commands)
        tiers = tiers_of_tests(build) if name in ["quick", "later"] else {}
        add_records(costs, name, records, passed, tiers)
        if not succeeded:
            add_tests_without_record(costs, {test: tier for test, tier in tiers.items()
                                             if tier in (QUICK if name == "quick" else LATER)})
        (build / "costs.json").write_text(json.dumps(costs, indent=1) + "\n")
        if name == until:
            break
    return costs


def add_records(costs, stage, records, passed, tiers):
    costs["stages"][stage] = {"passed": round(passed, 1), "processors": round(sum(r[3] for r in records), 1)}
    seconds = collections.Counter()
    for kind, name, test_passed, processors, code in records:
        if kind == "test":
            costs["tests"][name] = {"tier": tiers.get(name, "none"), "passed": round(test_passed, 2),
                                    "processors": round(processors, 2), "code": code}
        else:
            seconds[name] += processors
    for name, processors in seconds.items():
        target = costs["targets"].setdefault(name, {"stage": stage, "processors": 0})
        target["processors"] = round(target["processors"] + processors, 2)


def add_tests_without_record(costs, tiers):
    """ctest kills `record` together with a test that is too slow."""
    for name in tiers.keys() - costs["tests"].keys():
        costs["tests"][name] = {"tier": tiers[name], "passed": 0, "processors": 0, "code": NO_RECORD}


def row(name, *figures):
    return "| " + " | ".join([name, *("" if f is None else f"{f:.1f}" for f in figures)]) + " |"


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|---" + "|---:" * (len(head) - 1) + "|", *rows]) + "\n"


def stage_rows(all_costs):
    rows = []
    for name, (what, _) in stages(pathlib.Path()).items():
        figures = [costs["stages"].get(name, {}) for costs in all_costs]
        if any(figures):
            rows.append(row(what, *(f.get(key) for f in figures for key in ["processors", "passed"])))
    return rows


def tier_rows(all_costs):
    rows = []
    known = QUICK + LATER + ["none"]
    for tier in known + sorted({t["tier"] for costs in all_costs for t in costs["tests"].values()} - set(known)):
        tests = [[t for t in costs["tests"].values() if t["tier"] == tier] for costs in all_costs]
        if any(tests):
            rows.append(row(tier, *(sum(t[key] for t in each) for each in tests for key in ["processors", "passed"])))
    return rows


def largest_rows(all_costs, what, keys):
    """The most expensive of any of the runs."""
    most = collections.Counter()
    for costs in all_costs:
        for name, each in costs[what].items():
            most[name] = max(most[name], each["processors"])
    return [row(f"`{name}`", *(costs[what].get(name, {}).get(key) for costs in all_costs for key in keys))
            for name, _ in most.most_common(MOST_ROWS)]


def report(all_costs):
    heads = {1: [""], 2: ["before: ", "after: "]}[len(all_costs)]
    both = [head + text for head in heads for text in ["processors' s", "passed, s"]]
    return "\n".join([
        table(["stage", *both], stage_rows(all_costs)),
        table(["tests of tier", *both], tier_rows(all_costs)),
        table(["target", *(head + "processors' s" for head in heads)], largest_rows(all_costs, "targets", ["processors"])),
        table(["test", *both], largest_rows(all_costs, "tests", ["processors", "passed"]))])


def read_costs(path):
    try:
        costs = json.loads(pathlib.Path(path).read_text())
        report([costs])
        return costs
    except OSError as error:
        sys.exit(f"costs: {path} cannot be read: {error.strerror}")
    except (ValueError, TypeError, KeyError, AttributeError):
        sys.exit(f"costs: {path} is not a whole costs.json; name one that costs.py has written")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, nargs="?")
    parser.add_argument("--until", choices=stages(pathlib.Path()), default="later")
    parser.add_argument("--against", metavar="FILE")
    parser.add_argument("--show", metavar="FILE")
    args = parser.parse_args()
    if not args.build and not args.show:
        parser.error("name a folder to build in, or --show FILE")
    before = [read_costs(args.against)] if args.against else []  # now: measuring clears the folder that may have it
    costs = read_costs(args.show) if args.show else measure(args.build.resolve(), args.until)
    print(report([*before, costs]))
    failed = sorted(name for name, test in costs["tests"].items() if test["code"] not in (0, 77))
    if failed:
        sys.exit(f"costs: these tests failed: {' '.join(failed)}")


if __name__ == "__main__":
    main()
