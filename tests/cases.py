"""The main function of test files in Python: it ends with the lines by which GoogleTest tells cases that passed, failed
and were skipped, for tests/totals.py."""

import sys
import unittest


def main():
    result = unittest.main(argv=[sys.argv[0]], verbosity=2, exit=False).result
    failed = [case_of(test) for test, _ in result.failures + result.errors] + result.unexpectedSuccesses
    skipped = [case_of(test) for test, _ in result.skipped]
    # Without what prepares a whole class, which does not count as run.
    others = {test.id() for test in failed + skipped if isinstance(test, unittest.TestCase)}
    print(f"[  PASSED  ] {result.testsRun - len(others)} tests.")
    for test in failed:
        print(f"[  FAILED  ] {name(test)}")
    for test, why in result.skipped:
        print(f"Skipped\n{why}\n[  SKIPPED ] {name(test)}")
    sys.exit(not result.wasSuccessful())


def case_of(test):
    """The case that a subtest is part of."""
    return getattr(test, "test_case", test)


def name(test):
    return test.id().replace("__main__.", "")
