"""The pages that show a person what to type hold what they say: their commands are run as they stand, what they
print is what the page says, and the page's pictures are those the commands make.

A block ```sh is run by bash in the page's folder; a block ```text after it is what it prints, `...` standing for any
lines. A picture images/PAGE/NAME.png is made by the commands as NAME.png.
To make the pictures anew: tutorial_test.py PROGRAMS SOURCES --make-pictures
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest
import zlib

MAKE_PICTURES = "--make-pictures" in sys.argv
from harness import ENVIRONMENT, PROGRAMS, SOURCES, ProgramTest, main  # noqa: E402

PAGES = ["tutorial.md"]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks_of(page):
    """(kind, text, line) of each block."""
    return [(block[1], block[2], page.count("\n", 0, block.start()) + 1) for block in BLOCK.finditer(page)]


def pattern_of(expected):
    """What a ```text block stands for."""
    lines = [".*" if line.strip() == "..." else re.escape(line.rstrip()) for line in expected.rstrip().split("\n")]
    return re.compile("\n".join(lines), re.DOTALL)


def pixels_of(path):
    """A PNG file's header and rows; equal for equal pictures, whatever compressed them."""
    data, at, kept, packed = path.read_bytes(), 8, [], b""
    while at < len(data):
        length, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        chunk = data[at + 8:at + 8 + length]
        kept += [chunk] * (kind == b"IHDR")
        packed += chunk * (kind == b"IDAT")
        at += 12 + length
    return kept, zlib.decompress(packed)


class Pages(ProgramTest):
    def run_commands(self, commands, where):
        environment = dict(ENVIRONMENT, PATH=f"{PROGRAMS}:{os.environ['PATH']}")
        done = subprocess.run(["bash", "-euc", commands], cwd=self.folder, env=environment, capture_output=True, text=True,
                              timeout=120)
        self.assertEqual((done.returncode, done.stderr), (0, ""), f"{where}\n{commands}\n{done.stdout}")
        return "\n".join(line.rstrip() for line in done.stdout.rstrip().split("\n"))

    def run_page(self, name):
        path = SOURCES / "docs" / name
        page, printed, ran = path.read_text(), "", 0
        for kind, text, line in blocks_of(page):
            where = f"docs/{name}:{line}"
            if kind == "sh":
                printed, ran = self.run_commands(text, where), ran + 1
            elif kind == "text":
                self.assertRegex(printed, re.compile("^" + pattern_of(text).pattern + "$", re.DOTALL), where)
        self.assertGreater(ran, 0, "the page has no commands")
        for picture in re.findall(r"!\[[^]]+\]\((images/%s/[^)]+)\)" % path.stem, page):
            self.check_picture(path.parent / picture)

    def check_picture(self, shown):
        made = self.folder / shown.name
        self.assertTrue(made.exists(), f"no command makes {shown.name}")
        if MAKE_PICTURES:
            shown.parent.mkdir(exist_ok=True)
            shutil.copy(made, shown)
        self.assertEqual(pixels_of(made), pixels_of(shown), shown.name)

    def test_pages(self):
        for page in PAGES:
            with self.subTest(page=page):
                self.run_page(page)

    def test_a_page_that_is_wrong_is_told(self):
        """The test itself can fail."""
        self.assertRegex("a\nb\nc\nd", pattern_of("a\n...\nd"))
        self.assertNotRegex("a\nb", re.compile("^" + pattern_of("b\n").pattern + "$"))
        with self.assertRaises(AssertionError):
            self.run_commands("mars info nowhere.json", "here")
        with self.assertRaises(AssertionError):
            self.check_picture(pathlib.Path("images/none.png"))


if __name__ == "__main__":
    main()
