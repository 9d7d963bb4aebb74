"""`mars preview` follows the files of what it plays."""

import json
import os
import pathlib
import re
import signal
import time

from harness import SECONDS, ProgramTest, main, processor_seconds
from screen import Screen


class FollowsFiles(ProgramTest):
    """What is played follows its files, however they are saved, and goes on while they are broken."""

    def preview(self, path):
        screen = Screen(self.folder, "preview", path)
        self.addCleanup(screen.close)
        screen.wait_for(b"prisms, camera")
        return screen

    def box(self, color, **more):
        return {"materials": {"paint": {"color": color}},
                "joints": [{"name": "a", "segment": {"shape": "box", "material": "paint"}}], **more}

    def film(self, frames, model="box.json"):
        return {"frames": frames, "size": [64, 36], "camera": {"eye": [0, -3, 1], "at": [0, 0, 0.5]},
                "models": {"box": model}, "actors": [{"name": "a", "model": "box"}]}

    def saved(self, screen, name, content, shown):
        """Once what is shown since `content` was saved matches."""
        since = len(screen.seen)
        self.write(name, content)
        return screen.wait_for(shown, since)

    def shows_color(self, screen, high, since):
        """Whether blocks were shown in which the channel `high` of three is much the strongest."""
        blocks = re.findall(rb"[34]8;2;(\d+);(\d+);(\d+)m", screen.seen[since:])
        return any(int(block[high]) > 2 * max(int(value) for i, value in enumerate(block) if i != high) + 60
                   for block in blocks)

    def wait_for_color(self, screen, high, since):
        while not self.shows_color(screen, high, since):
            self.assertTrue(screen.read(SECONDS))

    def test_however_they_are_saved(self):
        """Frame, pause and viewpoint stay, the frame within the new film."""
        self.write("box.json", self.box([1, 1, 1]))
        film = self.write("film.json", self.film(48))
        screen = self.preview("film.json")
        screen.press(b" ", b"paused")
        screen.press(b"\x1b[F", b" 47/47 ")
        screen.press(b"f", b"prisms, front")
        self.saved(screen, "film.json", self.film(96), rb" 47/95  24 frames/s  paused  prisms, front")
        since = len(screen.seen)
        os.replace(self.write("film.tmp", {**self.film(24), "size": [36, 64]}), film)
        screen.wait_for(rb"\x1b\[2J.* 23/23  24 frames/s  paused  prisms, front", since)
        since = len(screen.seen)
        film.unlink()
        screen.wait_for(b"film.json: there is no such file", since)
        self.saved(screen, "film.json", self.film(36), rb" 23/35 ")
        for frames in range(40, 60):
            self.write("film.json", self.film(frames) if frames % 2 else "{")
            time.sleep(0.01)
        screen.wait_for(rb" 23/58 ")

    def test_goes_on_while_they_are_broken(self):
        self.write("box.json", self.box([1, 1, 1]))
        self.write("film.json", self.film(1000))
        screen = self.preview("film.json")
        broken = json.dumps(self.film(100), indent=1).replace('"size"', '"siez"')
        self.saved(screen, "film.json", broken, rb"\x1b\[23;1H[^\n]*film\.json:3: siez")
        first = int(screen.wait_for(rb" (\d+)/999 ", len(screen.seen)).group(1))
        screen.wait_for(rb" %d/999 " % (first + 5))
        screen.press(b"f", b"prisms, front")
        since = len(screen.seen)
        last = int(self.saved(screen, "film.json", self.film(900), rb" (\d+)/899 ").group(1))
        self.assertGreater(last, first)
        screen.wait_for(rb"\x1b\[23;1H\x1b\[0m\x1b\[0m\x1b\[K", since)

    def test_ends_while_they_are_broken(self):
        for keys, number, code in [(b"q", None, 0), (b"", signal.SIGTERM, -signal.SIGTERM)]:
            self.write("box.json", self.box([1, 1, 1]))
            screen = self.preview("box.json")
            self.saved(screen, "box.json", "[", b"box.json:1")
            os.write(screen.master, keys)
            if number:
                screen.process.send_signal(number)
            self.assertEqual(screen.end(), code)
            self.assertTrue(screen.given_back())

    def test_the_models_of_a_film(self):
        """Also those that a model is derived from, and those that are named later or are not there."""
        self.write("paint.json", self.box([1, 0, 0]))
        self.write("box.json", {"from": "paint.json", "proportions": {"scale": [1, 1, 1.2]}})
        self.write("film.json", self.film(10))
        screen = self.preview("film.json")
        self.wait_for_color(screen, 0, 0)
        since = len(screen.seen)
        self.write("paint.json", self.box([0, 1, 0]))
        self.wait_for_color(screen, 1, since)
        self.saved(screen, "film.json", self.film(11, "other.json"),
                   b"film.json:1: models.box: is 'other.json', which does not")
        since = len(screen.seen)
        self.saved(screen, "other.json", self.box([0, 0, 1]), rb" \d+/10 ")
        self.wait_for_color(screen, 2, since)
        since = len(screen.seen)
        self.write("other.json", self.box([1, 0, 0]))
        self.wait_for_color(screen, 0, since)

    def test_keys_work_while_a_long_film_is_loaded(self):
        """On one processor, which the loading keeps busy; and the end does not wait for the rest of it."""
        processors = os.sched_getaffinity(0)
        os.sched_setaffinity(0, [min(processors)])
        self.addCleanup(os.sched_setaffinity, 0, processors)
        self.write("tenth.json", self.crowd(501))
        before = processor_seconds()
        self.succeed("mars", "preview", "tenth.json", "--frames", "0", "--as", "stick", "-o", "tenth.png")
        whole = 10 * (processor_seconds() - before)
        self.write("box.json", self.box([1, 1, 1]))
        self.write("film.json", self.film(10))
        before = processor_seconds()
        screen = self.preview("film.json")
        self.saved(screen, "film.json", self.crowd(5001), rb" \d/9  24 frames/s  prisms, camera  loading ...")
        screen.press(b"f", rb" \d/9  24 frames/s  prisms, front  loading ...")
        os.write(screen.master, b"q")
        until_then = self.processor_seconds_of(screen.process.pid)
        self.assertEqual(screen.end(), 0)
        self.assertTrue(screen.given_back())
        self.assertLess(processor_seconds() - before - until_then, whole / 4)

    def crowd(self, frames):
        """A film that is compiled for long."""
        joints = [{"name": f"j{n}", **({"parent": f"j{n - 1}"} if n else {}), "segment": {"shape": "box"}}
                  for n in range(100)]
        turns = [{"frame": frame, "pose": {f"j{n}": [turn] * 3 for n in range(100)}}
                 for frame, turn in [(0, 0), (frames - 1, 90)]]
        actors = [{"name": f"a{n}", "model": "box", "keys": turns} for n in range(40)]
        return {**self.film(frames, {"joints": joints}), "actors": actors}

    @staticmethod
    def processor_seconds_of(process):
        stat = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        return (int(stat[11]) + int(stat[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    main()
