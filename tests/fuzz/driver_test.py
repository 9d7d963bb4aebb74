"""MARS's own driver of fuzz targets. Started as: driver_test.py PROGRAM FOLDER; the program has the targets of planted/,
one of which has a bug, the folder is where findings go."""

import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from cases import main  # noqa: E402

PROGRAM, FOUND = map(pathlib.Path, sys.argv[1:3])


def run(*words, folder=None):
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True)


class Driver(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.corpora = pathlib.Path(folder.name)
        for target in ("before", "finding", "later"):
            (self.corpora / target).mkdir()
            (self.corpora / target / "good").write_text("good")
        self.found = FOUND / "crash-finding"
        self.found.unlink(missing_ok=True)

    def expect_finding(self, done):
        self.assertIn(f"\nfinding, bad: the input is in {self.found}\n", done.stderr)
        self.assertEqual(self.found.read_text(), "deadly")
        self.found.unlink()

    def test_a_finding_stays_in_the_build(self):
        (self.corpora / "finding/bad").write_text("deadly")
        with tempfile.TemporaryDirectory() as here:
            done = run("finding", self.corpora / "finding", folder=here)
            self.assertEqual(list(pathlib.Path(here).iterdir()), [])
        self.assertEqual(done.returncode, -signal.SIGABRT, done.stderr)
        self.expect_finding(done)

    def test_all_corpora_are_replayed_though_one_has_a_finding(self):
        (self.corpora / "finding/bad").write_text("deadly")
        done = run("--replay", self.corpora)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, "(?s)before: 1 executions.*later: 1 executions")
        self.assertIn("targets that failed: finding\n", done.stderr)
        self.expect_finding(done)
        self.assertEqual(run("--replay", self.corpora, "before", "later").returncode, 0)

    def test_a_target_without_a_corpus_is_no_sound_one(self):
        (self.corpora / "later/good").unlink()
        done = run("--replay", self.corpora)
        self.assertEqual(done.returncode, 1)
        self.assertIn("targets that failed: later\n", done.stderr)

    def test_names_are_listed_and_others_refused(self):
        self.assertEqual(run().stdout, "before\nfinding\nlater\n")
        for words in (["none"], ["--replay", self.corpora, "none"], ["--replay"]):
            self.assertEqual(run(*words).returncode, 2)


if __name__ == "__main__":
    main()
