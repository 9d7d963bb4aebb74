"""What tests of NX for other people's programs share: its components installed below a prefix that was moved, and
what the installed headers declare."""

import pathlib
import re
import tempfile
import unittest

import harness
from harness import ProgramTest

DECLARATION = re.compile(r"^(?!typedef)[a-z][a-z_ ]*[ *]+(\w+)\(", re.M)


class NxInstallation(ProgramTest):
    @classmethod
    def setUpClass(cls):
        work = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="mars-test-")))
        for part in ["mars-nx", "mars-nx-dev"]:
            harness.install(work / "first", "--component", part, "--strip")
        cls.prefix = (work / "first").rename(work / "moved")
        if harness.SANITIZED:
            raise unittest.SkipTest("a sanitized library is for programs that are sanitized too")
        cls.headers = sorted((cls.prefix / "include/mars-nx").iterdir())

    def prototypes(self):
        """Name to prototype, without comments and with single blanks, of each declared call."""
        found = {}
        for header in self.headers:
            text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.S)
            for match in DECLARATION.finditer(text):
                found[match[1]] = " ".join(text[match.start():text.index(";", match.end())].split())
        return found

    def build(self, program, source, *options):
        self.write(f"{program}.c", source)
        self.succeed("cc", *options, f"{program}.c", "-o", program, *self.flags("--cflags", "--libs"))

    def build_by_cmake(self, project):
        """With the generator that MARS was built with: no other need be installed. @VERSION@ is that of MARS."""
        cache = (harness.BUILD / "CMakeCache.txt").read_text()
        version = re.search(r"^CMAKE_PROJECT_VERSION:STATIC=(\d+\.\d+)", cache, re.M)[1]
        self.write("CMakeLists.txt", project.replace("@VERSION@", version))
        self.succeed("cmake", "-G", re.search(r"^CMAKE_GENERATOR:INTERNAL=(.*)$", cache, re.M)[1], "-S", ".", "-B", "build",
                     f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.succeed("cmake", "--build", "build")

    def run_nx(self, *words):
        return self.run_program(self.prefix / "bin/mars-nx", "run", *words, env=self.nx_environment())

    def nx_environment(self):
        library = next(self.prefix.rglob("libmars-nx.so")).parent
        return dict(harness.ENVIRONMENT, LD_LIBRARY_PATH=str(library), PKG_CONFIG_PATH=str(library / "pkgconfig"))

    def flags(self, *words):
        return self.succeed("pkg-config", *words, "mars-nx", env=self.nx_environment()).split()
