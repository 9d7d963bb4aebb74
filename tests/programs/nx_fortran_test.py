"""NX for Fortran programs as others get it: every call by its Fortran name, a host that loads its nodes, and how
pkg-config and CMake find the library."""

import shutil

import harness
from harness import main
from nx_installation import NxInstallation


PROJECT = """cmake_minimum_required(VERSION 3.16)
project(calls LANGUAGES C Fortran)
find_package(mars-nx @VERSION@ CONFIG REQUIRED)
add_executable(calls fortran_calls.f)
target_compile_options(calls PRIVATE -w)
target_link_libraries(calls PRIVATE mars-nx::nx-fortran)
"""


@harness.needs("gfortran")
class Fortran(NxInstallation):
    def compile(self, source, program):
        flags = self.succeed("pkg-config", "--cflags", "--libs", "mars-nx-fortran", env=self.nx_environment()).split()
        # Buffers are of any type: that is what the language's old standards allow.
        self.succeed("gfortran", "-std=legacy", "-w", source, "-o", program, *flags)

    def run_well(self, *words):
        done = self.run_nx(*words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        return done.stdout

    def test_every_call(self):
        self.compile(harness.SOURCES / "tests/programs/fortran_calls.f", "fortran_calls")
        for nodes in [1, 2, 3, 4, 8]:
            with self.subTest(nodes=nodes):
                self.assertEqual(self.run_well("--nodes", nodes, "./fortran_calls"), f"calls:{nodes:3} nodes,   0 wrong\n")

    @harness.needs_mpi
    def test_every_call_under_mpi(self):
        self.compile(harness.SOURCES / "tests/programs/fortran_calls.f", "fortran_calls")
        said = self.succeed(*harness.OWN_MPIRUN, "-n", 3, "./fortran_calls", env=self.nx_environment())
        self.assertEqual(said, "calls:  3 nodes,   0 wrong\n")

    def test_a_host_loads_its_nodes(self):
        self.compile(harness.SOURCES / "tests/programs/fortran_calls.f", "fortran_calls")
        self.compile(harness.SOURCES / "tests/programs/fortran_host.f", "fortran_host")
        said = "calls:  3 nodes,   0 wrong\n"
        self.assertEqual(self.run_well("--nodes", 3, "--host", "./fortran_host"), said)

    def test_cmake_package(self):
        shutil.copy(harness.SOURCES / "tests/programs/fortran_calls.f", self.folder)
        self.build_by_cmake(PROJECT)
        self.assertEqual(self.run_well("--nodes", 2, "build/calls"), "calls:  2 nodes,   0 wrong\n")


if __name__ == "__main__":
    main()
