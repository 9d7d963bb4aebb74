"""`mars preview` and `mars play`: as a person sees them in a terminal, and the pictures, sheets and videos they
write."""

import fcntl
import json
import os
import re
import signal
import struct
import termios
import time

import harness
from harness import EXAMPLES, ENVIRONMENT, SECONDS, ProgramTest, intact, main, needs
from png_reader import png_rows
from screen import ENTER, LEAVE, Screen

HUMAN = EXAMPLES / "models/human.json"
ARM = EXAMPLES / "robot-arm.json"
needs_ffmpeg = needs("ffmpeg", "ffprobe")


def size_of(png):
    return struct.unpack(">II", png.read_bytes()[16:24])


class InATerminal(ProgramTest):
    def preview(self, *words, **more):
        screen = Screen(self.folder, *words, **more)
        self.addCleanup(screen.close)
        return screen

    def test_plays_at_the_films_rate(self):
        film = harness.spinning_teapot(240, [64, 36])
        screen = self.preview("preview", self.write("film.json", film))
        first = int(screen.wait_for(rb"(\d+)/239  24 frames/s  prisms, camera").group(1))
        begun = time.monotonic()
        while time.monotonic() - begun < 4:
            screen.read(0.05)
        last = int(re.findall(rb"(\d+)/239 ", screen.seen)[-1])
        self.assertAlmostEqual(last - first, 24 * (time.monotonic() - begun), delta=24)
        self.assertIn("▀".encode(), screen.seen)
        self.assertIn(b"\x1b[38;2;", screen.seen)

    def test_obeys_keys(self):
        screen = self.preview("preview", ARM)
        screen.wait_for(b"prisms, camera")
        screen.press(b"1", b"stick, camera")
        screen.press(b"2", b"vertices, camera")
        paused = screen.press(b" ", rb" (\d+)/\d+  24 frames/s  paused")
        screen.press(b".", rb" %d/" % (int(paused.group(1)) + 1))
        screen.press(b",", rb" %d/" % int(paused.group(1)))
        screen.press(b"]", b"48 frames/s")
        screen.press(b"[", b"24 frames/s")
        screen.press(b"f", b"vertices, front")
        screen.press(b"s", b"vertices, side")
        screen.press(b"t", b"vertices, top")
        screen.press(b"\x1b[A", b"vertices, turned")
        screen.press(b"c", b"vertices, camera")
        screen.press(b"l", b"once")
        screen.press(b"h", b"arrows turn.*space pause")
        screen.press(b"\x1b[H", b" 0/")
        screen.press(b"\x1b[F", rb" (\d+)/\1 ")
        os.write(screen.master, b"q")
        self.assertEqual(screen.end(), 0)
        self.assertTrue(screen.given_back())

    def test_shows_the_rendered_surface(self):
        screen = self.preview("preview", ARM, "--as", "surface")
        screen.wait_for(rb"surface, camera  h help")  # and no word of rendering
        screen.press(b"\x1b[C", rb"surface, turned  rendering .*surface, turned  h help")
        os.write(screen.master, b"q")
        self.assertEqual(screen.end(), 0)

    def test_gives_the_terminal_back_however_it_ends(self):
        for number, code in [(signal.SIGINT, 0), (signal.SIGTERM, -signal.SIGTERM), (signal.SIGHUP, -signal.SIGHUP)]:
            with self.subTest(number):
                screen = self.preview("preview", ARM)
                screen.wait_for(b"prisms")
                screen.process.send_signal(number)
                self.assertEqual(screen.end(), code)
                self.assertTrue(screen.given_back())
        screen = self.preview("preview", ARM)
        screen.wait_for(b"prisms")
        os.write(screen.master, b"\x03")  # Ctrl-C
        self.assertEqual(screen.end(), 0)
        self.assertTrue(screen.given_back())

    def test_gives_the_terminal_back_after_a_failure(self):
        frames = self.rendered(6)
        (frames / "frame-0003.png").write_bytes(b"torn")
        screen = self.preview("play", frames)
        self.assertEqual(screen.end(), 1)
        self.assertTrue(screen.given_back())
        self.assertIn(b"frame-0003.png: not a whole PNG picture", screen.seen[screen.seen.rindex(LEAVE):])

    def test_ends_though_the_terminal_takes_nothing(self):
        screen = self.preview("preview", ARM)
        screen.wait_for(b"prisms")
        termios.tcflow(screen.slave, termios.TCOOFF)
        time.sleep(0.2)  # until the next picture is written
        screen.process.send_signal(signal.SIGTERM)
        self.assertEqual(screen.process.wait(SECONDS), -signal.SIGTERM)
        self.assertEqual(termios.tcgetattr(screen.slave), screen.before)

    def test_ends_when_the_terminal_is_closed(self):
        for words in [("preview", ARM), ("play", self.rendered(6))]:
            for key in [b"", b" "]:  # playing, and paused
                screen = Screen(self.folder, *words)
                self.addCleanup(screen.process.kill)
                screen.wait_for(b"frames/s")
                if key:
                    screen.press(key, b"paused")
                os.close(screen.slave)
                os.close(screen.master)
                self.assertEqual(screen.process.wait(SECONDS), -signal.SIGHUP)

    def test_suspends_and_resumes_under_a_shell(self):
        for words in [("preview", ARM), ("play", self.rendered(6))]:
            screen = self.preview(*words, shell=["sh", "-mc", '"$@"; echo its place; read line; fg', "sh"])
            screen.wait_for(b"frames/s")
            screen.press(b"\x1a", b"its place")
            self.assertTrue(screen.given_back())
            screen.press(b"\n", re.escape(ENTER) + b".*frames/s")
            screen.press(b" ", b"paused")  # without a new line
            os.write(screen.master, b"q")
            self.assertEqual(screen.end(), 0)
            self.assertTrue(screen.given_back())

    def test_plays_on_where_nobody_could_continue_it(self):
        screen = self.preview("preview", ARM)
        screen.wait_for(b"prisms")
        screen.press(b"\x1a", re.escape(ENTER) + b".*prisms")
        screen.press(b" ", b"paused")

    def test_plays_on_after_a_stop_that_nobody_can_prepare_for(self):
        """Whoever stopped it may have changed the terminal's modes meanwhile."""
        screen = self.preview("preview", ARM)
        screen.wait_for(b"prisms")
        screen.process.send_signal(signal.SIGSTOP)
        harness.wait_until(lambda: self.stopped(screen.process.pid), SECONDS, "not stopped")
        while screen.read(0.05):
            pass
        termios.tcsetattr(screen.slave, termios.TCSANOW, screen.before)
        since = len(screen.seen)
        screen.process.send_signal(signal.SIGCONT)
        screen.wait_for(re.escape(ENTER) + b".*prisms", since)
        screen.press(b" ", b"paused")  # without a new line
        screen.process.send_signal(signal.SIGSTOP)
        screen.process.send_signal(signal.SIGTERM)
        screen.process.send_signal(signal.SIGCONT)
        self.assertEqual(screen.end(), -signal.SIGTERM)
        self.assertEqual(termios.tcgetattr(screen.slave), screen.before)

    @staticmethod
    def stopped(process):
        with open(f"/proc/{process}/stat") as stat:
            return stat.read().rpartition(")")[2].split()[0] == "T"

    def test_follows_the_windows_size(self):
        screen = self.preview("preview", ARM)
        screen.wait_for(rb"\x1b\[24;1H")
        fcntl.ioctl(screen.slave, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 120, 0, 0))
        screen.wait_for(rb"\x1b\[40;1H")
        fcntl.ioctl(screen.slave, termios.TIOCSWINSZ, struct.pack("HHHH", 2, 3, 0, 0))
        screen.wait_for(rb"\x1b\[2;1H")
        os.write(screen.master, b"q")
        self.assertEqual(screen.end(), 0)

    def test_uses_the_terminals_graphics(self):
        for answers, shown in [(b"\x1b_Gi=31;OK\x1b\\\x1b[?62c", rb"\x1b_Ga=T,f=100"),
                               (b"\x1b[?62;4;6c", rb"\x1bP0;1q"),
                               (b"", rb"\x1b\[48;2;")]:  # a terminal that does not answer
            with self.subTest(answers):
                self.preview("preview", ARM, answers=answers).wait_for(shown)
        self.preview("preview", ARM, COLORTERM="").wait_for(rb"\x1b\[48;5;")
        self.preview("preview", ARM, "--graphics", "sixel").wait_for(rb"\x1bP0;1q")

    def test_a_dumb_terminal_is_refused(self):
        screen = self.preview("preview", ARM, TERM="dumb")
        self.assertEqual(screen.end(), 1)
        self.assertIn(b"-o film.gif", screen.seen)

    def rendered(self, frames):
        self.succeed("mars", "render", ARM, "-o", "frames", "--frames", f"0-{frames - 1}", "--size", "96x54",
                     "--backend", "threads", "-q")
        return self.folder / "frames"

    def test_plays_rendered_frames(self):
        screen = self.preview("play", self.rendered(6))
        screen.wait_for(rb"5/5  \d+ frames/s")
        os.write(screen.master, b"q")
        self.assertEqual(screen.end(), 0)


