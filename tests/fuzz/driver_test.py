"""MARS's own driver of fuzz targets. Started as: driver_test.py PROGRAM FOLDER; the program is a target with a bug
(planted/), the folder where its findings go."""

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


class Driver(unittest.TestCase):
    def test_a_finding_stays_in_the_build(self):
        found = FOUND / f"crash-{PROGRAM.name}"
        found.unlink(missing_ok=True)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        with tempfile.TemporaryDirectory() as corpus, tempfile.TemporaryDirectory() as here:
            (pathlib.Path(corpus) / "input").write_text("deadly")
            done = subprocess.run([PROGRAM, corpus], cwd=here, capture_output=True, text=True, timeout=20)
            self.assertEqual(list(pathlib.Path(here).iterdir()), [])
        self.assertEqual(done.returncode, -signal.SIGABRT, done.stderr)
        self.assertIn(f"the input is in {found}\n", done.stderr)
        self.assertEqual(found.read_text(), "deadly")
        found.unlink()


if __name__ == "__main__":
    main()
