#!/usr/bin/env python3
"""Holds the pages that people read to three rules: no page of docs/ is longer than 250 lines; every link to a file or
a heading leads there; every file that CONTRIBUTING.md and MAP.md name exists."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONGEST = 250
CODE = re.compile(r"```.*?```", re.S)
LINK = re.compile(r"\[([^\]]*)\]\(([^)\s]+)\)")
NAMED = re.compile(r"`((?:host|node|hal|topology|tests|cluster|docs|examples)/[\w./-]*[\w/])`")


def pages():
    return [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("tests/**/README.md"), *ROOT.glob("cluster/**/*.md")]


def anchors(page):
    """As GitHub names headings."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", CODE.sub("", page.read_text()), re.M):
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower().replace("`", "")
        found.add(re.sub(r"[^\w\- ]", "", text).strip().replace(" ", "-"))
    return found


class Pages(unittest.TestCase):
    def test_are_not_long(self):
        for page in (ROOT / "docs").glob("**/*.md"):
            lines = len(page.read_text().splitlines())
            self.assertLessEqual(lines, LONGEST, f"{page.relative_to(ROOT)}: move a part to a page of its own")

    def test_link_to_what_there_is(self):
        for page in pages():
            for text, target in LINK.findall(CODE.sub("", page.read_text())):
                if re.match(r"\w+:", target):
                    continue
                name, _, anchor = target.partition("#")
                file = (page.parent / name).resolve() if name else page
                self.assertTrue(file.exists(), f"{page.relative_to(ROOT)}: {target}")
                if anchor:
                    self.assertIn(anchor, anchors(file), f"{page.relative_to(ROOT)}: {target}")
                if re.fullmatch(r"[\w-]+\.md", text):
                    self.assertEqual(text, pathlib.PurePath(file).name, f"{page.relative_to(ROOT)}: {target}")

    def test_of_recipes_name_files_that_there_are(self):
        for page in ("CONTRIBUTING.md", "MAP.md"):
            for name in NAMED.findall((ROOT / page).read_text()):
                if re.search(r"YOURS|NAME|your_|\.\.", name):
                    continue
                there = any((ROOT / below / name).exists() for below in ("", "tests")) or list(ROOT.glob(name + ".*"))
                self.assertTrue(there, f"{page}: {name}")


if __name__ == "__main__":
    sys.exit(unittest.main())
