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


class AtOnce(random.Random):
    def uniform(self, *_):
        return 0


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
                     '"receives": false', '"panorama"', '"orthographic"', '"shift"', '"interaxial"', '"pixel_aspect"']:
            self.assertIn(word, text)
        commands = [command for seed in range(FILMS) for command in RandomFilm(seed).commands]
        self.assertTrue({"walk", "wave", "reduce"} <= {command[2] for command in commands})

    def test_edits_follow_from_choices_and_film(self):
        film = RandomFilm(5).json
        edits = [[random_edits.random_edit(random.Random(seed), film) for seed in range(FILMS)] for _ in "ab"]
        self.assertEqual(edits[0], edits[1])
        self.assertGreater(len({str(edit) for edit in edits[0]}), FILMS // 2)

    def test_edits_keep_panoramas_twice_as_wide_as_high(self):
        film = next(film for film in (RandomFilm(seed).json for seed in range(FILMS))
                    if film["camera"].get("projection") == "panorama")
        edits = [random_edits.random_edit(random.Random(seed), film) for seed in range(40 * FILMS)]
        sizes = [word[5:].split(",") for edit in edits for word in edit if edit[2] == "set" and word.startswith("size=")]
        self.assertTrue(sizes)
        for width, height in sizes:
            self.assertEqual(int(width), 2 * int(height))

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

    def write_json(self, seed):
        path = self.films.folder / f"film-{seed}.json"
        path.write_text(json.dumps(RandomFilm(seed).json))
        return path

    def test_output_is_of_every_kind_and_lies_within_the_picture(self):
        words = []
        for seed in range(FILMS):
            path = self.write_json(seed)
            self.assertEqual(identity.output(path), identity.output(path))
            words += identity.output(path)
        self.assertTrue({"--layers", "all", "--crop", "--margin", "--eye", "--faces"} <= set(words))

    def test_a_part_is_compared_with_the_whole_picture(self):
        path = self.write_json(15)
        self.assertIn("--crop", identity.output(path))
        self.assertEqual(self.films.crops_differ(path), [])
        parts, wholes = ([identity.Exr(file) for file in self.films.files(name)] for name in ("part", "whole"))
        self.assertTrue(all(map(identity.is_part, parts, wholes)))
        wholes[0].channels["G"][3][16] += 1
        self.assertFalse(identity.is_part(parts[0], wholes[0]))

    def test_files_that_differ_are_told_where_pixels_do_not(self):
        path = self.write_json(7)
        before = self.films.content(path, identity.PLAIN, {})
        path.write_text(path.read_text().replace('"rate": 24', '"rate": 30'))
        now = self.films.content(path, identity.PLAIN, {})
        self.assertEqual(before[0], now[0])
        self.assertNotEqual(before[1], now[1])

    def test_watchers_are_among_the_ways(self):
        path = self.write_json(7)
        ways = [identity.random_way(random.Random(seed), False, path)[0] for seed in range(FILMS)]
        watched = [way for way in ways if "--watch" in way]
        self.assertGreater(len(watched), FILMS // 10)
        self.assertTrue(all(int(way["--nodes"]) > 1 and "--write" not in way for way in watched))

    def test_a_watcher_has_the_last_frames_pixels(self):
        way = {"--backend": "threads", "--nodes": "2", "--watch": str(self.films.folder / "watcher")}
        for seed, as_it_is in ((7, True), (15, False), (21, True)):
            path = self.write_json(seed)
            self.assertEqual(identity.is_shown_as_it_is(path), as_it_is)
            self.assertEqual(identity.compare(self.films, path, [(way, {})])[1], [])

    def test_a_way_that_fails_is_told(self):
        path = self.write_json(7)
        _, (wrong,) = identity.compare(self.films, path, [({"--nodes": "0"}, {})])
        self.assertIn(" --nodes 0: ", wrong)

    def test_films_are_alike_in_all_ways_and_others_are_told(self):
        for seed in (3, 6):
            path = self.films.write(seed)
            ways = [identity.random_way(random.Random(seed), False, path) for _ in range(2)]
            pixels, wrong = identity.compare(self.films, path, [*ways, ({"--samples": "16", "--size": "40x20"}, {})])
            self.assertEqual(len(pixels), 32)
            self.assertEqual([" --samples 16 --size 40x20" in command for command in wrong], [True])

    def test_killed_renderings_are_finished_and_other_pixels_are_told(self):
        path = self.films.write(6)
        pixels = self.films.content(path, identity.PLAIN, {})[0]
        killed = identity.Killed(self.films, path, AtOnce(2), ["threads"])
        self.assertFalse(killed.frames_differ(pixels))
        self.assertTrue(killed.frames_differ("other"))
        self.assertFalse(killed.videos_differ())
        self.assertGreater(killed.kills, 0)


if __name__ == "__main__":
    cases.main()
