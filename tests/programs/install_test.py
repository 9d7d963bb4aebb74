"""What `cmake --install` leaves works wherever it is, knows nothing of the place it was built in, and its manual
and completion say what the programs say themselves. And what ./bootstrap says where it may not install."""

import gzip
import itertools
import os
import pathlib
import pty
import re
import select
import shlex
import shutil
import subprocess
import tempfile
import time
import unittest

import harness
from harness import BUILD, HAVE_MPI, ProgramTest, SideBySide, main, needs

STARTERS = ["mars", "mars-threads", "mars-simulated", "mars-nx"] + ["mars-host", "mars-ranks"] * HAVE_MPI  # nodes take no arguments

# What bash offers for each of several lines of words, and an empty line after each.
COMPLETE = """
set -u
source "$1"
function=$(complete -p "${1##*/}" | sed 's/.*-F \\([^ ]*\\).*/\\1/')
words() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  "$function" "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
  [ ${#COMPREPLY[@]} = 0 ] || printf '%s\\n' "${COMPREPLY[@]}"
  echo
}
"""


def what_is_built():
    """Where installing might write: file to time. Other tests write elsewhere in the build folder."""
    made = BUILD / "cluster/install"
    return {path: path.lstat().st_mtime_ns for path in [made, *made.rglob("*"), *BUILD.glob("*install*")]}


def setUpModule():
    work = pathlib.Path(unittest.enterModuleContext(tempfile.TemporaryDirectory(prefix="mars-test-")))
    before = what_is_built()
    harness.install(work / "first", "--strip")
    Installation.built = before, what_is_built()
    Installation.prefix = (work / "first").rename(work / "moved here")
    harness.PROGRAMS = Installation.prefix / "bin"


class Installation(ProgramTest):
    def rows(self):
        """Each starter's table of options: program to rows of fields."""
        return {each: [row.split("\t") for row in self.succeed(each, "--list-options").splitlines()]
                for each in STARTERS}


