"""tidy.py finds what .clang-tidy asks for, and topology/ has nothing of it: it stands for the whole tree, which takes
many minutes. Takes a build's folder."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from cases import main  # noqa: E402

BUILD = sys.argv[1]
MOVED = """#include <source_location>
#include <string>
#include <utility>
unsigned long after(std::string text, std::source_location = std::source_location::current()) {
  const std::string taken = std::move(text);
  return taken.size() + text.size();
}
"""


def tidy(*words):
    return subprocess.run([sys.executable, "-B", HERE / "tidy.py", *words], capture_output=True, text=True)


class Tidy(unittest.TestCase):
    def test_topology_is_tidy(self):
        done = tidy(BUILD, "topology")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"^tidy: [1-9]\d* files, 0 findings\n$")

    def test_mistakes_are_found(self):
        with tempfile.TemporaryDirectory(prefix="mars-tidy-") as name:
            folder = pathlib.Path(name)
            source = folder / "moved.cpp"
            source.write_text(MOVED)
            (folder / "compile_commands.json").write_text(json.dumps(
                [{"directory": name, "file": str(source), "command": f"c++ -std=c++20 -c {source}"}]))
            done = tidy(name, str(folder))
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            self.assertIn("'text' used after it was moved [bugprone-use-after-move", done.stdout)
            self.assertIn("tidy: 1 files, 1 findings\n", done.stdout)
            self.assertIn("the time is over", tidy(name, str(folder), "--seconds", "0").stdout)


if __name__ == "__main__":
    main()
