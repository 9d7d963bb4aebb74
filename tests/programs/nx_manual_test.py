"""The manual of NX's calls: a page for each, prototypes as the headers have them, errors that exist, references that
lead somewhere, clean mdoc, and examples that compile."""

import errno
import gzip
import re

from harness import main, needs
from nx_installation import NxInstallation

ANY_AGE = ["-std=c89", "-pedantic", "-Wall", "-Wextra", "-Werror"]


def mdoc_plain(text):
    """What mdoc prints of a literal text."""
    return text.replace("\\-", "-").replace("\\e", "\\").replace("\\&", "")


class Manual(NxInstallation):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        man = cls.prefix / "share/man"
        cls.files = {path.name.removesuffix(".gz"): path for path in man.rglob("*.gz")}
        cls.pages = {name: gzip.decompress(path.read_bytes()).decode()
                     for name, path in cls.files.items() if not path.is_symlink()}

    def test_each_call_has_a_page(self):
        calls = self.prototypes()
        self.assertGreater(len(calls), 100)
        for call in calls:
            page = self.pages[self.files[call + ".3nx"].resolve().name.removesuffix(".gz")]
            self.assertRegex(page, rf"\n\.Nm {call.lstrip('_')}\b|\b{call}\b")

    def test_prototypes_are_those_of_the_headers(self):
        calls, seen = self.prototypes(), 0
        for name, page in self.pages.items():
            for result, call, arguments in re.findall(r"^\.Ft (.*)\n\.Fo (.*)\n((?:\.Fa .*\n)*)\.Fc", page, re.M):
                printed = f"{result} {call}({', '.join(re.findall(r'.Fa .(.*).$', arguments, re.M))})"
                self.assertEqual(printed, re.sub(r"(\w)\* ", r"\1 *", calls[call]), name)
                seen += 1
        self.assertGreater(seen, 50)

    def test_errors_exist(self):
        ours = re.findall(r"#define (EQ\w+)", (self.prefix / "include/mars-nx/nx_errno.h").read_text())
        printed = set()
        for name, page in self.pages.items():
            for error in re.findall(r"\.Er (\w+)|Bq Er (\w+)", page):
                printed.add("".join(error))
        self.assertEqual(printed & set(ours), set(ours))
        self.assertEqual({each for each in printed - set(ours) if not hasattr(errno, each)}, set())

    def test_references_lead_somewhere(self):
        seen = 0
        for name, page in self.pages.items():
            for call, section in re.findall(r"\bXr (\S+) (3nx|7)", page):
                self.assertIn(f"{call}.{section}", self.files, name)
                seen += 1
        self.assertGreater(seen, 50)

    def test_the_overview_names_every_page(self):
        for name in self.pages:
            if name.endswith(".3nx"):
                self.assertRegex(self.pages["nx.7"], rf"Xr {name.split('.')[0]} 3nx")

    @needs("mandoc")
    def test_mandoc_finds_no_fault(self):
        for name in self.pages:
            printed = self.run_program("mandoc", "-T", "lint", "-W", "warning", self.files[name]).stdout
            faults = [line for line in printed.splitlines() if "unknown manual section: Dt ... 3nx" not in line]
            self.assertEqual(faults, [])

    @needs("groff")
    def test_groff_finds_no_fault(self):
        for name, page in self.pages.items():
            self.succeed("groff", "-ww", "-mandoc", "-Tutf8", "-z", self.write(name, page))

    def test_examples_run(self):
        ran = 0
        self.build("node", "#include <cube.h>\nint main(void) { csend(1L, &(long){1}, 8L, myhost(), 0L); return 0; }")
        for name, page in self.pages.items():
            for example in re.findall(r"^\.Bd -literal\n(#include.*?)^\.Ed", page, re.M | re.S):
                self.build("example", mdoc_plain(example), *ANY_AGE)
                program = ["--host", "./example"] if 'load("node"' in example else ["./example"]
                for nodes in 1, 4:
                    done = self.run_nx("--nodes", nodes, *program)
                    printed = "" if "nx_perror(" in example else done.stderr
                    self.assertEqual((done.returncode, printed), (0, ""), f"{name}, {nodes} nodes\n{done.stderr}")
                ran += 1
        self.assertGreater(ran, 15)


if __name__ == "__main__":
    main()
