"""The pages about programs of one's own, and about those of the iPSC, hold what they say (pages.py), with an installed
NX."""

import os

import harness
from nx_installation import NxInstallation
from pages import PageTest


class Pages(NxInstallation, PageTest):
    def environment(self):
        return dict(self.nx_environment(), PATH=f"{self.prefix / 'bin'}:{os.environ['PATH']}")

    def test_pages(self):
        for page in ["nx.md", "porting.md"]:
            with self.subTest(page=page):
                self.run_page(page)


if __name__ == "__main__":
    harness.main()
