"""Windows: `mars render --window` and `mars preview --window`, on a display without a screen. A window shows the frames'
own pixels, sends the display only what changed, and whatever becomes of it, the rendering goes on."""

import re
import shutil
import signal
import socket
import struct
import subprocess
import unittest

from display import Display, Relay, wait_for_picture
from harness import (ENVIRONMENT, EXAMPLES, PROGRAMS, PROMPT, SECONDS, ProgramTest, complaints, living, family, main,
                     needs, spinning_teapot, wait_until)
from png_reader import png_rows
from watcher import BEGIN, HEAD, PICTURE, PICTURE_HEAD

SMALL = [EXAMPLES / "robot-arm.json", "--size", "96x54", "--frames", "0-9", "--backend", "threads"]
ONE_NODE = ["--backend", "threads", "--nodes", "1"]  # which renders while a test looks on
NO_DISPLAY = {name: value for name, value in ENVIRONMENT.items() if name not in ["DISPLAY", "WAYLAND_DISPLAY"]}


def on(display):
    return {**NO_DISPLAY, "DISPLAY": display.name, "SDL_VIDEODRIVER": "x11"}


def start_window(display):
    """mars-window as mars starts it: its control, the socket to which hosts connect, and its process."""
    control, theirs = socket.socketpair()
    listener = socket.socket(socket.AF_UNIX)
    listener.bind("")
    listener.listen(1)
    process = subprocess.Popen(
        ["bash", "-c", 'exec "$0" rendering film 3<&"$1"', PROGRAMS / "mars-window", str(listener.fileno())],
        env=on(display), stdin=theirs, pass_fds=[listener.fileno()])
    theirs.close()
    assert control.recv(1) == b"r"
    return control, listener, process


class Host:
    """Sends pictures to a window of its own, as the host of a rendering does."""

    def __init__(self, display):
        self.control, listener, self.process = start_window(display)
        self.stream = socket.socket(socket.AF_UNIX)
        self.stream.connect(listener.getsockname())
        listener.close()

    def end(self):
        self.control.close()
        self.stream.close()
        assert self.process.wait(SECONDS) == 0

    def send(self, kind, body):
        self.stream.sendall(HEAD.pack(kind, 0, 0, 0, len(body)) + body)

    def begin(self, width, height):
        self.width, self.height = width, height
        self.send(BEGIN, struct.pack("<6I", width, height, 16, 1, 10, 0))

    def show(self, color, *rects):
        """Rectangles x, y, width, height of that color; none: the whole picture."""
        rects = rects or [(0, 0, self.width, self.height)]
        head = PICTURE_HEAD.pack(self.width, self.height, len(rects), self.height, 0, 0, 0, 1, 0, 0, 0.0)
        pixels = b"".join(bytes([*color, 1]) * (width * height) for _, _, width, height in rects)
        self.send(PICTURE, head + b"".join(struct.pack("<4H", *rect) for rect in rects) +
                  struct.pack("<iI", 0, 0) * self.height + pixels)


