"""What each command of mars is for, and what the options of render change."""

import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys

from harness import (ENVIRONMENT, EXAMPLES, PROGRAMS, SECONDS, SOURCES, ProgramTest, family, living, main, needs_mpi,
                     wait_until)

TEAPOT = EXAMPLES / "teapot.json"
SMALL = ["--size", "96x54", "--nodes", 2, "--backend", "threads"]

# Four patches, the sides of a vase: each 16 control points on an arc, at four heights.
ARC = [(1, 0), (1, 0.5523), (0.5523, 1), (0, 1)]
PROFILE = [(0.4, 0), (1.2, 0.6), (0.3, 1.4), (0.6, 2)]


def vase():
    text = "4\n"
    for turn in range(4):
        text += "3 3\n"
        for radius, z in PROFILE:
            for x, y in ARC:
                for _ in range(turn):
                    x, y = -y, x
                text += f"{x * radius} {y * radius} {z}\n"
    return text


def limited(process):
    """Has mars prepared this process of its own? Its limits come last."""
    limits = pathlib.Path(f"/proc/{process}/limits").read_text()
    return not re.search(r"^Max cpu time +unlimited", limits, re.MULTILINE)


class Commands(ProgramTest):
    def test_the_way_in(self):
        printed = self.succeed("mars")
        self.assertIn("mars render examples/demo.json", printed)
        for command in ["render", "compile", "info", "preview", "play", "verify", "import", "bench"]:
            self.assertIn(f"mars {command} ", printed)
            self.assertIn("Example: ", self.succeed("mars", command, "--help"))

    def test_every_option_of_every_command_has_an_example(self):
        rows = [row.split("\t") for row in self.succeed("mars", "--list-options").splitlines()]
        of = {row[1] for row in rows if row[0] == "command"}
        self.assertIn("mars model show", of)
        for kind, command, name, *fields in rows:
            if kind in ("argument", "option"):
                self.assertIn(command, of)
                self.assertIn("Example: ", fields[-1], f"{command} {name}")

    def test_a_command_that_only_holds_others_lists_them(self):
        for command in ["model", "film", "animate"]:
            self.assertIn(f"Usage: mars {command} ", self.succeed("mars", command))
        self.assertIn("Usage: mars model MODEL show ", self.succeed("mars", "help", "model", "show"))
        self.fail_clearly(2, "model", "dog.json", "shwo", says="'shwo' is not a command (did you mean 'show'?)")
        self.fail_clearly(2, "modle", "show", says="'modle' is not a command (did you mean 'model'?)")
        self.fail_clearly(2, "film", "dog.json", "light", "list",
                          says="'list' is not a command (did you mean `mars film FILM show`?)")
        self.fail_clearly(2, "film", "dog.json", "light", "dim", says="'dim' is not a command (there are add, set, remove, rig)")
        self.fail_clearly(2, "model", "dog.json", "show", "--hlep", says="'--hlep' is not an option (did you mean '--help'?)")
        self.fail_clearly(2, "model", "show", says="'show' comes later: write mars model MODEL show")

    def test_help_of_a_command_within_another_is_its_own(self):
        for words in [["pose", "--help"], ["film.json", "pose", "--help"]]:
            printed = self.succeed("mars", "animate", *words)
            self.assertIn("Usage: mars animate FILM pose [OPTIONS] ACTOR PART=NUMBERS...\n", printed)
            self.assertNotIn("docs/animating.md", printed)  # which stands below that of animate
        self.assertIn("docs/animating.md", self.succeed("mars", "animate", "--help"))
        self.assertIn("Usage: mars model MODEL scale [OPTIONS] [FACTOR...]\n",
                      self.succeed("mars", "model", "scale", "--help"))

    def test_help_prints_exit_codes_and_settings(self):
        for words in [["--help"], ["render", "--help"]]:
            self.assertIn("Exit codes: 0", self.succeed("mars", *words))
        self.assertIn("MARS_MEMORY", self.succeed("mars", "render", "--help"))

    def test_help_fits_screens(self):
        for words, most in [([], 40), (["render", "--help"], 150)]:  # one screen, and three, with headings
            lines = self.succeed("mars", *words).splitlines()
            self.assertLessEqual(len(lines), most, words)
            self.assertEqual([line for line in lines if len(line) > 80], [], words)

    @needs_mpi
    def test_programs_of_a_job_print_what_they_are(self):
        for program in ["mars-host", "mars-node", "mars-ranks"]:
            self.assertRegex(self.succeed(program, "--help"), "mpirun -n .*mars-")

    def test_version(self):
        self.assertRegex(self.succeed("mars", "--version"), r"^mars \d+\.\d+\.\d+\n$")

    def test_compiled_film_renders_the_same(self):
        self.succeed("mars", "compile", TEAPOT, "-o", "teapot.mars")
        self.succeed("mars", "render", TEAPOT, "-o", "a", *SMALL, "--frames", "0-3")
        self.succeed("mars", "render", "teapot.mars", "-o", "b", *SMALL, "--frames", "0-3")
        self.assertEqual(self.verified_hash("a"), self.verified_hash("b"))

    def test_a_film_is_the_same_file_on_every_processor(self):
        """The C library's sines and powers give other bits where it may not multiply and add at once."""
        without = dict(ENVIRONMENT, GLIBC_TUNABLES="glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX512F")
        for name in ["demo", "visit", "robot-arm", "bodies"]:
            files = [self.folder / f"{name}-{i}.mars" for i in range(2)]
            for file, env in zip(files, [ENVIRONMENT, without]):
                self.succeed("mars", "compile", EXAMPLES / f"{name}.json", "-o", file, env=env)
            self.assertEqual(files[0].read_bytes(), files[1].read_bytes(), name)

    def test_info_of_a_report_says_what_bound_the_run(self):
        self.succeed("mars", "render", TEAPOT, "--sink", "none", "--size", "32x18", "--frames", "0-3", "--backend",
                     "simulated", "--platform", "fat-tree", "--nodes", 2, "--groups", 1, "--report", "run.json")
        report = json.loads((self.folder / "run.json").read_text())
        text = self.succeed("mars", "info", "run.json")
        self.assertIn("nodes       2 nodes in 1 group, simulated\nframes      4\n", text)
        self.assertIn(f"what binds  {report['walls']['binding']} ", text)
        self.assertEqual(len(report["walls"]["walls"]), len(text.splitlines()) - 7)
        del report["walls"]
        self.write("old.json", report)
        old = self.mars("info", "old.json")
        self.assertEqual(old.returncode, 1)
        self.assertClear(old.stderr, "a report without all that this version writes")

    def test_info_of_either_kind_of_file(self):
        self.succeed("mars", "compile", TEAPOT, "-o", "teapot.mars")
        of_film = self.succeed("mars", "info", TEAPOT)
        of_compiled = self.succeed("mars", "info", "teapot.mars")
        self.assertRegex(of_film, r"size +480x270\n")
        self.assertRegex(of_film, r"frames +24 at 24 a second")
        self.assertEqual(of_film.splitlines()[1:], of_compiled.splitlines()[1:])

    def test_import_makes_a_model_that_renders(self):
        self.write("vase.bpt", vase())
        self.succeed("mars", "import", "vase.bpt", "-o", "vase.json", "--joint", "foot")
        joints = json.loads((self.folder / "vase.json").read_text())["joints"]
        self.assertEqual([joint["name"] for joint in joints], ["foot"])
        film = {"frames": 1, "size": [64, 64], "camera": {"eye": [0, -6, 2], "at": [0, 0, 1]},
                "models": {"vase": "vase.json"}, "actors": [{"name": "vase", "model": "vase"}]}
        self.succeed("mars", "render", self.write("film.json", film), "-o", "out", "--backend", "threads")
        film["actors"][0]["place"] = [0, 99, -99]
        self.succeed("mars", "render", self.write("empty.json", film), "-o", "empty", "--backend", "threads")
        self.assertNotEqual(self.verified_hash("out"), self.verified_hash("empty"))

    def test_import_takes_meshes(self):
        self.write("tent.obj", "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 1.5 2\nv 4 1.5 2\n"
                               "f 1 2 6 5\nf 3 4 5 6\nf 2 3 6\nf 4 1 5\nf 4 3 2 1\n")
        printed = self.succeed("mars", "import", "tent.obj", "-o", "tent.json", "--up", "z")
        self.assertEqual(printed, "tent.json: model of one joint 'tent'\n"
                               "  box        4 x 3 x 2 units, the file's z upward\n"
                               "  read       6 vertices, 5 faces\n"
                               "  not read   nothing: all of the file was read\n")
        film = {"frames": 1, "size": [64, 64], "camera": {"eye": [2, -9, 3], "at": [2, 1, 1]},
                "models": {"tent": "tent.json"}, "actors": [{"name": "tent", "model": "tent"}]}
        film = self.write("film.json", film)
        self.assertRegex(self.succeed("mars", "info", film), r"triangles +8, 8 of them stored")
        self.succeed("mars", "render", film, "-o", "out", "--backend", "threads")
        self.write("tent.mtl", "newmtl canvas\nKs 1 1 1\n")
        self.write("tent.obj", "mtllib tent.mtl\nusemtl canvas\n" + (self.folder / "tent.obj").read_text())
        printed = self.succeed("mars", "import", "tent.obj", "-o", "tent.json", "--force")
        remedy = re.search(r"1 material's gloss \((mars model .* set .*)\)", printed).group(1)
        self.assertEqual(remedy, "mars model tent.json set tent --material color --specular 0.3")
        self.succeed(*remedy.split())
        self.fail_clearly(1, "import", self.write("bad.obj", "f 1 2 3\n"), "-o", "bad.json", says="bad.obj")

    def test_import_replaces_a_model_only_by_force(self):
        self.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.write("flat.json", "mine")
        self.fail_clearly(1, "import", "flat.obj", "-o", "flat.json", says="replace it with --force")
        self.assertEqual((self.folder / "flat.json").read_text(), "mine")
        self.succeed("mars", "import", "flat.obj", "-o", "flat.json", "--force", "--scale", "2", "--crease", "22.5")
        self.assertEqual(json.loads((self.folder / "flat.json").read_text())["joints"][0]["segment"]["sbb"][1], [2, 1, 2])
        for option, value in [("--scale", "0"), ("--scale", "nan"), ("--crease", "181"), ("--up", "w"), ("--front", "-w"),
                              ("--height", "0")]:
            self.fail_clearly(2, "import", "flat.obj", "-o", "other.json", option, value, says=f"'{value}' is no")
        self.succeed("mars", "import", "flat.obj", "-o", "other.json", "--up", "Z")
        turned = ["mars", "import", "flat.obj", "-o", "turned.json", "--up", "-x", "--front", "-Y", "--height", "3"]
        self.assertIn("3 x 0 x 3 units, the file's -x upward", self.succeed(*turned))
        self.fail_clearly(2, *turned[1:], "--scale", "2", says="--scale excludes --height")

    def test_an_import_that_waits_ends_with_mars(self):
        """Its reader has so much to read that it can be stopped before its end."""
        self.write("waits.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 1000000)
        mars = subprocess.Popen([PROGRAMS / "mars", "import", "waits.obj", "-o", "waits.json"], cwd=self.folder)
        self.addCleanup(mars.kill)
        reader = {}
        wait_until(lambda: reader.update(family(mars.pid)) or reader, SECONDS, "no reader")
        wait_until(lambda: all(limited(each) for each in reader), SECONDS, "the reader does not get ready")
        self.addCleanup(lambda: [os.kill(each, signal.SIGKILL) for each in living(reader)])
        for each in reader:
            os.kill(each, signal.SIGSTOP)
        mars.terminate()
        self.assertEqual(mars.wait(SECONDS), -signal.SIGTERM)
        wait_until(lambda: not living(reader), SECONDS, "the reader goes on")
        self.assertFalse((self.folder / "waits.json").exists())

    def test_film_of_the_readme(self):
        text = (SOURCES / "README.md").read_text()
        self.write("first.json", text.split("```json\n")[1].split("```")[0])
        self.succeed("mars", "render", "first.json", "-o", "first", "--size", "160x90")
        self.assertIn("48 frames, all there and whole", self.succeed("mars", "verify", "first"))

    def test_frames_are_those_asked_for(self):
        self.succeed("mars", "render", TEAPOT, "-o", "out", *SMALL, "--frames", "3,1-2,22-")
        self.assertEqual(sorted(path.name for path in (self.folder / "out").glob("*.png")),
                         [f"frame-{number:04}.png" for number in [1, 2, 3, 22, 23]])

    def test_size_is_the_one_asked_for(self):
        self.succeed("mars", "render", TEAPOT, "-o", "out", "--size", "33x7", "--frames", "0")
        header = (self.folder / "out/frame-0000.png").read_bytes()[16:24]
        self.assertEqual(struct.unpack(">II", header), (33, 7))

    def test_report_adds_up(self):
        self.succeed("mars", "render", EXAMPLES / "robot-arm.json", "-o", "out", *SMALL, "--frames", "0-4",
                     "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual([frame["frame"] for frame in report["frames"]], [0, 1, 2, 3, 4])
        self.assertEqual(len(report["nodes"]), 2)
        keyframe = report["frames"][0]
        self.assertEqual(keyframe["kind"], "keyframe")
        work = [node["work"] for node in keyframe["nodes"]]
        for counted in ["edge_boxes_diced", "edge_boxes"]:
            self.assertEqual(sum(each[counted] for each in work), keyframe["edge_box_total"])

    def test_a_sink_of_none_writes_nothing(self):
        self.succeed("mars", "render", TEAPOT, "--sink", "none", *SMALL)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_benchmarks_are_those_built(self):
        self.assertIn("  peers\n", self.succeed("mars", "bench"))
        self.assertIn("--rounds", self.succeed("mars", "bench", "peers", "--help"))
        unknown = self.mars("bench", "pears", "--rounds", "3")
        self.assertEqual(unknown.returncode, 1)
        self.assertIn("those here: ", unknown.stderr)

    def test_benchmarks_say_what_they_lack(self):
        def run(program, *words):
            file = self.write("program.py", program)
            return subprocess.run([sys.executable, "-B", SOURCES / "tests/bench/run.py", file, *words],
                                  capture_output=True, text=True, timeout=SECONDS)

        self.write("selenium.py", "raise ModuleNotFoundError('No module named selenium', name='selenium')")
        module = run("from selenium import webdriver")
        self.assertEqual((module.returncode, module.stdout), (1, ""))
        self.assertClear(module.stderr, "mars bench program: needs the module selenium, which")
        self.assertIn("(Debian: apt install python3-selenium)", module.stderr)
        program = run("import subprocess\nsubprocess.run(['chromedriver'], env={'PATH': '/nowhere'})")
        self.assertClear(program.stderr, "needs the program chromedriver, which is not installed (Debian: apt install")
        unbuilt = run("import subprocess\nsubprocess.run(['/nowhere/bench/x'])", "--build", "/nowhere")
        self.assertClear(unbuilt.stderr, "needs /nowhere/bench/x, which is not built (./bootstrap bench)")
        stopped = run("raise KeyboardInterrupt")
        self.assertEqual((stopped.returncode, stopped.stderr.strip()), (-signal.SIGINT, ""))
        self.assertIn("ZeroDivisionError", run("1 / 0").stderr)
        self.assertEqual(run("import sys\nprint(sys.argv[1:])", "--build", "x").stdout, "['--build', 'x']\n")

    def test_a_program_by_itself_has_no_benchmarks(self):
        (self.folder / "bin").mkdir()
        shutil.copy(PROGRAMS / "mars", self.folder / "bin/mars")
        alone = subprocess.run([self.folder / "bin/mars", "bench", "peers"], capture_output=True, text=True)
        self.assertEqual(alone.returncode, 1)
        self.assertIn("./bootstrap bench", alone.stderr)

    def test_rendering_again_into_the_same_folder(self):
        for frames in ["0-5", "2-3", "4-7"]:
            self.succeed("mars", "render", TEAPOT, "-o", "out", *SMALL, "--frames", frames)
            self.verified_hash("out")

    def test_verify_prints_missing_and_torn_frames(self):
        self.succeed("mars", "render", TEAPOT, "-o", "out", *SMALL, "--frames", "0-5")
        torn = self.folder / "out/frame-0003.png"
        torn.write_bytes(torn.read_bytes()[:-30])
        (self.folder / "out/frame-0005.png").unlink()
        verdict = self.mars("verify", "out")
        self.assertEqual(verdict.returncode, 1)
        lines = verdict.stdout.splitlines()
        self.assertEqual([line.split(":")[0] for line in lines[:2]], ["frame 3", "frame 5"])
        self.assertIn("2 of 6", lines[2])


if __name__ == "__main__":
    main()
