"""What a person sees of a rendering on a terminal, in a pipe, and with --quiet."""

import fcntl
import os
import pty
import struct
import subprocess
import termios
import time

from harness import (ENVIRONMENT, EXAMPLES, PROGRAMS, SECONDS, ProgramTest, SideBySide, family, main, spinning_teapot,
                     stopped, wait_until)

TEAPOT = EXAMPLES / "teapot.json"
FEW = ["--frames", "0-3"]


class Output(SideBySide, ProgramTest):
    """What mars shows as time goes by, it shows of a job that stands still too."""

    def test_quiet_says_nothing(self):
        self.assertEqual(self.succeed("mars", "render", TEAPOT, "-o", "out", *FEW, "--quiet"), "")

    def test_the_line_shown_can_be_pasted(self):
        film = self.write("it's a film.json", spinning_teapot(4, [64, 36]))
        for backend in self.backends():
            printed = self.succeed("mars", "render", film, "-o", "a b", "--backend", backend, "--nodes", 2,
                                   "--overwrite")
            expected = self.verified_hash("a b")
            (self.folder / "a b/frame-0000.png").unlink()
            events = self.succeed("sh", "-c", printed.splitlines()[0])
            self.assertIn('"event":"done"', events)
            self.assertEqual(self.verified_hash("a b"), expected)

    def test_what_cannot_be_printed_is_a_failure(self):
        self.succeed("mars", "render", TEAPOT, "-o", "out", *FEW, "--quiet")
        for words in (["verify", "out"], ["info", TEAPOT], ["keys"], ["--help"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAMS / "mars", *words], stdout=full, stderr=subprocess.PIPE, text=True,
                                      env=ENVIRONMENT, cwd=self.folder)
            self.assertEqual(done.returncode, 1, words)
            self.assertClear(done.stderr, "standard output: cannot be written: No space left on device")

    def test_nothing_is_written_over_what_is_read(self):
        film = self.write("film.json", {**spinning_teapot(2, [40, 30]), "models": {"box": "box.json"},
                                        "actors": [{"name": "box", "model": "box"}]})
        self.succeed("mars", "model", "box.json", "new", "--figure", "box")
        (self.folder / "link.json").symlink_to("film.json")
        (self.folder / "link.mars").symlink_to("box.json")
        (self.folder / "link.png").symlink_to("film.json")
        render = ["render", film, "-o", "out", "--backend", "threads", "--overwrite"]
        self.succeed("mars", *render)
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        for words in ([*render, "--report", film], [*render, "--trace", "link.json"], [*render, "--report", "box.json"],
                      [*render, "--report", "out/frames.json"], [*render, "--trace", "out/frame-0001.png"],
                      [*render, "--report", "out/.runs"],
                      [*render, "--trace", "./out/film.mars"], ["compile", film, "-o", "link.mars"],
                      ["preview", film, "-o", "link.png"], ["plot", film, "-o", "link.png"]):
            with self.subTest(words=words):
                done = self.mars(*words)
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, "is the file that is read|is the name of a file that the folder of frames keeps")
                for name in ("film.json", "box.json", "out/frame-0001.png"):
                    self.assertEqual((self.folder / name).read_bytes(), before[self.folder / name])
        for other in ("r", "./r"):
            self.assertClear(self.mars(*render, "--report", "r", "--trace", other).stderr, "is named for two things that are written")

    def test_plain_lines_in_a_pipe(self):
        film = self.write("film.json", spinning_teapot(400, [160, 90]))
        words = ["render", film, "-o", "out", "--nodes", "1", "--backend", "threads", "--frames", "0-299"]
        began = time.monotonic()
        with open(self.folder / "printed.txt", "w") as printed:
            process = subprocess.Popen([PROGRAMS / "mars", *words], stdout=printed, env=ENVIRONMENT, cwd=self.folder)
        self.addCleanup(self.end, process)
        printed = (self.folder / "printed.txt").read_text
        wait_until(lambda: len(list(self.folder.glob("out/*.png"))) > 3, SECONDS, "no frame")
        with stopped(family(process.pid)):
            wait_until(lambda: "Progress: " in printed(), SECONDS, "no line of the progress")
        self.assertEqual(process.wait(SECONDS), 0)
        seconds = time.monotonic() - began
        self.assertNotIn("\r", printed())
        self.assertNotIn("\x1b", printed())
        lines = printed().splitlines()
        self.assertLessEqual(len(lines[2:-1]), 1 + seconds / 2)  # one every two seconds
        self.assertRegex(lines[1], r"^1 node on 1 machine \(threads\)")
        for line in lines[2:-1]:
            self.assertRegex(line, r"^Progress: \d+%, frame \d+ of 300, interval \d+ of \d+, [\d.]+ frames/s, \d+:\d\d left")
        self.assertRegex(lines[-1], r"^300 frames in out, [\d.]+ seconds, [\d.]+ frames/s$")

    def test_one_line_on_a_terminal(self):
        film = self.write("film.json", spinning_teapot(200, [240, 135]))
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 60, 0, 0))
        process = subprocess.Popen([PROGRAMS / "mars", "render", film, "-o", "out", "--nodes", "1", "--backend", "threads"],
                                   stdout=theirs, env=ENVIRONMENT, cwd=self.folder)
        self.addCleanup(self.end, process)
        os.close(theirs)
        shown = self.read_states(ours, 1)
        with stopped(family(process.pid)):
            shown += self.read_states(ours, 3)
        shown += self.read_all(ours)
        self.assertEqual(process.wait(), 0)
        states = [part for part in shown.split("\r\x1b[K") if part.startswith("frame ")]
        self.assertGreater(len(states), 3)
        for state in states:
            self.assertLess(len(state.splitlines()[0]), 60)
        self.assertEqual(sum("\n" in state for state in states), 1)  # the last one stays
        self.assertRegex(shown.splitlines()[-1], r"200 frames in out, ")

    @staticmethod
    def read_states(terminal, count):
        shown = ""
        while shown.count("\r\x1b[Kframe ") < count:
            shown += os.read(terminal, 65536).decode()
        return shown

    @staticmethod
    def read_all(terminal):
        shown = b""
        try:
            while more := os.read(terminal, 65536):
                shown += more
        except OSError:  # Linux tells so that nobody writes any more
            pass
        os.close(terminal)
        return shown.decode()


if __name__ == "__main__":
    main()
