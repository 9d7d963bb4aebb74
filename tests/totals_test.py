"""A skipped case shows by its name and reason, whatever tells it: GoogleTest, a test in Python, CMake. And what CI runs
and makes of the totals. Takes ctest."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from cases import main

TESTS = pathlib.Path(__file__).parent
GOOGLE_TEST = """[ RUN      ] Sets.Sse2
[       OK ] Sets.Sse2 (0 ms)
[ RUN      ] Sets.Avx512
/sets_test.cpp:12: Skipped
this CPU has no avx512

[  SKIPPED ] Sets.Avx512 (3 ms)
[  PASSED  ] 1 test.
[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] Sets.Avx512
"""
FAILED_THOUGH_SKIPPED = """[ RUN      ] Sets.Sums
/sets_test.cpp:12: Skipped
this CPU has no avx512

/sets_test.cpp:20: Failure
[  FAILED  ] Sets.Sums (3 ms)
[  FAILED  ] 1 test, listed below:
[  FAILED  ] Sets.Sums
"""
PYTHON = """import unittest
from cases import main
class Disks(unittest.TestCase):
    def test_full(self): pass
    def test_small(self):
        with self.subTest(size=1): self.skipTest("may not mount")
        with self.subTest(size=2): pass
class Peers(unittest.TestCase):
    @classmethod
    def setUpClass(cls): raise unittest.SkipTest("none was built")
    def test_all(self): pass
main()
"""
FULL_FAILS = """full(self):
        for i in 1, 2:
            with self.subTest(i): self.fail()
"""
CLUSTER = "echo 2 passed, 0 failed, 1 skipped"
LINES = ["google Sets.Avx512: this CPU has no avx512", "python Disks.test_small (size=1): may not mount",
         "python setUpClass (Peers): none was built", "mpi: built without MPI"]


class Totals(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="mars-totals-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "output").write_text(GOOGLE_TEST)
        (self.folder / "disks_test.py").write_text(PYTHON)
        python = f'"{sys.executable}" disks_test.py'
        self.tests = f"""add_test(google sh -c "cat output; ! grep -q FAILED output")
add_test(python {python})
set_tests_properties(python PROPERTIES ENVIRONMENT PYTHONPATH={TESTS})
add_test(mpi echo "built without MPI")
set_tests_properties(mpi PROPERTIES SKIP_REGULAR_EXPRESSION ".")
add_test(plain true)
"""

    def totals(self, *words):
        (self.folder / "CTestTestfile.cmake").write_text(self.tests)
        subprocess.run([sys.argv[1], "--output-junit", "tests.xml"], cwd=self.folder, capture_output=True)
        return subprocess.run([sys.executable, TESTS / "totals.py", "tests.xml", *words], cwd=self.folder,
                              capture_output=True, text=True)

    def test_counts_cases(self):
        done = self.totals()
        shown = "".join(f"skipped: {line}\n" for line in LINES)
        self.assertEqual(done.stdout, shown + "3 passed, 0 failed, 4 skipped\n")
        self.assertEqual(done.returncode, 0)

    def test_counts_what_fails_without_a_word(self):
        self.tests += "add_test(crash false)\nadd_test(lost ./not-built)\n"
        done = self.totals()
        self.assertIn("\n3 passed, 2 failed, 4 skipped\n", done.stdout)
        self.assertEqual(done.returncode, 1)

    def test_counts_failed_cases(self):
        (self.folder / "output").write_text(FAILED_THOUGH_SKIPPED + GOOGLE_TEST)
        (self.folder / "disks_test.py").write_text(PYTHON.replace("full(self): pass", FULL_FAILS))
        self.assertIn("\n2 passed, 2 failed, 4 skipped\n", self.totals().stdout)

    def test_adds_up_several_runs(self):
        self.assertIn("\n6 passed, 0 failed, 8 skipped\n", self.totals("tests.xml").stdout)

    def test_holds_skips_against_a_list(self):
        expected = self.folder / "skips.txt"
        expected.write_text("# why\n" + "\n".join(LINES[:3]) + "\nmpi: built*   # elsewhere\n")
        done = self.totals("--skips", "skips.txt")
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        expected.write_text("\n".join(LINES[1:]) + "\nnetwork: *\n")
        done = self.totals("--skips", "skips.txt")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout.splitlines(), [f"skipped, but not in skips.txt: {LINES[0]}",
                                                    "in skips.txt, but not skipped: network: *"])


class Ci(unittest.TestCase):
    def ci(self, bare, test):
        """Exit code, last line, and whether ./bootstrap test ran outside; `bare` and `test` are what these do."""
        with tempfile.TemporaryDirectory(prefix="mars-ci-") as name:
            folder = pathlib.Path(name)
            scripts = {"bin/debootstrap": "", "tests/bare/bare_debian.sh": bare,
                       "bootstrap": f'echo "$1" >>ran; case $1 in test) {test};; cluster) {CLUSTER};; esac'}
            for path, does in scripts.items():
                (folder / path).parent.mkdir(parents=True, exist_ok=True)
                (folder / path).write_text(f"#!/bin/sh\n{does}\n")
                (folder / path).chmod(0o755)
            (folder / ".ci").mkdir()
            shutil.copy(TESTS.parent / ".ci/run", folder / ".ci/run")
            done = subprocess.run([folder / ".ci/run"], capture_output=True, text=True,
                                  env=dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}"))
            ran = (folder / "ran").read_text() if (folder / "ran").exists() else ""
            return done.returncode, done.stdout.splitlines()[-1], "test" in ran

    def test_adds_up_the_bare_system_and_the_cluster(self):
        cluster = os.geteuid() == 0
        self.assertEqual(self.ci("echo 3 passed, 0 failed, 1 skipped", test="false"),
                         (0, f"{3 + 2 * cluster} passed, 0 failed, {1 + cluster} skipped", False))

    def test_runs_here_where_there_is_no_bare_system(self):
        code, last, here = self.ci("exit 3", test="echo 4 passed, 1 failed, 0 skipped; exit 1")
        self.assertRegex(last, r"^\d passed, 1 failed, ")
        self.assertEqual((code, here), (1, True))

    def test_fails_where_the_bare_system_does(self):
        self.assertEqual(self.ci("echo 3 passed, 0 failed, 1 skipped; exit 1", test="false")[0], 1)
        self.assertEqual(self.ci("exit 3", test="exit 1")[0], 1)


if __name__ == "__main__":
    main()
