#!/usr/bin/env python3
"""Holds the pages that people read to five rules: no page of docs/ is longer than 250 lines; every link to a file or a
heading leads there; every table has its heading; every file that CONTRIBUTING.md and MAP.md name exists; so does every
name of the code that CONTRIBUTING.md's recipes tell people to change."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONGEST = 250
CODE = re.compile(r"```.*?```", re.S)
LINK = re.compile(r"\[([^\]]*)\]\(([^)\s]+)\)")
FOLDERS = ("host", "node", "hal", "topology", "tests", "cluster", "docs", "examples")
FOREIGN = {"mpi.h", "hwloc.h", "png.h"}
SPAN = re.compile(r"`([^`]+)`")
PAGE = re.compile(r"\bdocs/[\w/-]+\.md\b")
SOURCE = re.compile(r"[\w/-]+\.(?:h|cpp|py|js|txt|\*)")
NAME_OF_CODE = re.compile(r"(k[A-Z]\w+|[A-Z][a-z]\w*|[a-z]\w*_\w+|\w+(?=\(\)))(?:::\w+)?(?:\(\))?")
NAMED = re.compile(r"`((?:host|node|hal|topology|tests|cluster|docs|examples)/[\w./-]*[\w/])`")


def pages():
    return [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("tests/**/README.md"), *ROOT.glob("cluster/**/*.md")]


def files():
    """Paths below the sources' root."""
    return [file.relative_to(ROOT).as_posix() for folder in FOLDERS for file in (ROOT / folder).rglob("*") if file.is_file()]


def is_placeholder(name):
    return re.search(r"YOURS|NAME|FILE|FILM|your_|\.\.", name)


def missing_sources(text, paths):
    """Files that a page names without their whole path, such as `scene.cpp`, `kernels/shade.cpp` or `process.*`."""
    names = {name for name in SPAN.findall(text) if SOURCE.fullmatch(name) and not is_placeholder(name)}
    rooted = ["/" + path for path in paths]
    return sorted(name for name in names - FOREIGN
                  if not any(path.endswith("/" + name) or name.endswith(".*") and f"/{name[:-1]}" in path for path in rooted))


def missing_names(text, code):
    """Names of types, functions and constants that a page has and `code`, a set of words, has not."""
    names = {found[1] for found in map(NAME_OF_CODE.fullmatch, SPAN.findall(text)) if found}
    return sorted(name for name in names if name not in code)


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

    def test_have_whole_tables(self):
        """A row after an empty line begins a table that has no heading, and shows as text."""
        for page in pages():
            for table in re.findall(r"^\|.*\n(?:\|.*\n)*", CODE.sub("", page.read_text()), re.M):
                heading, _, below = table.partition("\n")
                self.assertRegex(below, r"\A\|( *:?-+:? *\|)+\n", f"{page.relative_to(ROOT)}: {heading}")

    def test_of_recipes_name_files_that_there_are(self):
        for page in ("CONTRIBUTING.md", "MAP.md"):
            for name in NAMED.findall((ROOT / page).read_text()):
                if re.search(r"YOURS|NAME|your_|\.\.", name):
                    continue
                there = any((ROOT / below / name).exists() for below in ("", "tests")) or list(ROOT.glob(name + ".*"))
                self.assertTrue(there, f"{page}: {name}")

    def test_of_recipes_name_sources_and_pages_that_there_are(self):
        paths = files()
        for page in ("CONTRIBUTING.md", "MAP.md"):
            text = (ROOT / page).read_text()
            self.assertEqual(missing_sources(text, paths), [], page)
            self.assertEqual(sorted(name for name in set(PAGE.findall(text)) if name not in paths), [], page)
        self.assertEqual(missing_sources("`scene.cpp` `sceme.cpp` `kernels/shade.cpp` `process.*` `proces.*`",
                                         ["node/scene.cpp", "node/kernels/shade.cpp", "hal/process.h"]),
                         ["proces.*", "sceme.cpp"])

    def test_of_recipes_name_code_that_there_is(self):
        code = set()
        for path in files():
            if path.endswith((".h", ".cpp", ".py", ".txt", ".cmake", ".js")):
                code.update(re.findall(r"\w+", (ROOT / path).read_text(errors="replace")))
        recipes = (ROOT / "CONTRIBUTING.md").read_text().partition("## Recipes")[2]
        self.assertEqual(missing_names(recipes, code), [])
        self.assertEqual(missing_names("`kSizes` `kSizez` `check_together()` `Renderer::draw` `run_it()` `a word`",
                                       {"kSizes", "check_together", "Renderer"}), ["kSizez", "run_it"])


if __name__ == "__main__":
    sys.exit(unittest.main())
