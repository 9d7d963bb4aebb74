"""The tutorial holds what it says (pages.py), and its pictures are those its commands make: a picture
images/PAGE/NAME.png is made by the commands as NAME.png.
To make the pictures again: tutorial_test.py PROGRAMS SOURCES --make-pictures
"""

import os
import pathlib
import re
import shutil
import sys

MAKE_PICTURES = "--make-pictures" in sys.argv
from harness import ENVIRONMENT, PROGRAMS, SOURCES, main  # noqa: E402
from pages import PageTest, pattern_of  # noqa: E402
from png_reader import png_rows  # noqa: E402

PAGES = ["tutorial.md", "filming.md"]


class Pages(PageTest):
    def environment(self):
        return dict(ENVIRONMENT, PATH=f"{PROGRAMS}:{os.environ['PATH']}")

    def check_picture(self, shown):
        made = self.folder / shown.name
        self.assertTrue(made.exists(), f"no command makes {shown.name}")
        if MAKE_PICTURES:
            shown.parent.mkdir(exist_ok=True)
            shutil.copy(made, shown)
        self.assertEqual(png_rows(made), png_rows(shown), shown.name)

    def test_pages(self):
        for page in PAGES:
            with self.subTest(page=page):
                text = self.run_page(page)
                folder = f"images/{pathlib.Path(page).stem}"
                for picture in re.findall(rf"!\[[^]]+\]\(({folder}/[^)]+)\)", text):
                    self.check_picture(SOURCES / "docs" / picture)

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
