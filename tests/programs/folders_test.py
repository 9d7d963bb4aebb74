"""Several runs in one folder: where they fit together they share it; what a killed one has rendered counts."""

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import time

from harness import (ENVIRONMENT, EXAMPLES, OWN_MPIRUN, PROGRAMS, SECONDS, ProgramTest, SideBySide, complaints, family,
                     kill, main, send, spinning_teapot, stopped, wait_until)

LONG = 12000  # frames: more than one node renders while a test looks on; and a film is compiled by every run
SMALL = ["--nodes", 1, "--backend", "threads", "--quiet"]


class Folders(SideBySide, ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        self.film = self.write("film.json", spinning_teapot(LONG, [160, 90]))
        self.other = self.write("other.json", spinning_teapot(LONG, [120, 90]))

    def long_run(self, frames, backend="threads"):
        return ["render", self.film, "-o", "out", "--nodes", 1, "--backend", backend, "--quiet", "--frames", frames]

    def start(self, frames):
        shutil.rmtree(self.out, ignore_errors=True)
        return self.start_mars(*self.long_run(frames))

    def render(self, film, frames, *more):
        return self.mars("render", film, "-o", "out", *SMALL, "--frames", frames, *more)

    def missing(self):
        return self.succeed("mars", "verify", "out", "--missing").strip()

    def kill(self, process):
        """It and all it started, without a chance to clear anything away."""
        kill([process.pid, *family(process.pid)])
        process.communicate()

    def assertOnlyFrames(self):
        self.assertEqual({path.suffix for path in self.out.iterdir()}, {".png", ".json", ".mars"})
        self.assertNothingTorn(self.out)

    def test_short_runs_do_no_harm_to_a_long_one(self):
        long = self.start("0-599")
        for frame in range(5000, 5004):
            self.succeed("mars", "render", self.film, "-o", "out", *SMALL, "--frames", frame)
        printed = long.communicate(timeout=SECONDS)
        self.assertEqual((long.returncode, complaints(printed[1])), (0, ""))
        self.assertIn("604 frames, all there and whole", self.succeed("mars", "verify", "out"))
        self.assertOnlyFrames()

    def test_frames_of_two_runs_are_not_mixed(self):
        long = self.start("0-99,200-11000")
        by = r"another run, process \d+ on host \S+, renders frames 0-99,200-11000 of "
        with stopped([long.pid, *family(long.pid)]):  # so that it does not end before the others
            for film, frames, says in [(self.film, "99-150", r"give other frames"),
                                       (self.other, "11900", r"give another folder"),
                                       (self.film, "11900", r"")]:
                done = self.render(film, frames)
                self.assertEqual(done.returncode, int(bool(says)), done.stderr)
                if says:
                    self.assertClear(done.stderr, "mars: out: another run")
                    self.assertRegex(done.stderr, by + rf"\S+film.json into this folder since [\d:]+ \({says}")
            done = self.render(self.film, "11900", "--size", "32x18")
            self.assertIn("of another version, size or format of ", done.stderr)
            self.assertIsNone(long.poll())
        long.terminate()
        long.communicate(timeout=SECONDS)
        self.assertOnlyFrames()
        self.assertClear(self.render(self.other, "0-3").stderr, "or replace them with --overwrite")
        self.assertEqual(self.render(self.other, "0-3", "--overwrite").returncode, 0, "nobody is there any more")
        self.assertIn("4 frames, all there", self.succeed("mars", "verify", "out"))

    def test_of_runs_started_at_once_one_goes_on(self):
        words = [PROGRAMS / "mars-threads", self.film, "-o", "out", "--nodes", "1"]
        runs = []
        for name in range(6):
            with open(self.folder / f"{name}.txt", "w") as printed:
                runs.append(subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=printed, env=ENVIRONMENT,
                                             cwd=self.folder))
            self.addCleanup(self.end, runs[-1])
        wait_until(lambda: sum(run.poll() is not None for run in runs) >= 5, SECONDS, "more than one goes on")
        wait_until(lambda: len(list(self.out.glob("*.png"))) > 20, SECONDS, "none goes on")
        alive = [run.poll() is None for run in runs]
        self.assertEqual(alive.count(True), 1)
        winner = runs[alive.index(True)].pid
        for name, goes_on in enumerate(alive):
            if not goes_on:
                self.assertIn(f"process {winner} on host", (self.folder / f"{name}.txt").read_text())

    def test_waiting_for_another_run_is_part_of_loading(self):
        """Only then are nodes waited for, and a person hears of those that do not answer."""
        runs = self.out / ".runs"
        runs.mkdir(parents=True)
        turn = runs / "n7-1-0000000000000000.turn"
        turn.write_text(json.dumps({"host": "n7", "boot": "another", "processes": "", "process": 1, "start": 1}))
        events = self.folder / "events.txt"
        with open(events, "w") as output:
            words = [PROGRAMS / "mars-threads", self.film, "-o", "out", "--nodes", "1", "--frames", "0-1"]
            run = subprocess.Popen(words, stdout=output, env=ENVIRONMENT, cwd=self.folder)
        self.addCleanup(self.end, run)
        wait_until(lambda: len(list(runs.iterdir())) == 2, SECONDS, "it does not ask for its turn")
        time.sleep(0.3)
        names = [json.loads(line)["event"] for line in events.read_text().splitlines()]
        self.assertEqual((names[0], "loaded" in names), ("loading", False))
        turn.unlink()
        self.assertEqual(run.wait(timeout=SECONDS), 0)
        self.assertIn('"event":"loaded"', events.read_text())

    def test_a_stopped_run_keeps_its_claim_and_a_killed_one_does_not(self):
        long = self.start("0-11000")
        send([long.pid, *family(long.pid)], signal.SIGSTOP)
        self.assertIn("another run", self.render(self.film, "11000").stderr)
        self.assertEqual(self.render(self.film, "0").returncode, 0, "that is there already")
        self.kill(long)
        self.assertTrue((self.out / ".runs").exists())
        # It clears up also where nothing is left to render, but for 2.5 seconds at most.
        cleared = lambda: self.render(self.film, "0").returncode == 0 and not (self.out / ".runs").exists()
        wait_until(cleared, SECONDS, "the killed run's claim stays")
        self.assertEqual(self.render(self.film, "11000").returncode, 0)
        self.assertOnlyFrames()

    def test_after_a_kill_only_what_is_missing_is_rendered(self):
        self.kill(self.start("0-400"))
        missing = self.missing()
        self.assertRegex(missing, r"^[\d,-]*400$")
        there = {path.name: path.stat().st_mtime_ns for path in self.out.glob("*.png")}
        first = int(missing.split("-")[0].split(",")[0])
        self.assertGreater(first, 0)
        self.succeed("mars", "render", self.film, "-o", "out", *SMALL, "--frames", missing)
        self.assertIn("401 frames, all there", self.succeed("mars", "verify", "out"))
        for number in range(first):
            name = f"frame-{number:05}.png"
            self.assertEqual((self.out / name).stat().st_mtime_ns, there[name], "it was there already")
        self.assertOnlyFrames()

    def test_a_manifest_that_is_spoilt_while_a_run_renders(self):
        """Cut short, or replaced by what it may not replace: exit code 0 only with a folder that verify takes."""
        for spoilt, code in [('{"checksum": "0123', 0), ('{"version": 99}', 1)]:
            with self.half_way(400, *self.long_run("0-399", self.backends()[-1])) as (run, _):
                (self.out / "frames.json").write_text(spoilt)
            printed = run.communicate(timeout=SECONDS)[1]
            self.assertEqual(run.returncode, code, printed)
            if code != 0:
                self.assertClear(printed, "out/frames.json: cannot be read: it has version 99 and this MARS knows")
                continue
            self.assertIn("mars: warning: frames.json was lost or damaged", printed)
            self.assertIn("400 frames, all there and whole", self.succeed("mars", "verify", "out"))
            self.assertOnlyFrames()

    def test_a_film_that_is_spoilt_while_a_run_renders(self):
        for spoil in [lambda film: film.write_bytes(film.read_bytes()[:100]), lambda film: film.unlink()]:
            shutil.rmtree(self.out, ignore_errors=True)
            with self.half_way(400, *self.long_run("0-399")) as (run, _):
                whole = (self.out / "film.mars").read_bytes()
                spoil(self.out / "film.mars")
            printed = run.communicate(timeout=SECONDS)[1]
            self.assertEqual(run.returncode, 0, printed)
            self.assertIn("mars: warning: film.mars was lost or damaged: it is written again", printed)
            self.assertEqual((self.out / "film.mars").read_bytes(), whole)

    def test_files_of_other_programs_stay(self):
        self.out.mkdir()
        (self.out / "frame-00003.png").write_text("mine")
        done = self.render(self.film, "0-9")
        self.assertEqual(done.returncode, 1)
        self.assertIn("MARS has not made frame-00003.png in this folder", done.stderr)
        self.assertEqual([path.name for path in self.out.iterdir()], ["frame-00003.png"])
        self.assertEqual(self.render(self.film, "0-2").returncode, 0, "it is in no frame's way")
        self.assertEqual((self.out / "frame-00003.png").read_text(), "mine")
        shutil.rmtree(self.out)
        self.out.mkdir()
        (self.out / "frame-00003.png").write_text("mine")
        self.assertEqual(self.render(self.film, "0-9", "--overwrite").returncode, 0)

    def test_frames_that_somebody_removes_while_a_run_renders(self):
        with self.half_way(400, *self.long_run("0-399")) as (run, _):
            min(self.out.glob("*.png")).unlink()
        printed = run.communicate(timeout=SECONDS)[1]
        self.assertEqual(run.returncode, 0, printed)
        self.assertIn("400 frames, all there and whole", self.succeed("mars", "verify", "out"))
        self.assertOnlyFrames()

    def test_missing_is_what_frames_takes(self):
        self.assertEqual(self.render(self.film, "0-9").returncode, 0)
        self.assertEqual(self.missing(), "")
        done = self.render(self.film, self.missing())
        self.assertEqual((done.returncode, "--frames" in done.stderr), (2, True))
        expected = self.verified_hash("out")
        (self.out / "frame-00003.png").unlink()
        (self.out / "frame-00004.png").write_bytes((self.out / "frame-00005.png").read_bytes())
        (self.out / "frame-00008.png").write_bytes(b"torn")
        printed = self.mars("verify", "out")
        self.assertEqual(printed.returncode, 1)
        self.assertIn("frame 4: other pixels than were rendered\n", printed.stdout)
        self.assertEqual(self.missing(), "3-4,8")
        self.assertEqual(self.render(self.film, self.missing(), "--overwrite").returncode, 0)
        self.assertEqual(self.verified_hash("out"), expected)


