"""Random films are films, hold what a film can hold, and follow from their seed; random edits change them by every kind of
command; mars bench identity finds a way of other pixels.

Started as: identity_test.py BUILD_FOLDER."""
import json
import pathlib
import random
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE.parent.parent), str(HERE)]
import cases  # noqa: E402
import identity  # noqa: E402
import random_edits  # noqa: E402
from random_film import RandomFilm  # noqa: E402

BUILD = pathlib.Path(sys.argv[1])
FILMS = 60
VERBS = {"set", "add", "remove", "rename", "light", "material", "pose", "key", "move", "copy", "cut", "delete", "time", "tangent",
         "reduce", "attach", "detach", "look", "follow"}


class Identity(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.films = identity.Films(BUILD, folder.name)

    def test_a_film_follows_from_its_seed(self):
        self.assertEqual(RandomFilm(5).json, RandomFilm(5).json)
        self.assertNotEqual(RandomFilm(5).json, RandomFilm(6).json)

    def test_films_hold_what_a_film_can_hold(self):
        text = "".join(json.dumps(RandomFilm(seed).json) for seed in range(FILMS))
        for word in ["attach", "ambient", "fog", "cone", "exposure", "spline", "bspline", "mesh", "metallic", "gouraud", "flat",
                     "coded", '"samples": 16', '"samples": 1,', "dice", "reach", "x_axis", '"at": {', '"curve": "none"', '"curve": "agx"',
                     '"intervals": "keyframes"', '"up"', '"out": [', '"shadow": true}', '"shadow": true, "size": ', '"casts": false',
                     '"receives": false']:
            self.assertIn(word, text)
        commands = [command for seed in range(FILMS) for command in RandomFilm(seed).commands]
        self.assertTrue({"walk", "wave", "reduce"} <= {command[2] for command in commands})

    def test_edits_follow_from_choices_and_film(self):
        film = RandomFilm(5).json
        edits = [[random_edits.random_edit(random.Random(seed), film) for seed in range(FILMS)] for _ in "ab"]
        self.assertEqual(edits[0], edits[1])
        self.assertGreater(len({str(edit) for edit in edits[0]}), FILMS // 2)

    def test_edits_are_of_every_verb(self):
        edits = [random_edits.random_edit(random.Random(f"{seed} {i}"), RandomFilm(seed).json)
                 for seed in range(FILMS) for i in range(10)]
        self.assertEqual({edit[2] for edit in edits}, VERBS)

    def test_most_edits_change_the_film_and_refused_ones_do_not(self):
        changed = 0
        for seed in range(4):
            path, choose = self.films.write(seed), random.Random(seed)
            for _ in range(5):
                before = path.read_bytes()
                command = self.films.edit(path, choose)
                changed += bool(command)
                self.assertTrue(command or path.read_bytes() == before)
        self.assertGreater(changed, 12)

    def test_an_edited_film_goes_on_in_the_folder_of_the_film_before(self):
        for seed in (3, 4):
            path = self.films.write(seed)
            commands, continued = self.films.edited(path, random.Random(seed), 3)
            self.assertTrue(commands)
            self.assertEqual(identity.compare(self.films, path, []), (continued, []))

    def test_films_are_alike_in_all_ways_and_others_are_told(self):
        for seed in (3, 11):
            path = self.films.write(seed)
            ways = [identity.random_way(random.Random(seed), False, path) for _ in range(2)]
            pixels, wrong = identity.compare(self.films, path, [*ways, ({"--samples": "16", "--size": "40x40"}, {})])
            self.assertEqual(len(pixels), 32)
            self.assertEqual([" --samples 16 --size 40x40" in command for command in wrong], [True])


if __name__ == "__main__":
    cases.main()
