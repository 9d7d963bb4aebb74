"""NX as others get it: the installed headers are C of any age and C++, the library exports what they declare and
nothing else, and pkg-config and CMake find both wherever they are."""

import re
import unittest

import harness
from harness import main
from nx_installation import NxInstallation

STRICT = ["-Wall", "-Wextra", "-Werror", "-pedantic"]
VARIABLE = re.compile(r"^extern [a-z][a-z_ ]*[ *]+(\w+)", re.M)
LANGUAGES = [("cc", "c", ["c89", "c99", "c11", "c17"]), ("c++", "cpp", ["c++98", "c++11", "c++14", "c++17", "c++20"])]

RANK = """#include <cube.h>
#include <stdio.h>
int main(void) {
  printf("%ld of %ld\\n", mynode(), numnodes());
  return 0;
}
"""
RANKS = ["0 of 3", "1 of 3", "2 of 3"]

PROJECT = """cmake_minimum_required(VERSION 3.16)
project(ranks LANGUAGES C)
find_package(mars-nx @VERSION@ CONFIG REQUIRED)
add_executable(rank rank.c)
target_link_libraries(rank PRIVATE mars-nx::nx)
"""


class Library(NxInstallation):
    def exported(self):
        library = next(self.prefix.rglob("libmars-nx.so"))
        lines = self.succeed("nm", "-D", "--defined-only", library).splitlines()
        return {line.split()[-1] for line in lines}

    def test_each_header_alone_in_every_language(self):
        for compiler, ending, standards in LANGUAGES:
            sources = [self.write(f"{header.stem}.{ending}", f"#include <{header.name}>\nextern int nothing;\n")
                       for header in self.headers]
            for standard in standards:
                self.succeed(compiler, f"-std={standard}", *STRICT, "-fsyntax-only",
                             "-I", self.headers[0].parent, *sources)

    def test_the_umbrellas_declare_everything(self):
        self.assertGreater(len(self.prototypes()), 100)
        source = self.write("all.c", "#include <nx.h>\n#include <cube.h>\n#include <mesh.h>\n")
        seen = self.succeed("cc", "-E", "-P", "-I", self.headers[0].parent, source)
        for name in self.prototypes():
            self.assertRegex(seen, rf"\b{name}\(")

    def test_exports_what_is_declared_and_nothing_else(self):
        variables = {name for header in self.headers for name in VARIABLE.findall(header.read_text())}
        self.assertEqual(self.exported() ^ (set(self.prototypes()) | variables), set())

    def test_names_of_a_programs_own(self):
        self.write("own.c", "#include <stdlib.h>\n" + "".join(
            f"void {name}(void) {{ abort(); }}\n" for name in ["load", "gray", "flick", "csend", "crecv", "_crecv"]))
        self.write("rank.c", RANK.replace("{", "{ gsync();", 1))
        self.succeed("cc", "rank.c", "own.c", "-o", "rank", *self.flags("--cflags", "--libs"))
        self.assertRuns("./rank")

    def test_cpp(self):
        self.write("rank.cpp", RANK)
        self.succeed("c++", "-std=c++98", *STRICT, "rank.cpp", "-o", "rank", *self.flags("--cflags", "--libs"))
        self.assertRuns("./rank")

    def test_pkg_config(self):
        self.build("rank", RANK)
        self.assertRuns("./rank")

    @harness.needs_mpi
    def test_a_job_of_mpirun(self):
        self.build("rank", RANK)
        printed = self.succeed(*harness.OWN_MPIRUN, "-n", 3, "./rank", env=self.nx_environment())
        self.assertEqual(sorted(printed.splitlines()), RANKS)

    def test_a_program_alone(self):
        self.build("rank", RANK)
        self.assertEqual(self.succeed("./rank", env=self.nx_environment()), "0 of 1\n")

    def test_cmake_package(self):
        self.write("rank.c", RANK)
        self.build_by_cmake(PROJECT)
        self.assertRuns("build/rank")

    @unittest.skipUnless((harness.PROGRAMS.parent / "build.ninja").exists(), "needs Ninja")
    def test_is_built_without_mars(self):
        commands = self.succeed("ninja", "-C", harness.PROGRAMS.parent, "-t", "commands", "nx")
        self.assertEqual(re.findall(r" -o bin/(\S+)", commands), ["mars-nx"])

    def assertRuns(self, program):
        done = self.run_nx("--nodes", 3, program)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(done.stdout.splitlines()), RANKS)


if __name__ == "__main__":
    main()