@needs("Xvfb")
@unittest.skipUnless((PROGRAMS / "mars-window").exists(), "built without SDL")
class Windows(ProgramTest):
    def setUp(self):
        super().setUp()
        self.display = Display(self.folder)
        self.addCleanup(self.display.end)

    def start(self, *words, **more):
        process = subprocess.Popen([PROGRAMS / "mars", *map(str, words)], env=on(self.display), cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)
        self.addCleanup(lambda: (process.kill(), process.communicate()))
        return process

    def host(self, display, width, height):
        host = Host(display)
        self.addCleanup(host.end)
        host.begin(width, height)
        return host

    def picture(self, name):
        return png_rows(self.folder / name)

    def title(self):
        return "".join(self.display.windows().values())

    def window_opens(self):
        wait_until(self.display.windows, SECONDS, "no window opens")

    def test_stays_with_the_last_frame(self):
        self.succeed("mars", "render", *SMALL, "-o", "out", "--window", env=on(self.display))
        title = r"robot-arm.json  -  frame (\d)  -  10 of 10  -  ended"
        wait_until(lambda: re.fullmatch(title, self.title()), SECONDS, self.title)
        number = re.fullmatch(title, self.title())[1]
        wait_for_picture(self.display, self.picture(f"out/frame-000{number}.png"))
        self.display.press("q")
        wait_until(lambda: not self.display.windows(), SECONDS, "q does not close the window")

    def test_a_window_that_ends_does_not_end_the_rendering(self):
        self.write("film.json", spinning_teapot(20, [480, 270]))
        process = self.start("render", "film.json", "-o", "out", *ONE_NODE, "--window")
        self.window_opens()
        self.display.press("Escape")
        wait_until(lambda: not self.display.windows(), SECONDS, "Esc does not close the window")
        self.assertIsNone(process.poll())
        self.assertEqual((complaints(process.communicate(timeout=SECONDS)[1]), process.returncode), ("", 0))

    def test_a_display_that_ends_does_not_end_the_rendering(self):
        """Nor one that stands still, of which a program may wait for an answer forever."""
        self.write("film.json", spinning_teapot(20, [240, 135]))
        for ending in [signal.SIGKILL, signal.SIGSTOP]:
            with self.subTest(ending.name):
                process = self.start("render", "film.json", "-o", "out", "--overwrite", *ONE_NODE, "--window")
                self.window_opens()
                self.display.server.send_signal(ending)
                self.assertIsNone(process.poll(), "the rendering ended before the display")
                self.assertEqual((complaints(process.communicate(timeout=SECONDS)[1]), process.returncode), ("", 0))
                self.display.end()
                self.display = Display(self.folder)
                self.addCleanup(self.display.end)

    def assertEnded(self, process, ending):
        everyone = family(process.pid)
        self.assertTrue(everyone)
        process.send_signal(ending)
        process.wait(PROMPT)
        wait_until(lambda: not living(everyone), PROMPT, lambda: f"left: {living(everyone)}")

    def test_a_signal_ends_rendering_and_window(self):
        self.write("film.json", spinning_teapot(3000, [480, 270]))
        process = self.start("render", "film.json", "--sink", "none", *ONE_NODE, "--window")
        self.window_opens()
        self.assertEnded(process, signal.SIGTERM)

    def test_a_window_to_which_no_host_came_ends(self):
        """As where nothing is left to render: nothing of it could be seen, or closed."""
        control, listener, process = start_window(self.display)
        self.addCleanup(listener.close)
        control.send(b"l")
        control.close()
        self.assertEqual(process.wait(SECONDS), 0)

    def test_a_display_that_does_not_answer_keeps_nothing(self):
        self.display.server.send_signal(signal.SIGSTOP)
        for words in [["render", *SMALL, "--sink", "none"], ["preview", SMALL[0]]]:
            process = self.start(*words, "--window")
            # Before the window mars starts programs that end at once.
            is_started = lambda: any(program.endswith("/mars-window") for *_, program in family(process.pid).values())
            wait_until(is_started, SECONDS, "no window is started")
            self.assertEnded(process, signal.SIGKILL)

    def test_without_a_display_nothing_begins(self):
        for words in [["render", *SMALL, "-o", "out", "--window"], ["preview", SMALL[0], "--window"]]:
            for environment, says in [(NO_DISPLAY, "neither DISPLAY nor WAYLAND_DISPLAY"),
                                      ({**NO_DISPLAY, "DISPLAY": ":99999"}, "no window can be opened")]:
                self.fail_clearly(1, *words, says=says, env=environment)
        self.assertFalse((self.folder / "out").exists())

    def test_a_mars_without_windows_says_so(self):
        shutil.copy(PROGRAMS / "mars", self.folder)
        done = self.run_program(self.folder / "mars", "preview", SMALL[0], "--window", env=on(self.display))
        self.assertClear(done.stderr, "mars-window is not there")
        self.assertEqual(done.returncode, 1)

    def test_only_what_changed_goes_to_the_display(self):
        display = Display(self.folder, "-extension", "MIT-SHM")  # as one at the other end of a network
        self.addCleanup(display.end)
        relay = Relay(display)
        self.addCleanup(relay.end)
        host = self.host(relay, 320, 180)
        host.show((200, 30, 40))
        wait_for_picture(display, [bytes([200, 30, 40]) * 320] * 180)
        before = relay.settled()
        self.assertGreater(before, 4 * 320 * 180)
        host.show((20, 230, 40), (32, 16, 16, 16), (160, 96, 16, 16))
        wait_for_picture(display, [bytes([20, 230, 40]) * 16] * 16)
        bytes_sent = relay.settled() - before
        self.assertGreaterEqual(bytes_sent, 2 * 4 * 16 * 16)
        self.assertLess(bytes_sent, 2 * 4 * 16 * 16 + 1024)

    def test_keys_change_how_it_is_shown(self):
        """A picture larger than the screen is reduced to it; 1 shows its pixels, f outlines what came."""
        host = self.host(self.display, 1280, 800)
        host.show((200, 30, 40))
        wait_until(lambda: bytes([200, 30, 40]) * 300 in self.display.rows()[200], SECONDS, "nothing is shown")
        host.show((10, 20, 250), (608, 384, 64, 32))
        wait_for_picture(self.display, [bytes([10, 20, 250]) * 28] * 14)
        self.display.press("1")
        wait_for_picture(self.display, [bytes([10, 20, 250]) * 64] * 32)
        self.display.press("f")
        host.show((10, 120, 250), (608, 384, 64, 32))
        yellow = bytes([0xff, 0xd7, 0])
        wait_for_picture(self.display, [yellow * 64, *[yellow + bytes([10, 120, 250]) * 62 + yellow] * 30, yellow * 64])

    def test_previews_with_the_players_keys(self):
        process = self.start("preview", SMALL[0], "--as", "stick", "--window")
        self.window_opens()
        self.display.press(",")
        wait_until(lambda: "paused" in self.title(), SECONDS, self.title)
        self.display.press("Home")
        wait_until(lambda: ":   0/" in self.title(), SECONDS, self.title)
        self.display.press("2")
        wait_until(lambda: "vertices" in self.title(), SECONDS, self.title)
        self.display.press("q")
        self.assertEqual((process.wait(SECONDS), process.stderr.read()), (0, ""))

    def test_preview_shows_what_is_drawn(self):
        for name in ["stick", "surface"]:
            self.succeed("mars", "preview", SMALL[0], "--frames", "0", "--as", name, "-o", f"{name}.png")
        process = self.start("preview", SMALL[0], "--as", "stick", "--window")
        self.window_opens()
        self.display.press(",")
        self.display.press("Home")
        wait_for_picture(self.display, self.picture("stick.png"))
        self.display.press("4")
        wait_for_picture(self.display, self.picture("surface.png"))
        process.terminate()
        wait_until(lambda: not self.display.windows(), SECONDS, "the window stays without its player")


if __name__ == "__main__":
    main()