class Written(ProgramTest):
    def test_one_picture(self):
        for shown in ["stick", "vertices", "prisms", "surface", "all"]:
            self.succeed("mars", "preview", HUMAN, "--as", shown, "--frames", "5", "--size", "200x160", "-o", "one.png")
            self.assertTrue(intact(self.folder / "one.png"))
            self.assertEqual(size_of(self.folder / "one.png"), (200, 160))
            colours = {row[i:i + 3] for row in png_rows(self.folder / "one.png") for i in range(0, len(row), 3)}
            self.assertGreater(len(colours), 20, shown)

    def test_the_surface_is_the_renderers(self):
        self.succeed("mars", "preview", ARM, "--as", "surface", "--frames", "7", "--size", "160x90", "-o", "one.png")
        self.succeed("mars", "render", ARM, "--frames", "7", "--size", "160x90", "-o", "out", "--backend", "threads", "-q")
        self.assertEqual(png_rows(self.folder / "one.png"), png_rows(self.folder / "out/frame-0007.png"))

    def test_views_differ(self):
        pictures = set()
        for view in ["camera", "front", "side", "top"]:
            self.succeed("mars", "preview", ARM, "--frames", "0", "--view", view, "--size", "80x60", "-o", "view.png")
            pictures.add((self.folder / "view.png").read_bytes())
        self.assertEqual(len(pictures), 4)

    def test_contact_sheet(self):
        self.succeed("mars", "preview", ARM, "--frames", "0-11", "--every", "2", "--columns", "3", "--size", "64x36", "-o",
                     "sheet.png")
        self.assertEqual(size_of(self.folder / "sheet.png"), (6 + 3 * 70, 6 + 2 * 54))
        self.succeed("mars", "preview", ARM, "--as", "stick", "-o", "twelve.png")
        width, height = size_of(self.folder / "twelve.png")
        self.assertEqual((width - 6) // 326 * ((height - 6) // 198), 12)

    def test_compiled_film(self):
        self.succeed("mars", "compile", ARM, "-o", "film.mars")
        for source in [ARM, "film.mars"]:
            self.succeed("mars", "preview", source, "--frames", "3", "--size", "96x54", "-o", f"{len(str(source))}.png")
        self.assertEqual(len({path.read_bytes() for path in self.folder.glob("*.png")}), 1)
        self.succeed("mars", "preview", "film.mars", "--as", "stick", "-o", "stick.png")

    def test_a_model_alone(self):
        """Also one of other proportions, and one whose material its film will have."""
        self.write("box.json", {"joints": [{"name": "a", "segment": {"shape": "box", "material": "of the film"}}]})
        self.write("tall.json", {"from": "box.json", "proportions": {"scale": [1, 1, 3]}})
        for model in ["box.json", "tall.json"]:
            self.succeed("mars", "preview", model, "--frames", "3", "--size", "96x54", "-o", f"{model}.png")
        self.assertEqual(len({path.read_bytes() for path in self.folder.glob("*.png")}), 2)

    def test_a_model_as_large_as_may_be(self):
        segment = {"shape": "sphere", "sbb": [[-1e9] * 3, [1e9] * 3]}
        self.write("large.json", {"joints": [{"name": "a", "place": [1e9] * 3, "segment": segment}]})
        self.succeed("mars", "preview", "large.json", "--frames", "3", "--size", "96x54", "-o", "large.png")

    def probe(self, file):
        printed = self.run_program("ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                "stream=codec_name,width,height,nb_read_frames,r_frame_rate", "-of", "json", file)
        return json.loads(printed.stdout)["streams"][0]

    @needs_ffmpeg
    def test_videos(self):
        for name, codec in [("film.gif", "gif"), ("film.mp4", None)]:
            self.succeed("mars", "preview", ARM, "--frames", "0-11", "--size", "95x53", "-o", name)
            stream = self.probe(name)
            self.assertEqual(int(stream["nb_read_frames"]), 12)
            self.assertEqual((stream["width"], stream["height"]), (95, 53) if codec else (96, 54))
            if codec:
                self.assertEqual(stream["codec_name"], codec)
            else:
                self.assertEqual(stream["r_frame_rate"], "24/1")

    @needs_ffmpeg
    def test_every_second_picture_takes_twice_its_time(self):
        self.succeed("mars", "preview", ARM, "--frames", "0-11", "--every", "2", "--size", "96x54", "-o", "film.mp4")
        self.assertEqual(self.probe("film.mp4")["r_frame_rate"], "12/1")

    @needs_ffmpeg
    def test_rendered_frames(self):
        self.succeed("mars", "render", ARM, "-o", "out", "--frames", "3-8", "--size", "96x54", "--backend", "threads", "-q")
        self.succeed("mars", "play", "out", "-o", "film.gif")
        self.assertEqual(int(self.probe("film.gif")["nb_read_frames"]), 6)
        self.succeed("mars", "play", "out", "-o", "sheet.png", "--size", "48x27")
        self.succeed("mars", "play", "out", "-o", "one.png", "--frames", "2", "--size", "96x54")
        self.assertEqual(png_rows(self.folder / "one.png"), png_rows(self.folder / "out/frame-0005.png"))


class Refused(ProgramTest):
    def test_where_there_is_no_terminal(self):
        self.fail_clearly(1, "preview", ARM, says="write a file instead: -o sheet.png")
        self.fail_clearly(1, "play", self.folder, says="no folder of frames")

    def test_bad_wishes(self):
        for words, says in [(("--as", "wire"), "wire"), (("--view", "back"), "back"), (("--size", "0x5"), "0x5"),
                            (("-o", "film.avi"), "ends in none of .png, .mp4, .m4v, .mov"), (("--every", "0"), "0"),
                            (("--graphics", "x"), "x"), (("--frames", "a"), "a"), (("--columns", "-1"), "-1")]:
            self.fail_clearly(2, "preview", ARM, *words, says=says)
        for command in ["preview", "play"]:
            for way in [["-o", "a.png"], ["--window"]]:
                self.fail_clearly(2, command, ARM, "--graphics", "blocks", *way, says="--graphics is for pictures in the terminal")

    def test_bad_films(self):
        self.fail_clearly(1, "preview", "none.json", "-o", "a.png", says="none.json")
        self.fail_clearly(1, "preview", self.write("a.json", "[1]"), "-o", "a.png", says="a.json")
        self.fail_clearly(1, "preview", self.write("b.json", {"joints": [{"nam": "a"}]}), "-o", "a.png", says="nam")
        self.fail_clearly(1, "preview", ARM, "--frames", "5000", "-o", "a.png", says="5000")
        self.assertEqual(list(self.folder.glob("*.png*")), [])

    def test_places_that_cannot_be_written(self):
        for name in ["none/a.png", "none/a.gif"]:
            self.fail_clearly(1, "preview", ARM, "--frames", "0-1", "-o", name, says="none/a")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_without_ffmpeg(self):
        (self.folder / "bin").mkdir()
        self.fail_clearly(1, "preview", ARM, "-o", "film.mp4", says="needs the program ffmpeg",
                          env={**ENVIRONMENT, "PATH": str(self.folder / "bin")})
        self.assertEqual(list(self.folder.glob("film*")), [])

    def test_an_ffmpeg_that_fails(self):
        ffmpeg = self.folder / "ffmpeg"
        ffmpeg.write_text("#!/bin/sh\necho no such encoder >&2\nexit 3\n")
        ffmpeg.chmod(0o755)
        (self.folder / "film.mp4").write_text("kept")
        self.fail_clearly(1, "preview", ARM, "-o", "film.mp4", says="no such encoder",
                          env={**ENVIRONMENT, "PATH": f"{self.folder}:/usr/bin:/bin"})
        self.assertEqual((self.folder / "film.mp4").read_text(), "kept")

    def test_a_sheet_that_is_too_large(self):
        self.fail_clearly(1, "preview", ARM, "--frames", "0-", "--columns", "60", "--size", "960x540", "--as", "stick",
                          "-o", "a.png", says="--every")


if __name__ == "__main__":
    main()
