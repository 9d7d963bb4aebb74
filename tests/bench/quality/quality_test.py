"""`mars bench quality`: what it does with pictures, and on small ones that more samples come nearer to the reference and
that edges crawl less.

Started as: quality_test.py BUILD_FOLDER."""
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [os.path.join(HERE, "..", ".."), HERE]
import cases  # noqa: E402
import quality  # noqa: E402

BUILD = sys.argv[1]
SMALL = [192, 108]


class Pictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def file(self, name):
        return os.path.join(self.folder, name)

    def picture(self, name, width, height, levels):
        with open(self.file(name), "wb") as file:
            file.write(b"P6\n%d %d\n255\n" % (width, height) + bytes(level for level in levels for _ in range(3)))
        return self.file(name)

    def do(self, *words):
        return quality.run([os.path.join(BUILD, "bench", "quality", "bench-pictures"), *words])

    def test_distance_is_the_root_of_the_mean_square(self):
        one, other = self.picture("a.ppm", 2, 1, [10, 20]), self.picture("b.ppm", 2, 1, [10, 26])
        self.assertAlmostEqual(float(self.do("rms", one, other)), 18 ** 0.5, places=4)

    def test_half_black_half_white_is_188_as_light_and_128_as_levels(self):
        board = self.picture("board.ppm", 4, 2, [0, 255, 255, 0] * 2)
        for color, level in ("linear", 188), ("coded", 128):
            self.do("shrink", "2", color, board, self.file("small.png"))
            grey = self.picture("grey.ppm", 2, 1, [level] * 2)
            self.assertEqual(float(self.do("rms", self.file("small.png"), grey)), 0)

    def test_light_is_decoded(self):
        half, black = self.picture("half.ppm", 1, 1, [188]), self.picture("black.ppm", 1, 1, [0])
        half_light, no_light = map(float, self.do("light", half, black).split())
        self.assertAlmostEqual(half_light, 0.5, places=2)
        self.assertEqual(no_light, 0)

    def test_more_samples_come_nearer(self):
        film = quality.Film(BUILD, "s1", SMALL, self.folder)
        distances = quality.measure(film, [1, 4, 16])["MARS"]
        self.assertLess(distances[4][0], distances[1][0] / 2)
        self.assertLess(distances[16][0], distances[4][0] * 0.7)

    def test_penumbras_are_less_grainy_with_more_samples(self):
        path = quality.films.save(quality.penumbra_film(32), self.file("penumbra.json"))
        film = quality.Film(BUILD, "penumbra", SMALL, self.folder, path)
        references = film.references([0])
        grain = {s: film.rms(film.render(s, [0]), references)[0] for s in (1, 4)}
        self.assertLess(grain[4], grain[1] * 0.8)
        self.assertLess(grain[4], 4)

    def test_edges_crawl_less_with_more_samples(self):
        film = quality.Film(BUILD, "fan", [480, 270], self.folder)
        one, sixteen = (quality.variation(film.lights(samples)) for samples in (1, 16))
        self.assertLess(sixteen, 0.01)
        self.assertLess(sixteen, one / 3)

    def test_a_picture_too_far_from_its_reference_ends_it(self):
        with self.assertRaisesRegex(quality.Trouble, "demo with 16 samples differs from its reference by 1.60 of 255"):
            quality.check({"film": "demo", "MARS": {1: [4, 5], 16: [1.2, 1.6]}})
        quality.check({"film": "demo", "MARS": {1: [4, 5], 16: [1.2, 1.4]}})

    def test_the_command_knows_it(self):
        words = subprocess.run([os.path.join(BUILD, "bin", "mars"), "bench", "quality", "--help"], capture_output=True,
                               text=True)
        self.assertIn("--films", words.stdout)


if __name__ == "__main__":
    cases.main()
