"""What is concluded from the notes and times of a rendering that was disturbed."""
import pathlib
import sys
import tempfile
import types
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import film  # noqa: E402
import table  # noqa: E402
from scene import Notes, Scene  # noqa: E402


class Measures(unittest.TestCase):
    def scene(self, notes, stored, since):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        scene = Scene(None, types.SimpleNamespace(place=pathlib.Path(folder.name)), None, None, None, 0)
        scene.notes, scene.since = Notes(pathlib.Path(folder.name)), since
        scene.notes.file.write_text("".join(f"{line}\n" for line in notes))
        scene.watch = types.SimpleNamespace(times=lambda: stored)
        return scene

    def test_a_new_job(self):
        """The keyframe 0 is drawn by two nodes of a job, and not twice; frame 2 is, by two jobs."""
        scene = self.scene(["1.0 a 11 0", "1.1 a 12 0", "2.0 a 11 1", "3.0 a 12 2", "9.5 b 21 2", "9.6 b 22 3"],
                           [1.5, 2.5, 9.9, 10.0], since=4.0)
        self.assertEqual(scene.drawing_again(), 5.5)
        self.assertEqual(scene.drawn_twice(), 1)

    def test_the_same_job_goes_on(self):
        notes = ["1.0 a 11 0", "2.0 a 11 1"]
        self.assertEqual(self.scene(notes, [1.0, 2.0, 4.5, 30.0, 30.5], since=4.0).drawing_again(), 26.0)
        self.assertIsNone(self.scene(notes, [1.0, 2.0, 4.5, 5.0, 5.5], since=4.0).drawing_again())

    def test_a_frame_is_the_same_in_a_longer_film(self):
        short, long = (film.film_of(frames, [480, 270], 8) for frames in (5 * film.INTERVAL, 20 * film.INTERVAL))
        for before, after in zip(short["actors"], long["actors"]):
            self.assertEqual(before["keys"], after["keys"][:len(before["keys"])])
            self.assertGreater(len(after["keys"]), len(before["keys"]))

    def test_the_table(self):
        result = {"title": "a node dies", "how": "`kill`", "reported": 2.25, "again": None, "goes_on": False, "lost": 0,
                  "twice": 3}
        self.assertEqual(table.markdown([result]).splitlines()[2], "| a node dies | `kill` | 2.2 s | - | 0 | 3 |")


if __name__ == "__main__":
    unittest.main()