class Installed(SideBySide, Installation):
    AT_ONCE = 2

    def complete(self, *words):
        return self.complete_all(harness.PROGRAMS / words[0], [words[1:]])[0]

    def complete_all(self, program, lines):
        """What is offered for each of the lines, which are words after the program's name."""
        script = self.prefix / "share/bash-completion/completions" / program.name
        asked = "".join(shlex.join(["words", str(program), *words]) + "\n" for words in lines)
        offered = [[]]
        for line in self.succeed("bash", "-c", COMPLETE + asked, "bash", script).splitlines():
            if line:
                offered[-1].append(line)
            else:
                offered.append([])
        return offered[:-1]

    def tables(self):
        """(program, its rows) for each starter. For mars several: a program that says no more than a first command and all
        within it, because bash takes long to read the whole table."""
        for program, rows in self.rows().items():
            for first in dict.fromkeys(" ".join(row[1].split(" ")[:2]) for row in rows if row[0] != "setting"):
                part = [row for row in rows if row[0] != "setting" and
                        (row[1] in (program, first) or first != program and row[1].startswith(first + " "))]
                folder = self.temporary_folder()
                (folder / "rows").write_text("".join("\t".join(row) + "\n" for row in part))
                (folder / program).write_text(f"#!/bin/sh\nexec cat {folder}/rows\n")
                (folder / program).chmod(0o755)
                yield folder / program, [row for row in part if first == program or row[1] != program]

    def test_renders_an_installed_example(self):
        film = self.prefix / "share/doc/mars/examples/robot-arm.json"
        hashes = set()
        for backend in self.backends():
            printed = self.succeed("mars", "render", film, "-o", backend, "--backend", backend, "--nodes", 2,
                                "--frames", "0-3", "--size", "96x54")
            self.assertIn(str(harness.PROGRAMS / ("mars-host" if backend == "mpi" else "mars-threads")), printed)
            hashes.add(self.verified_hash(self.folder / backend))
        self.assertEqual(len(hashes), 1)

    def test_knows_no_place_of_its_building(self):
        for file in self.prefix.rglob("*"):
            if file.is_file():
                content = file.read_bytes()
                content = gzip.decompress(content) if file.suffix == ".gz" else content
                for place in [BUILD, harness.SOURCES]:
                    self.assertFalse(os.fsencode(place) in content, f"{file} holds {place}")

    @needs("readelf")
    def test_programs_find_libraries_outside_of_system_paths(self):
        """In the folders in which the build found them."""
        def folders(program):
            printed = subprocess.run(["readelf", "-dW", program], check=True, capture_output=True, text=True).stdout
            return set(":".join(re.findall(r"Library (?:runpath|rpath): \[(.*)\]", printed)).split(":")) - {""}
        for program in [*STARTERS, *["mars-node"] * HAVE_MPI]:
            built = {folder for folder in folders(BUILD / "bin" / program) if not folder.startswith(str(BUILD))}
            self.assertEqual(folders(self.prefix / "bin" / program), built, program)

    @needs("readelf")
    def test_programs_are_hardened(self):
        """They lie anywhere in memory, their stack is no code, and what the loader wrote stays as it is."""
        seen = 0
        for file in self.prefix.rglob("*"):
            if not file.is_file() or file.is_symlink() or file.read_bytes()[:4] != b"\x7fELF":
                continue
            headers = subprocess.run(["readelf", "-hldW", file], check=True, capture_output=True, text=True).stdout
            seen += 1
            self.assertRegex(headers, r"Type: +DYN", file)
            self.assertIn("GNU_RELRO", headers, file)
            self.assertRegex(headers, r"\bBIND_NOW\b|\bNOW\b", file)
            self.assertRegex(headers, r"GNU_STACK +\S+ \S+ \S+ \S+ \S+ RW ", file)
        self.assertGreater(seen, 5)

    @needs("readelf")
    @unittest.skipIf(harness.SANITIZED, "sanitizers check instead")
    def test_programs_are_checked_as_they_run(self):
        """Their stack's end, the places of vectors that they ask for, and calls with buffers of known size."""
        buffers = set()
        for program in [*STARTERS, *["mars-node"] * HAVE_MPI]:
            file = self.prefix / "bin" / program
            symbols = subprocess.run(["readelf", "--dyn-syms", "-W", file], check=True, capture_output=True,
                                     text=True).stdout
            self.assertIn("__stack_chk_fail", symbols, file)
            self.assertIn("__glibcxx_assert_fail", symbols, file)
            buffers.update(re.findall(r"__(?!stack)\w+_chk\b", symbols))
        self.assertTrue(buffers)

    def test_each_file_is_in_one_package(self):
        whole = sorted(path.relative_to(self.prefix) for path in self.prefix.rglob("*") if not path.is_dir())
        parts = []
        for part in ["mars", "mars-nx", "mars-nx-dev", "mars-window"]:
            harness.install(self.folder / part, "--component", part)
            parts += [path.relative_to(self.folder / part) for path in (self.folder / part).rglob("*")
                      if not path.is_dir()]
        self.assertEqual(sorted(parts), whole)

    def test_writes_nothing_into_the_build_folder(self):
        """So it may be another user's."""
        before, after = self.built
        self.assertEqual(before, after)
        self.assertIn(BUILD / "cmake_install.cmake", before)

    @needs("readelf")
    def test_nx_alone_needs_nothing_of_pictures(self):
        harness.install(self.folder / "nx", "--component", "mars-nx")
        needed = set()
        for file in [self.folder / "nx/bin/mars-nx", *(self.folder / "nx/lib").rglob("libmars-nx*.so.?")]:
            dynamic = subprocess.run(["readelf", "-dW", file], check=True, capture_output=True, text=True).stdout
            needed.update(re.findall(r"\(NEEDED\) .*\[(?:lib)?([a-z-]+)", dynamic))
        self.assertLessEqual({"mars-nx", "hwloc", "stdc"}, needed)
        self.assertLessEqual(needed, {"mars-nx", "mpi", "mpich", "hwloc", "xxhash", "stdc", "gcc", "m", "c", "ld-linux-x"} |
                             ({"asan", "ubsan", "tsan"} if harness.SANITIZED else set()))

    def test_samples_for_sites(self):
        samples = self.prefix / "share/mars"
        for name in ["hostfile", "modulefiles/mars", "slurm/render.sbatch", "slurm/epilog.sh", "farms/opencue.py",
                     "farms/deadline.job", "farms/mars-render.js"]:
            self.assertTrue((samples / name).is_file(), name)
        for name in ["slurm/epilog.sh", "farms/opencue.py"]:
            self.assertTrue(os.access(samples / name, os.X_OK), name)

    def test_schemas_and_documents(self):
        for name in ["mars/schema/film.schema.json", "mars/schema/model.schema.json", "doc/mars/copyright",
                     "doc/mars/film-format.md", "doc/mars/examples/models/robot-arm.json"]:
            self.assertTrue((self.prefix / "share" / name).is_file(), name)

    def test_completes_commands_and_options(self):
        commands = [row[1].split(" ") for row in self.rows()["mars"] if row[0] == "command"]
        self.assertEqual(self.complete("mars", ""), [each[-1] for each in commands if len(each) == 2])
        for program, rows in self.tables():
            commands, expected = [row[1].split(" ") for row in rows if row[0] == "command"], []
            for words in commands:
                within = [each[-1] for each in commands if each[:-1] == words]
                arguments = [row for row in rows if row[:2] == ["argument", " ".join(words)]]
                if within and not arguments:
                    expected.append(([*words[1:], ""], within))
                names = [name for row in rows if row[:2] == ["option", " ".join(words)] for name in row[2].split(",")]
                expected.append(([*words[1:], "-"], names))
            self.assertOffers(program, expected)

    def assertOffers(self, program, expected):
        """Pairs of words and of what is offered for them."""
        offered = self.complete_all(program, [words for words, _ in expected])
        for (words, each), ours in itertools.zip_longest(expected, offered):
            self.assertEqual(ours, each, words)

    def test_completes_values(self):
        some = 0
        for program, rows in self.tables():
            expected = []
            for row in rows:
                if row[0] == "option" and "|" in row[3]:
                    some += 1
                    words = [*row[1].split(" ")[1:], row[2].split(",")[-1]]
                    values = row[3].split(" ")[0].split("|")
                    expected += [([*words, ""], values), ([*words, "=", ""], values)]
            self.assertOffers(program, expected)
        self.assertGreater(some, 0)

    def test_completes_commands_within_commands(self):
        self.write("dog.json", "")
        (self.folder / "notes.txt").touch()
        self.assertEqual(self.complete("mars", "model", "dog.json", "sh"), ["show"])
        self.assertIn("dog.json", self.complete("mars", "model", ""))
        self.assertEqual(self.complete("mars", "model", "dog.json", "show", ""), [])
        self.assertEqual(self.complete("mars", "model", "dog.json", "show", "-"), ["-h", "--help"])

    def test_completes_keys_and_their_choices(self):
        add = ["mars", "film", "a.json", "material", "add", "skin"]
        self.assertEqual(self.complete(*add, "rou"), ["roughness="])
        self.assertEqual(self.complete(*add, "interp"), [f"interpolation={each}" for each in ["phong", "gouraud", "flat"]])
        # Bash takes "=" for a word of its own.
        self.assertEqual(self.complete(*add, "roughness", "=", "0.5", "interpolation", "=", "fl"), ["flat"])
        self.assertEqual(self.complete(*add, "interpolation", "="), ["phong", "gouraud", "flat"])
        self.assertEqual(self.complete(*add, "roughness", "="), [])

    def test_completes_films_and_folders(self):
        for name in ["a film.json", "film.mars", "film.txt"]:
            self.write(name, "")
        (self.folder / "frames").mkdir()
        self.assertEqual(self.complete("mars", "render", ""), ["frames", "a film.json", "film.mars"])
        self.assertIn("frames", self.complete("mars", "render", "-o", "f"))  # or a video
        self.assertEqual(self.complete("mars", "render", "--nodes", ""), [])

    def test_other_shells_take_their_completion(self):
        share = self.prefix / "share"
        for shell, script in [("zsh", share / "zsh/site-functions/_mars"),
                              ("fish", share / "fish/vendor_completions.d/mars.fish")]:
            self.assertIn("--list-options", script.read_text())
            with self.subTest(shell=shell):
                if not shutil.which(shell):
                    self.skipTest(f"not installed: {shell}")
                self.succeed(shell, "-n", script)

    @needs("fish")
    def test_fish_completes_commands_within_commands(self):
        script = self.prefix / "share/fish/vendor_completions.d/mars.fish"
        self.write("dog.json", "")
        for typed, offered in [("mars mod", ["model"]), ("mars model dog.json sh", ["show"]), ("mars model d", ["dog.json"]),
                               ("mars render --backend thr", ["threads"]), ("mars model dog.json show --h", ["--help"]),
                               ("mars film dog.json material add x rou", ["roughness="]),
                               ("mars film dog.json material add x interpolation=fl", ["interpolation=flat"])]:
            printed = self.succeed("fish", "--no-config", "-c", f"source '{script}'; complete -C '{typed}'",
                                env=dict(os.environ, PATH=f"{harness.PROGRAMS}:{os.environ['PATH']}",
                                         HOME=str(self.folder)))
            self.assertEqual([line.split("\t")[0] for line in printed.splitlines()], offered, typed)


