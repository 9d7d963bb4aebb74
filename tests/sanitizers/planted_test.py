"""Sanitizers report where ./bootstrap sanitize looks, also where the environment is empty. Started as: planted_test.py
PROGRAM REPORTS ERROR..., with the errors of planted.cpp that this build's sanitizers find."""

import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from cases import main  # noqa: E402

PROGRAM, REPORTS, ERRORS = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:]
SIGNS = {"buffer": "heap-buffer-overflow", "number": "signed integer overflow", "leak": "detected memory leaks",
         "race": "data race"}


class Planted(unittest.TestCase):
    def reported(self, *words):
        """What the program, given these words, reported; the reports are gone then."""
        done = subprocess.Popen([PROGRAM, *words], env={}, stdout=subprocess.DEVNULL)
        code = done.wait(60)
        files = list(REPORTS.glob(f"report.{PROGRAM.name}.{done.pid}"))
        text = "".join(file.read_text() for file in files)
        for file in files:
            file.unlink()
        return code, text

    def test_each_error_is_reported(self):
        for error in ERRORS:
            with self.subTest(error=error):
                code, text = self.reported(error)
                self.assertEqual(code, 99)
                self.assertIn(SIGNS[error], text)
                self.assertIn("planted.cpp:", text)

    def test_no_error_is_not(self):
        self.assertEqual(self.reported(), (0, ""))


if __name__ == "__main__":
    main()
