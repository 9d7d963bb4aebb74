"""The verbs of ./bootstrap configure one build folder in any order: what one run of CMake finds stays in its cache for the
next. And what it does where it may not install. Started as: bootstrap_test.py PROGRAMS_FOLDER SOURCES_FOLDER."""

import itertools
import re
import shutil
import subprocess

from harness import SOURCES, ProgramTest, main

# BUILD_TESTING and MARS_BENCH of each kind of verb.
VERBS = {"demo": ["OFF", "OFF"], "test": ["ON", "OFF"], "bench": ["OFF", "ON"]}

# Each kind follows each other kind once.
WALK = ["demo", "test", "demo", "bench", "test", "bench", "demo"]

# The cache of an earlier verb, which found no compiler: later verbs install packages.
WITHOUT_FORTRAN = "-DCMAKE_Fortran_COMPILER=NOTFOUND"


class Bootstrap(ProgramTest):
    def test_verbs_configure_in_any_order(self):
        self.assertEqual(sorted(zip(WALK, WALK[1:])), sorted(itertools.permutations(VERBS, 2)))
        for verb in WALK:
            tests, benchmarks = VERBS[verb]
            done = subprocess.run(["cmake", "--preset", "release", "-S", SOURCES, "-B", self.folder / "build",
                                   f"-DBUILD_TESTING={tests}", f"-DMARS_BENCH={benchmarks}", WITHOUT_FORTRAN],
                                  cwd=SOURCES, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 0, f"{verb}: {done.stdout[-3000:]}")
            if verb == "test" and shutil.which("gfortran"):
                self.assertIn("fortran_pi", (self.folder / "build/build.ninja").read_text())

    def bootstrap(self, *words):
        return subprocess.run([SOURCES / "bootstrap", *words], cwd=SOURCES, capture_output=True, text=True)

    def test_words_that_it_does_not_know_begin_nothing(self):
        for words in [["tset"], ["test", "all", "-R", "farm"], ["demo", "now"]]:
            done = self.bootstrap(*words)
            self.assertEqual((done.returncode, done.stderr.split("\n")[0]),
                             (2, f'bootstrap: there is no "{" ".join(words)}"; these are:'))

    def test_help_begins_nothing(self):
        for words in [["--help"], ["costs", "--help"], ["mutants", "--help"], ["fuzz", "--help"]]:
            done = self.bootstrap(*words)
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        self.assertIn("./bootstrap demo", self.bootstrap("--help").stdout)


# The script starts TOOLS themselves, and stand-ins, which note their words. Nothing is installed; the user is not root.
TOOLS = ["bash", "cut", "dirname", "env", "grep", "head", "mkdir", "paste", "sed", "sort", "c++", "ninja", "pkg-config"]
STAND_INS = {"apt-get": "", "cmake": "echo cmake version 3.25.1", "dpkg-query": "exit 1", "id": "echo 1000", "mpicc": ""}
REFUSES, PERMITS = "echo not in the sudoers file >&2; exit 1", '[ "$1" = -l ] || "$@"'


class WithoutRoot(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "bin").mkdir()
        for tool in TOOLS:
            (self.folder / "bin" / tool).symlink_to(shutil.which(tool))
        for name, commands in STAND_INS.items():
            self.stand_in(name, commands)
        shutil.copy(SOURCES / "bootstrap", self.folder)

    def stand_in(self, name, commands):
        program = self.folder / "bin" / name
        program.write_text(f'#!/bin/bash\necho "{name} $*" >>{self.folder}/notes\n{commands}\n')
        program.chmod(0o755)

    def bootstrap(self, code):
        done = self.run_program("./bootstrap", env={"PATH": str(self.folder / "bin")})
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        notes = self.folder / "notes"
        return done.stdout + done.stderr, notes.read_text() if notes.exists() else ""

    def test_builds_without_parts_where_sudo_is_not_permitted(self):
        for sudo in ["", REFUSES]:
            with self.subTest(sudo):
                if sudo:
                    self.stand_in("sudo", sudo)
                printed, notes = self.bootstrap(0)
                self.assertRegex(printed, r"Left out, .*\n  videos: FFmpeg\n  as root: +apt-get install "
                                          r"ffmpeg\n  or modules: +module load ffmpeg .*\n  or Spack: +spack install ffmpeg ")
                self.assertNotIn("Missing here", printed)
                self.assertIn("cmake --build", notes)
                self.assertNotIn("apt-get", notes.replace("sudo -l apt-get", ""))

    def test_names_what_is_needed_and_ends_where_sudo_is_not_permitted(self):
        self.stand_in("sudo", REFUSES)
        (self.folder / "bin/mpicc").unlink()
        printed, notes = self.bootstrap(1)
        self.assertRegex(printed, r"Missing here: MPI\n  as root: +apt-get install libopenmpi-dev openmpi-bin\n"
                                  r"  or modules: +module load openmpi .*\n  or Spack: +spack install openmpi ")
        self.assertIn("videos: FFmpeg", printed)
        self.assertNotIn("\ncmake ", notes)

    def test_installs_parts_too_where_sudo_is_permitted(self):
        self.stand_in("sudo", PERMITS)
        _, notes = self.bootstrap(0)
        installed = re.search("\napt-get install .*", notes)[0].split()
        for package in ["g++", "libopenexr-dev", "libopencolorio-dev", "libassimp-dev", "libsdl2-dev", "ffmpeg"]:
            self.assertIn(package, installed)
        self.assertNotIn("libgtest-dev", installed)

    def test_a_copied_build_folder_is_named(self):
        build = self.folder / "build/release"
        build.mkdir(parents=True)
        cache = build / "CMakeCache.txt"
        cache.write_text("A:STRING=b\nCMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere/mars\n")
        printed, notes = self.bootstrap(1)
        self.assertIn(f"build/release was made in /elsewhere/mars, and knows that place; remove it: rm -r {build}", printed)
        self.assertNotIn("cmake", notes)
        cache.write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={self.folder}\n")
        self.bootstrap(0)


class Configuring(ProgramTest):
    def configure(self, *words):
        return self.run_program("cmake", "-G", "Ninja", "-S", SOURCES, "-B", self.folder / "build", "-DBUILD_TESTING=OFF",
                                *words)

    def test_no_part_is_needed(self):
        left_out = ["MPI", "OpenEXR", "OpenColorIO", "Boost", "OpenSSL", "meshoptimizer"]
        done = self.configure(*[f"-DCMAKE_DISABLE_FIND_PACKAGE_{each}=ON" for each in left_out],
                              *[f"-DMARS_{each}=OFF" for each in ["EXR", "IMPORT", "STUDIO", "WINDOW"]])
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])
        for part in ["MPI backend", "OpenEXR", "OpenColorIO", "mars studio", "windows", "PLY and patch files only"]:
            self.assertIn(part, done.stdout)

    def test_other_processors_are_refused(self):
        done = self.configure("-DCMAKE_SYSTEM_NAME=Linux", "-DCMAKE_SYSTEM_PROCESSOR=aarch64")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("MARS is for x86-64 processors, and this build is for aarch64", done.stderr)


if __name__ == "__main__":
    main()
