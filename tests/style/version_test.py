"""The version is the same wherever it is written."""

import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from cases import main  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Where it is written, and what stands before it; the first of each file counts.
PLACES = {"CHANGELOG.md": r"^## ", "cluster/install/changelog": r"^mars \(", "cluster/modulefiles/mars": r"mars/",
          "cluster/spack/package.py": r'version\("', "docs/installing.md": r"mars_", "docs/doctor.md": r"^MARS "}


def version_in(file, before):
    found = re.search(before + r"(\d+\.\d+\.\d+)", (ROOT / file).read_text(), re.M)
    return found and found[1]


class Version(unittest.TestCase):
    def test_is_one(self):
        version = version_in("CMakeLists.txt", r"^project\(mars VERSION ")
        self.assertTrue(version)
        for file, before in PLACES.items():
            with self.subTest(file):
                self.assertEqual(version_in(file, before), version)


if __name__ == "__main__":
    main()
