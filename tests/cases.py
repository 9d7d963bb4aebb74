"""The main function of test files in Python: it ends with the lines by which GoogleTest tells cases that passed, failed
and were skipped, for tests/totals.py."""

import sys
import unittest


def main():
    result = unittest.main(argv=[sys.argv[0]], verbosity=2, exit=False).result
    failed = [test for test, _ in result.failures + result.errors] + result.unexpectedSuccesses
    skipped = [test for test, _ in result.skipped]
    print(f"[  PASSED  ] {result.testsRun - len({case(test) for test in failed + skipped} - {None})} tests.")
    for test in failed:
        print(f"[  FAILED  ] {name(test)}")
    for test, why in result.skipped:
        print(f"Skipped\n{why}\n[  SKIPPED ] {name(test)}")
    sys.exit(not result.wasSuccessful())


def case(test):
    """Of a subtest the case that it is part of; none for what prepares a whole class."""
    return getattr(test, "test_case", test).id() if isinstance(test, unittest.TestCase) else None


def name(test):
    return test.id().replace("__main__.", "")
