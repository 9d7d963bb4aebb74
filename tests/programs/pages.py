"""Pages that show a person what to type hold what they say: their commands are run as they stand, and what they
print is what the page says.

A block ```sh is run by bash in the page's folder; a block ```text after it is what it prints, `...` standing for any
lines. A block ```c is a file, named in its first line: /* name.c */.
"""

import re
import subprocess

from harness import ENVIRONMENT, SANITIZED, SECONDS, SOURCES, ProgramTest, complaints

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks_of(page):
    """(kind, text, line) of each block."""
    return [(block[1], block[2], page.count("\n", 0, block.start()) + 1) for block in BLOCK.finditer(page)]


def pattern_of(expected):
    """What a ```text block stands for."""
    lines = [".*" if line.strip() == "..." else re.escape(line.rstrip()) for line in expected.rstrip().split("\n")]
    return re.compile("\n".join(lines), re.DOTALL)


class PageTest(ProgramTest):
    def environment(self):
        return ENVIRONMENT

    def run_commands(self, commands, where):
        done = subprocess.run(["bash", "-euc", commands], cwd=self.folder, env=self.environment(), capture_output=True,
                              text=True, timeout=2 * SECONDS)
        warned = "" if SANITIZED else complaints(done.stderr)  # sanitized nodes are slow enough to be warned of
        self.assertEqual((done.returncode, warned), (0, ""), f"{where}\n{commands}\n{done.stdout}{done.stderr}")
        return "\n".join(line.rstrip() for line in done.stdout.rstrip().split("\n"))

    def run_page(self, name):
        """Gives the page's text."""
        path = SOURCES / "docs" / name
        page, printed, ran = path.read_text(), "", 0
        for kind, text, line in blocks_of(page):
            where = f"docs/{name}:{line}"
            if kind == "sh":
                printed, ran = self.run_commands(text, where), ran + 1
            elif kind == "text":
                self.assertRegex(printed, re.compile("^" + pattern_of(text).pattern + "$", re.DOTALL), where)
            elif kind == "c":
                self.write(re.match(r"/\* (\S+) \*/\n", text)[1], text)
        self.assertGreater(ran, 0, "the page has no commands")
        return page