class Zsh(Installation):
    @needs("zsh")
    def test_zsh_completes_commands_within_commands(self):
        self.write("dog.json", "")
        shell, terminal = pty.fork()
        if shell == 0:
            os.chdir(self.folder)
            os.environ.update(PATH=f"{harness.PROGRAMS}:{os.environ['PATH']}", HOME=str(self.folder), TERM="dumb")
            os.execvp("zsh", ["zsh", "-f", "-i"])
        self.addCleanup(os.waitpid, shell, 0)
        self.addCleanup(os.close, terminal)

        def shows(typed, wanted):
            os.write(terminal, typed.encode())
            printed, end = "", time.monotonic() + harness.SECONDS
            while wanted not in printed and time.monotonic() < end:
                if select.select([terminal], [], [], 0.1)[0]:
                    printed += os.read(terminal, 65536).decode(errors="replace")
            self.assertIn(wanted, printed, typed)

        functions = self.prefix / "share/zsh/site-functions"
        shows(f"fpath=('{functions}' $fpath); autoload -U compinit; compinit -u; echo rea''dy\n", "ready\r\n")
        for typed, wanted in [("mars mod", "mars model "), ("mars model dog.json sh", "dog.json show "),
                              ("mars model d", "mars model dog.json "), ("mars render --backend thr", "threads "),
                              ("mars model dog.json set body --limits x 0 9 --res", "--reset="),
                              ("mars film dog.json material add x rou", "roughness="),
                              ("mars film dog.json material add x interpolation=fl", "interpolation=flat")]:
            shows(typed + "\t", wanted)
            shows("\x15echo do''ne\n", "done\r\n")


