"""docs/studio-keys.md has the table of keys of the help sheet, which is made from shortcuts.js."""

import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3]))
from cases import main  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[4]
SIGNS = {"ArrowLeft": "\u2190", "ArrowRight": "\u2192", "ArrowUp": "\u2191", "ArrowDown": "\u2193", "Escape": "Esc",
         "Delete": "Del"}


def shown(keys):
    return "+" if keys == "+" else "+".join(SIGNS.get(key, key) for key in keys.split("+"))


def row(group, keys, text):
    keys = " ".join(f"`{shown(each)}`" for each in re.findall(r'"([^"]+)"', keys))
    return f"| {group} | {keys} | {text} |"


class Keys(unittest.TestCase):
    def test_page_has_those_of_the_help_sheet(self):
        table = (ROOT / "host/studio/page/shortcuts.js").read_text()
        lines = re.findall(r'\{group: "([^"]+)", keys: \[([^\]]*)\],.*?text: "([^"]+)"', table, re.DOTALL)
        page = (ROOT / "docs/studio-keys.md").read_text()
        self.assertEqual([row(*each) for each in lines], [line for line in page.split("\n") if line.startswith("|")][2:])


if __name__ == "__main__":
    main()
