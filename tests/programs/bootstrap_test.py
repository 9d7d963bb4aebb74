"""The verbs of ./bootstrap configure one build folder in any order: what one run of CMake finds stays in its cache for the
next. Started as: bootstrap_test.py PROGRAMS_FOLDER SOURCES_FOLDER."""

import itertools
import shutil
import subprocess

from harness import SOURCES, ProgramTest, main

# BUILD_TESTING and MARS_BENCH of each kind of verb.
VERBS = {"demo": ["OFF", "OFF"], "test": ["ON", "OFF"], "bench": ["OFF", "ON"]}

# Each kind follows each other kind once.
WALK = ["demo", "test", "demo", "bench", "test", "bench", "demo"]

# The cache of an earlier verb, which found no compiler: later verbs install packages.
WITHOUT_FORTRAN = "-DCMAKE_Fortran_COMPILER=NOTFOUND"


class Bootstrap(ProgramTest):
    def test_verbs_configure_in_any_order(self):
        self.assertEqual(sorted(zip(WALK, WALK[1:])), sorted(itertools.permutations(VERBS, 2)))
        for verb in WALK:
            tests, benchmarks = VERBS[verb]
            done = subprocess.run(["cmake", "--preset", "release", "-S", SOURCES, "-B", self.folder / "build",
                                   f"-DBUILD_TESTING={tests}", f"-DMARS_BENCH={benchmarks}", WITHOUT_FORTRAN],
                                  cwd=SOURCES, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 0, f"{verb}: {done.stdout[-3000:]}")
            if verb == "test" and shutil.which("gfortran"):
                self.assertIn("fortran_pi", (self.folder / "build/build.ninja").read_text())

    def bootstrap(self, *words):
        return subprocess.run([SOURCES / "bootstrap", *words], cwd=SOURCES, capture_output=True, text=True)

    def test_words_that_it_does_not_know_begin_nothing(self):
        for words in [["tset"], ["test", "all", "-R", "farm"], ["demo", "now"]]:
            done = self.bootstrap(*words)
            self.assertEqual((done.returncode, done.stderr.split("\n")[0]),
                             (2, f'bootstrap: there is no "{" ".join(words)}"; these are:'))

    def test_help_begins_nothing(self):
        for words in [["--help"], ["costs", "--help"], ["mutants", "--help"], ["fuzz", "--help"]]:
            done = self.bootstrap(*words)
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        self.assertIn("./bootstrap demo", self.bootstrap("--help").stdout)


if __name__ == "__main__":
    main()