@unittest.skipUnless((BUILD / "cluster/install/options").exists(), "built without manual")
class Manual(Installation):
    def page(self, name):
        return self.prefix / "share/man/man1" / f"{name}.1.gz"

    def test_has_every_option_and_setting(self):
        text = {name: gzip.decompress(self.page(name).read_bytes()).decode().replace("\\-", "-")
                for name in ["mars", "mars-render", "mars-host", "mars-nx"]}
        for program, rows in self.rows().items():
            for kind, of, *fields in rows:
                name = program if program in ["mars", "mars-nx"] else "mars-host"
                name = {"mars render": "mars-render"}.get(of, name)
                if kind == "setting":
                    for each, page in text.items():
                        here = of.startswith("MARS_NX_") == (each == "mars-nx")
                        self.assertEqual(f".It Ev {of}\n" in page, here, each)
                elif kind == "option" and of not in ["mars", "mars-nx"] and "--help" not in fields[0]:
                    flags = r" , ".join(f"Fl {each[1:]}[^,\n]*" for each in fields[0].split(","))
                    self.assertRegex(text[name], rf"(?m)^\.It {flags}$")
        for page in text.values():
            self.assertIsNone(re.search("@[A-Z]+", page))

    def test_prints_commands_as_they_are_typed(self):
        text = gzip.decompress(self.page("mars").read_bytes()).decode()
        self.assertIn(".Nm Cm animate Ar FILM Cm walk Oo Ar options Oc Ar ACTOR\n", text)
        self.assertIn(".Nm Cm model Ar MODEL Cm scale Oo Ar options Oc Oo Ar FACTOR... Oc\n", text)

    def test_every_program_has_a_page(self):
        for program in harness.PROGRAMS.iterdir():
            self.assertTrue(self.page(program.name).is_file(), program.name)

    @needs("mandoc")
    def test_is_well_formed(self):
        for page in self.page("mars").parent.iterdir():
            self.succeed("mandoc", "-T", "lint", "-W", "warning", page)


class Bootstrap(ProgramTest):
    def test_names_what_is_missing(self):
        # Without apt: nothing but a shell and its tools is in the path.
        for tool in ["bash", "cut", "dirname", "grep", "head", "id", "paste", "sed"]:
            (self.folder / tool).symlink_to(shutil.which(tool))
        (self.folder / "dnf").symlink_to(shutil.which("true"))
        done = self.run_program("bash", harness.SOURCES / "bootstrap", env={"PATH": str(self.folder)})
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"dnf install gcc-c\+\+ cmake ninja-build pkgconf-pkg-config openmpi-devel")
        self.assertRegex(done.stdout, r"spack install gcc cmake ninja pkgconf openmpi")
        self.assertNotIn("googletest", done.stdout)


if __name__ == "__main__":
    main()
