"""Keys of `mars preview` that pose a figure and set keys of its film."""

import json
import os
import re

from harness import ProgramTest, main
from screen import Screen

LAMP = {"frames": 48, "size": [64, 36], "camera": {"eye": [3, -7, 3], "at": [0, 0, 1]},
        "models": {"lamp": {"joints": [
            {"name": "stem", "limits": {"x": [-40, 40], "y": [-60, 60]}, "segment": {"shape": "box"}},
            {"name": "arm", "parent": "stem", "place": [0, 0, 1], "limits": {"y": [0, 12]},
             "segment": {"shape": "box"}}]}},
        "actors": [{"name": "lamp", "model": "lamp", "keys": [{"frame": 0, "turn": [0, 0, 0]},
                                                              {"frame": 47, "turn": [0, 0, 90]}]}]}
HINT = rb"  Enter set key  Esc give up"


class Posing(ProgramTest):
    def preview(self, *words):
        screen = Screen(self.folder, *words)
        self.addCleanup(screen.close)
        screen.wait_for(b"frames/s")
        return screen

    def test_a_pose_becomes_a_key_as_by_the_command(self):
        film = self.write("film.json", LAMP)
        before = film.read_bytes()
        self.write("other.json", LAMP)
        screen = self.preview("preview", "film.json", "--as", "stick")
        screen.press(b"\t", rb" lamp stem  x 0 \(-40..40\)  y 0 \(-60..60\)")
        screen.press(b"x", rb" lamp stem  x 5 .*" + HINT + rb".*paused  stick")
        screen.press(b"\x1b[H", rb" 0/47 ")
        screen.press(b" ", rb" 0/47  24 frames/s  paused")  # it stands still
        screen.press(b"...", rb" 3/47 ")
        screen.press(b"dX", rb" lamp stem  x 4 ")
        screen.press(b"\t", rb" lamp arm  y 0 \(0..12\)" + HINT)
        screen.press(b"d" + 4 * b"y", rb" lamp arm  y 12 \(0..12\)  y stops at its limit")
        self.assertEqual(film.read_bytes(), before)
        screen.press(b"\r", rb" key set at frame 3")
        self.succeed("mars", "animate", "other.json", "pose", "lamp", "stem.x=4", "arm.y=12", "--frame", "3")
        self.assertEqual(film.read_bytes(), (self.folder / "other.json").read_bytes())
        screen.press(b".", rb" 4/47 ")  # the selection stays
        screen.press(b"\x1b[Z", rb" lamp stem  x 4 \(-40..40\)  y 0 \(-60..60\)\x1b")
        since = len(screen.seen)
        screen.press(b"u", rb"the last key is undone")
        self.assertEqual(film.read_bytes(), before)
        screen.wait_for(rb" lamp stem  x 0 ", since)
        os.write(screen.master, b"q")
        self.assertEqual(screen.end(), 0)
        self.assertTrue(screen.given_back())

    def test_escape_gives_up(self):
        film = self.write("film.json", LAMP)
        before = film.read_bytes()
        screen = self.preview("preview", "film.json")
        screen.press(b"\tyy", rb" lamp stem  x 0 \(-40..40\)  y 10 ")
        screen.press(b"\x1b", rb" lamp stem  x 0 \(-40..40\)  y 0 \(-60..60\)  the pose is given up")
        screen.press(b"\x1b", rb"\x1b\[23;1H\x1b\[0m\x1b\[0m\x1b\[K")
        screen.press(b"h", rb"Tab next joint.*Esc give up the pose")
        self.assertEqual(film.read_bytes(), before)

    def test_the_surface_is_rendered_in_the_pose(self):
        """As the film is rendered that then has the key."""
        self.write("film.json", LAMP)
        screen = self.preview("preview", "film.json", "--as", "surface", "--graphics", "kitty")
        screen.press(b" ", b"paused")
        screen.press(b"\x1b[F", rb" 47/47 .*surface, camera  h help")
        screen.press(b"\txxxxxx", rb"x 30 .*rendering .*surface, camera  h help")
        posed = self.last_picture(screen)
        since = len(screen.seen)
        screen.press(b"\r", rb"key set at frame 47")
        screen.wait_for(rb"rendering .*surface, camera  h help", since)
        self.assertEqual(self.last_picture(screen), posed)
        screen.press(b"u", rb"rendering .*surface, camera  h help")
        self.assertNotEqual(self.last_picture(screen), posed)

    def last_picture(self, screen):
        shown = screen.seen[screen.seen.rindex(b"a=T"):]
        return b"".join(re.findall(rb"\x1b_G[^;\x1b]*;([A-Za-z0-9+/=]*)\x1b", b"\x1b_G" + shown))

    def test_where_there_are_no_keys(self):
        film = self.write("film.json", LAMP)
        self.succeed("mars", "compile", film, "-o", "film.mars")
        compiled = (self.folder / "film.mars").read_bytes()
        for key in [b"\t", b"x", b"\r", b"u", b"\x1b[Z"]:
            self.preview("preview", "film.mars").press(key, rb"a .mars film has no joints to pose")
        self.assertEqual((self.folder / "film.mars").read_bytes(), compiled)
        model = self.write("lamp.json", LAMP["models"]["lamp"])
        before = model.read_bytes()
        screen = self.preview("preview", "lamp.json")
        screen.press(b"\tx", rb"model stem  x 5 .*only shown")
        screen.press(b"\r", rb"a model has no keys: its poses")
        self.assertEqual(model.read_bytes(), before)
        self.succeed("mars", "render", film, "-o", "out", "--frames", "0-2", "--backend", "threads", "-q")
        self.preview("play", "out").press(b"\t", rb"rendered frames have no joints to pose")

    def test_a_file_that_cannot_be_written(self):
        film = self.write("film.json", LAMP)
        screen = self.preview("preview", "film.json")
        screen.press(b"\tx", HINT)
        film.write_text(json.dumps({**LAMP, "actors": []}))
        screen.press(b"\r", rb"no key is set: .*lamp")
        self.assertEqual(json.loads(film.read_text())["actors"], [])


if __name__ == "__main__":
    main()
