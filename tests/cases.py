"""The main function of test files in Python: it ends with the lines by which GoogleTest tells cases that passed, failed
and were skipped, for tests/totals.py. SideBySide runs cases at once."""

import concurrent.futures
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


class Notes(unittest.TestResult):
    """What a case reports, in its order."""

    def __init__(self):
        super().__init__()
        for report in ["startTest", "stopTest", "addSuccess", "addError", "addFailure", "addSkip", "addSubTest",
                       "addExpectedFailure", "addUnexpectedSuccess"]:
            setattr(self, report, lambda *words, report=report: self.reports.append((report, words)))
        self.reports = []


class SideBySide(unittest.TestCase):
    """Cases that wait most of the time: AT_ONCE cases of a class run at once, each in a thread and with an object of its
    own. A setUpClass of a class calls this one last."""

    AT_ONCE = 4
    running = {}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        threads = concurrent.futures.ThreadPoolExecutor(cls.AT_ONCE)
        cls.addClassCleanup(threads.shutdown)
        cls.running = {each: threads.submit(cls(each).run_alone) for each in unittest.defaultTestLoader.getTestCaseNames(cls)}

    def run_alone(self):
        notes = Notes()
        super().run(notes)
        return notes

    def run(self, result=None):
        if self._testMethodName not in self.running:
            return super().run(result)  # the class is skipped
        for report, words in self.running[self._testMethodName].result().reports:
            getattr(result, report)(*words)
