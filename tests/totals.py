#!/usr/bin/env python3
"""Counts the cases of a run of the tests, and names those that were skipped with their reasons:

  totals.py RESULTS.xml ...                     as ctest --output-junit writes them; exit code 1 where a case failed
  totals.py --skips SKIPS.txt RESULTS.xml ...   only holds the skipped cases against a list; exit code 1 where one is not
                                                in it

The list has a line for each as it is printed here, with * for any text; # begins a comment. A test of ctest that names
no cases is one case.
"""

import argparse
import fnmatch
import pathlib
import re
import sys
import xml.etree.ElementTree

PASSED = re.compile(r"^\[  PASSED  \] (\d+) tests?\.$", re.M)
FAILED = re.compile(r"^\[  FAILED  \] (?!\d+ tests?, listed)(.+?)(?:, where .*?)?(?: \(\d+ ms\))?$", re.M)
SKIPPED = re.compile(r"\bSkipped\n((?:(?!\[ ).*\n)*)\[  SKIPPED \] (.+?)(?: \(\d+ ms\))?$", re.M)


def count(test):
    """Of one test of ctest: cases passed and failed, and a line for each that was skipped."""
    output = test.findtext("system-out", "").strip()
    if any(why.get("message").startswith("SKIP_") for why in test.iter("skipped")):  # others could not be started
        return 0, 0, [f"{test.get('name')}: {output.splitlines()[-1]}"]
    passed = sum(map(int, PASSED.findall(output)))
    failed = len(set(FAILED.findall(output)))
    skipped = [f"{test.get('name')} {case}: {' '.join(why.split())}" for why, case in SKIPPED.findall(output)]
    if test.get("status") != "run":
        return passed, max(failed, 1), skipped
    return passed + (not passed and not skipped), 0, skipped


def read_expected(path):
    lines = (line.partition("#")[0].strip() for line in path.read_text().splitlines())
    return [line for line in lines if line]


def hold_against(path, skipped):
    """Whether all are in the list; prints what differs."""
    expected = read_expected(path)
    surprising = [line for line in skipped if not any(fnmatch.fnmatchcase(line, each) for each in expected)]
    for line in surprising:
        print(f"skipped, but not in {path}: {line}")
    for each in expected:
        if not fnmatch.filter(skipped, each):
            print(f"in {path}, but not skipped: {each}")
    return not surprising


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, nargs="+")
    parser.add_argument("--skips", type=pathlib.Path)
    args = parser.parse_args()
    tests = [test for path in args.results for test in xml.etree.ElementTree.parse(path).getroot().iter("testcase")]
    passed, failed, skipped = zip(*map(count, tests))
    skipped = sum(skipped, [])
    if args.skips:
        sys.exit(not hold_against(args.skips, skipped))
    for line in skipped:
        print(f"skipped: {line}")
    print(f"{sum(passed)} passed, {sum(failed)} failed, {len(skipped)} skipped")
    sys.exit(sum(failed) > 0)


if __name__ == "__main__":
    main()
