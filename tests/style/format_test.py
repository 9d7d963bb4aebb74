"""All C++ and C sources are laid out as .clang-format says. Takes clang-format."""

import os
import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from cases import main  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["topology", "hal", "node", "host", "tests", "examples"]
CLANG_FORMAT = sys.argv[1]


def sources():
    files = [file for folder in FOLDERS for file in (ROOT / folder).rglob("*")]
    return sorted(str(file.relative_to(ROOT)) for file in files if file.suffix in (".h", ".cpp", ".c"))


def run(files):
    """What clang-format says of the files; as many processes as processors look."""
    shares = len(os.sched_getaffinity(0))
    running = [subprocess.Popen([CLANG_FORMAT, "--dry-run", "-Werror", "--ferror-limit=1", *files[i::shares]], cwd=ROOT,
                                stderr=subprocess.PIPE, text=True) for i in range(shares)]
    return "".join(process.communicate()[1] for process in running)


class Format(unittest.TestCase):
    def test_all_sources_are_laid_out_alike(self):
        files = sources()
        self.assertGreater(len(files), 300, "nothing to scan: the test is broken")
        said = run(files)
        wrong = sorted(set(re.findall(r"^(\S+?):\d+:\d+: error: code should be clang-formatted", said, re.M)))
        if wrong:
            self.fail(f"lay them out: {CLANG_FORMAT} -i {' '.join(wrong)}")
        self.assertEqual(said, "")


if __name__ == "__main__":
    main()