class GoingOn(SideBySide, ProgramTest):
    """The command that started a rendering also goes on with it."""

    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        self.film = self.write("film.json", spinning_teapot(24, [64, 36]))

    def render(self, *more, code=0, film=None):
        done = self.mars("render", film or self.film, "-o", "out", "--nodes", 2, "--backend", "threads", *more)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr if code else done.stdout

    def times(self):
        return {path.name: path.stat().st_mtime_ns for path in self.out.glob("*.png")}

    def edit(self, **changes):
        self.write("film.json", {**json.loads(self.film.read_text()), **changes})

    def test_a_complete_folder_needs_no_job(self):
        self.render()
        before = self.times()
        self.assertEqual(self.render(), "24 of 24 frames are there already: nothing is left to render\n")
        self.assertEqual(self.mars("render", self.film, "-o", "out", "-q", env={"PATH": ""}).returncode, 0)
        self.out.chmod(0o555)
        self.render("--frames", "3-5")
        self.out.chmod(0o755)
        self.assertEqual(self.times(), before)

    def test_the_host_sees_it_by_itself_too(self):
        expected = self.render() and self.verified_hash("out")
        for words in self.hosts():
            with self.subTest(words=words[0]):
                events = [json.loads(line) for line in self.succeed(*words).splitlines()]
                self.assertEqual([event["event"] for event in events], ["loading", "resumed", "loaded", "done"])
                self.assertEqual((events[1]["there"], events[1]["of"], events[3]["frames"]), (24, 24, 0))
        self.assertEqual(self.verified_hash("out"), expected)

    def hosts(self):
        words = [self.film, "-o", "out"]
        hosts = [["mars-threads", *words, "--nodes", 3], ["mars-simulated", *words, "--nodes", 3]]
        if "mpi" in self.backends():
            hosts += [[*OWN_MPIRUN, "-n", 4, PROGRAMS / "mars-ranks", *words],
                      [*OWN_MPIRUN, "-n", 1, PROGRAMS / "mars-host", *words, ":", "-n", 3, PROGRAMS / "mars-node"]]
        return hosts

    def test_only_what_is_missing_is_rendered(self):
        self.render()
        expected, before = self.verified_hash("out"), self.times()
        for name in ["frame-0003.png", "frame-0017.png"]:
            (self.out / name).unlink()
        (self.out / "frame-0003.png").touch()
        os.mkfifo(self.out / "frame-0017.png")
        self.assertIn("22 of 24 frames are there already\n", self.render())
        self.assertEqual(self.verified_hash("out"), expected)
        changed = {name for name, time in self.times().items() if before[name] != time}
        self.assertEqual(changed, {"frame-0003.png", "frame-0017.png"})

    def test_what_has_the_name_of_the_kept_film_gives_way(self):
        self.render("--frames", "0-3")
        expected = self.verified_hash("out")
        for make in (os.mkfifo, os.mkdir, lambda path: os.symlink("nowhere", path)):
            (self.out / "film.mars").unlink()
            make(self.out / "film.mars")
            (self.out / "frames.json").unlink()
            (self.out / "frame-0002.png").unlink()
            self.render("--frames", "0-3")
            self.assertTrue((self.out / "film.mars").is_file())
            self.assertEqual(self.verified_hash("out"), expected)

    def test_the_kept_film_in_another_size_is_another_film(self):
        self.render()
        expected = self.verified_hash("out")
        self.render("--size", "32x18", "--overwrite", film=self.out / "film.mars")
        self.assertIn("--overwrite", self.render(code=1), "its frames are not the film's")
        self.render("--overwrite")
        self.assertEqual(self.verified_hash("out"), expected)

    def test_a_measurement_of_nothing_is_none(self):
        self.render()
        printed = self.mars("render", self.film, "-o", "out", "--backend", "threads", "--report", "report.json")
        self.assertEqual(printed.returncode, 0)
        self.assertIn("nothing is left to render, so report.json is not written (--overwrite", printed.stderr)
        self.assertFalse((self.folder / "report.json").exists())
        self.render("--overwrite", "--report", "report.json")
        self.assertEqual(len(json.loads((self.folder / "report.json").read_text())["frames"]), 24)

    def test_an_edited_film(self):
        self.render("--intervals", "keyframes")
        edited = json.loads(self.film.read_text())
        edited["actors"][0]["keys"][-1]["turn"] = [0, 0, 5]
        self.edit(**edited)
        printed = self.render("--intervals", "keyframes")
        self.assertRegex(printed, r"film.json has changed: \S.* to be rendered again \(interval\S* \S+ of \d+\)\n")
        seen = self.verified_hash("out")
        self.render("--intervals", "keyframes", "--overwrite")
        self.assertEqual(self.verified_hash("out"), seen)

    def test_what_cannot_be_mixed_is_refused(self):
        self.render()
        before = self.times()
        other = self.write("other.json", {**spinning_teapot(24, [64, 36]), "background": [0.5, 0, 0]})
        for film, more in [(other, []), (self.film, ["--size", "32x18"]), (self.film, ["--samples", 1]),
                           (self.film, ["--format", "exr"])]:
            self.assertClear(self.render(*more, film=film, code=1), "replace them with --overwrite")
            self.assertEqual(self.times(), before)
        self.render("--overwrite", film=other)
        self.assertIn("24 of 24", self.render(film=other))

    def test_repair_of_the_manifest(self):
        self.render()
        expected, before = self.verified_hash("out"), self.times()
        self.edit(background=[1, 0, 0])
        for film_too in [False, True]:
            (self.out / "frames.json").write_bytes((self.out / "frames.json").read_bytes()[:40])
            if film_too:
                (self.out / "film.mars").write_bytes(b"lost")
            self.assertClear(self.mars("verify", "out").stderr, "(mars verify --repair out makes it again)")
            printed = self.succeed("mars", "verify", "out", "--repair")
            self.assertIn("made again from what runs and the frames say: 24 frames\n", printed)
            self.assertTrue(printed.splitlines()[-1].endswith(expected), printed)
            self.assertEqual(self.times(), before, "what is whole is not rendered")

    def test_repair(self):
        self.render()
        expected, whole = self.verified_hash("out"), (self.out / "frame-0005.png").read_bytes()
        (self.out / "frame-0003.png").unlink()
        (self.out / "frame-0004.png").write_bytes(whole)
        (self.out / "frame-0008.png").write_bytes(whole[:100])
        self.edit(background=[1, 0, 0])  # what is rendered is the film that the folder keeps
        printed = self.succeed("mars", "verify", "out", "--repair", "--backend", "threads", "--nodes", 2)
        self.assertIn("3 of 24 frames are missing or wrong\n", printed)
        self.assertTrue(printed.splitlines()[-1].endswith(expected), printed)
        self.assertEqual(self.verified_hash("out"), expected)
        self.assertIn("24 frames, all there", self.succeed("mars", "verify", "out", "--repair"))
        (self.out / "frame-0003.png").unlink()
        (self.out / "film.mars").unlink()
        self.assertIn("--repair", self.mars("verify", "out", "--nodes", 2).stderr)

    def advised(self, text):
        """The command in what a program printed, run as it stands there."""
        command = re.search(r"\bmars ((?:render|verify) [^;()\n]*)", text)[1]
        return self.succeed("mars", *shlex.split(command))

    def test_what_is_advised_makes_the_folder_whole(self):
        asked = ["--size", "80x60", "--samples", 2, "--frames", "3,5-9"]
        self.render(*asked)
        expected = self.verified_hash("out")
        for lost in (["frame-0005.png"], ["frame-0005.png", "frame-0006.png"],
                     ["film.mars", "frame-0007.png"], ["film.mars", "frame-0003.png", "frame-0009.png"]):
            with self.subTest(lost=lost):
                for name in lost:
                    (self.out / name).unlink()
                self.assertIn("(render again: mars verify --repair out)", self.mars("verify", "out").stdout)
                done = self.mars("verify", "--repair", "out")
                self.assertEqual(done.returncode, 1 if "film.mars" in lost else 0)
                if done.returncode != 0:
                    self.assertClear(done.stderr, "has no film.mars, from which frames can be rendered again")
                    self.advised(done.stderr)
                self.assertEqual(self.verified_hash("out"), expected)

    def test_repair_names_what_left_nothing(self):
        self.render()
        expected = self.verified_hash("out")
        for lost, says in ((["frame-0003.png"], r"frame 3 of the film left nothing; if you had rendered it: mars"),
                           (["frame-0003.png", "frame-0023.png"], r"frames 3,23 of the film left nothing; if you had")):
            for name in ["frames.json", *lost]:
                (self.out / name).unlink()
            printed = self.succeed("mars", "verify", "out", "--repair")
            self.assertIn(says, printed)
            self.advised(printed)
            self.assertEqual(self.verified_hash("out"), expected)

    def test_frames_of_several_films_and_nothing_that_tells(self):
        self.render()
        expected = self.verified_hash("out")
        other = self.write("other.json", {**spinning_teapot(24, [64, 36]), "background": [1, 0, 0]})
        self.succeed("mars-threads", other, "-o", "other", "--frames", "3")
        for name in ("frames.json", "film.mars"):
            (self.out / name).unlink()
        shutil.copy(self.folder / "other/frame-0003.png", self.out)
        self.assertClear(self.mars("verify", "--repair", "out").stderr,
                         "out: its frames are of several films or damaged, and neither frames.json nor film.mars says which")
        self.render()
        self.assertEqual(self.verified_hash("out"), expected)

    def test_a_damaged_film_is_not_called_missing(self):
        self.render()
        expected = self.verified_hash("out")
        (self.out / "film.mars").write_bytes((self.out / "film.mars").read_bytes()[:-100])
        (self.out / "frame-0003.png").unlink()
        done = self.mars("verify", "--repair", "out")
        self.assertClear(done.stderr, "its film.mars is damaged, so that no frame can be rendered from it")
        self.advised(done.stderr)
        self.assertEqual(self.verified_hash("out"), expected)

    def test_frames_in_a_row_are_one_line(self):
        self.render("--size", "80x60")
        for frame in (2, 3, 4, 8):
            (self.out / f"frame-{frame:04}.png").unlink()
        self.assertEqual(self.mars("verify", "out").stdout, "frames 2-4: missing\nframe 8: missing\n"
                         "4 of 24 frames are missing or wrong (render again: mars verify --repair out)\n")

    def test_the_manifest_of_another_folder(self):
        self.render("--size", "80x60")
        expected = self.verified_hash("out")
        other = self.write("other.json", {**spinning_teapot(24, [80, 60]), "background": [1, 0, 0]})
        self.succeed("mars-threads", other, "-o", "other")
        shutil.copy(self.folder / "other/frames.json", self.out)
        self.assertClear(self.mars("verify", "--repair", "out").stderr,
                         f"is of another film than film.mars is, {other} (if it is another folder's, remove it")
        self.assertIn("frames.json is of another film than film.mars is, ", self.render(code=1))
        (self.out / "frames.json").unlink()
        self.succeed("mars", "verify", "--repair", "out")
        self.assertEqual(self.verified_hash("out"), expected)

    def test_what_options_change_is_not_the_film_that_changed(self):
        film = EXAMPLES / "cubes.json"
        self.render("--size", "80x60", film=film)
        printed = self.render("--size", "80x60", "--intervals", "keyframes", film=film)
        self.assertIn("cubes.json is asked for with other options: frame 48 is to be rendered again", printed)

    def test_frames_that_are_listed_no_more_are_counted(self):
        self.render("--size", "80x60")
        other = self.write("other.json", spinning_teapot(3, [80, 60]))
        printed = self.render("--overwrite", film=other)
        self.assertIn(f"frames.json lists no more frames 3-23 of {self.film}, whose files stay\n", printed)

    def test_a_forgotten_option_is_named(self):
        self.render("--size", "80x60", "--samples", 2)
        (self.out / "film.mars").unlink()
        refused = self.render(code=1)
        self.assertClear(refused, "they were rendered by: mars render ")
        self.assertIn(" --size 80x60 --samples 2 -o out; else", refused)

    def test_pieces_that_start_at_once(self):
        runs = [subprocess.Popen([PROGRAMS / "mars-threads", self.film, "-o", "out", "--nodes", "1", "--frames",
                                  f"{6 * piece}-{6 * piece + 5}"], stdout=subprocess.DEVNULL, env=ENVIRONMENT,
                                 cwd=self.folder) for piece in range(4)]
        for run in runs:
            self.addCleanup(self.end, run)
            self.assertEqual(run.wait(timeout=SECONDS), 0)
        self.assertIn("24 frames, all there and whole", self.succeed("mars", "verify", "out"))
        self.assertIn("24 of 24", self.render())


if __name__ == "__main__":
    main()
