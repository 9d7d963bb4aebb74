"""Several runs in one folder: where they fit together they share it; what a killed one has rendered counts."""

import json
import os
import shutil
import signal
import subprocess
import time

from harness import ENVIRONMENT, PROGRAMS, SECONDS, ProgramTest, family, main, spinning_teapot, wait_until

LONG = 30000  # frames: more than are rendered while a test looks on
SMALL = ["--nodes", 1, "--backend", "threads", "--quiet"]


class Folders(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        self.film = self.write("film.json", spinning_teapot(LONG, [160, 90]))
        self.other = self.write("other.json", spinning_teapot(LONG, [120, 90]))

    def start(self, frames):
        shutil.rmtree(self.out, ignore_errors=True)
        return self.start_mars("render", self.film, "-o", "out", *SMALL, "--frames", frames)

    def render(self, film, frames, *more):
        return self.mars("render", film, "-o", "out", *SMALL, "--frames", frames, *more)

    def missing(self):
        return self.succeed("mars", "verify", "out", "--missing").strip()

    def kill(self, process):
        """It and all it started, without a chance to clear anything away."""
        for each in [process.pid, *family(process.pid)]:
            os.kill(each, signal.SIGKILL)
        process.communicate()

    def assertOnlyFrames(self):
        self.assertEqual({path.suffix for path in self.out.iterdir()}, {".png", ".json", ".mars"})
        self.assertNothingTorn(self.out)

    def test_short_runs_do_no_harm_to_a_long_one(self):
        long = self.start("0-999")
        for frame in range(5000, 5004):
            self.succeed("mars", "render", self.film, "-o", "out", *SMALL, "--frames", frame)
        printed = long.communicate(timeout=SECONDS)
        self.assertEqual((long.returncode, printed[1]), (0, ""))
        self.assertIn("1004 frames, all there and whole", self.succeed("mars", "verify", "out"))
        self.assertOnlyFrames()

    def test_frames_of_two_runs_are_not_mixed(self):
        long = self.start("0-99,200-25000")
        by = r"another run, process \d+ on host \S+, renders frames 0-99,200-25000 of "
        for film, frames, says in [(self.film, "99-150", r"give other frames"),
                                   (self.other, "29000", r"give another folder"),
                                   (self.film, "29000", r"")]:
            done = self.render(film, frames)
            self.assertEqual(done.returncode, int(bool(says)), done.stderr)
            if says:
                self.assertClear(done.stderr, "mars: out: another run")
                self.assertRegex(done.stderr, by + rf"\S+film.json into this folder since [\d:]+ \({says}")
        done = self.render(self.film, "29000", "--size", "32x18")
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
        long = self.start("0-25000")
        for each in family(long.pid):
            os.kill(each, signal.SIGSTOP)
        self.assertIn("another run", self.render(self.film, "7").stderr)
        self.kill(long)
        self.assertEqual(self.render(self.film, "7").returncode, 0)
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


if __name__ == "__main__":
    main()
