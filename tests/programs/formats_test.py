"""Frames as PNG of 8 or 16 bits and as EXR: the files that --format writes, and what reads them."""

import json
import struct
import zlib

from harness import ProgramTest, intact, main, spinning_teapot
from png_reader import png_rows

WIDTH, HEIGHT = 64, 36
PIXELS = {"png": "8-bit sRGB", "png16": "16-bit sRGB", "exr": "half-float linear RGB"}


def png_channels(path, depth):
    """Rows of channels of a PNG file."""
    return [struct.unpack(f">{3 * WIDTH}{'B' if depth == 8 else 'H'}", row) for row in png_rows(path, depth)]


def exr_rows(path):
    """Rows of channels, red, green and blue in turn, of a ZIP-compressed EXR file of half floats."""
    data, at = path.read_bytes(), 8
    while data[at] != 0:
        for _ in range(2):  # an attribute's name, and its type
            at = data.index(0, at) + 1
        at += 4 + struct.unpack_from("<i", data, at)[0]
    rows = []
    for offset in struct.unpack_from(f"<{-(-HEIGHT // 16)}Q", data, at + 1):
        top, size = struct.unpack_from("<ii", data, offset)
        lines = min(16, HEIGHT - top)
        block = data[offset + 8:offset + 8 + size]
        if size < lines * 6 * WIDTH:
            block = unzipped(block)
        for line in range(lines):
            blue, green, red = (struct.unpack_from(f"<{WIDTH}e", block, (3 * line + c) * 2 * WIDTH) for c in range(3))
            rows.append([value for pixel in zip(red, green, blue) for value in pixel])
    return rows


def unzipped(block):
    """Each byte was the difference to the one before, even ones before odd ones."""
    data = bytearray(zlib.decompress(block))
    for i in range(1, len(data)):
        data[i] = (data[i - 1] + data[i] - 128) & 255
    half = (len(data) + 1) // 2
    data[::2], data[1::2] = data[:half], data[half:]
    return bytes(data)


def pixels_of(rows):
    return [row[i:i + 3] for row in rows for i in range(0, 3 * WIDTH, 3)]


def filmic(light):
    """The curve of a pixel (node/color/encoding.h)."""
    brightest, shoulder, bleach = max(light), 0.76, 0.15
    if brightest <= shoulder:
        return light
    shown = 1 - (1 - shoulder) ** 2 / (brightest + 1 - 2 * shoulder)
    kept = 1 / (bleach * (brightest - shown) + 1)
    return [(value * shown / brightest - shown) * kept + shown for value in light]


def srgb(light):
    light = min(light, 1)
    return 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055


class Formats(ProgramTest):
    def setUp(self):
        super().setUp()
        self.film = self.write("film.json", spinning_teapot(4, [WIDTH, HEIGHT]))

    def render(self, name, shape, *more):
        self.succeed("mars", "render", self.film, "-o", name, "--format", shape, "--quiet", *more)
        return self.folder / name

    def pictures(self, shown, backend="threads"):
        """Frame 2 in each format. `shown`: of a pixel's light as EXR has it, what is shown, before sRGB."""
        png, png16, exr = (self.render(f"{shape}-{backend}", shape, "--backend", backend, "--nodes", 2)
                           for shape in PIXELS)
        self.assertEqual(sorted(path.name for path in exr.iterdir()),
                         ["film.mars", *(f"frame-000{i}.exr" for i in range(4)), "frames.json"])
        narrow, wide = (pixels_of(rows) for rows in (png_channels(png / "frame-0002.png", 8),
                                                     png_channels(png16 / "frame-0002.png", 16)))
        light = pixels_of(exr_rows(exr / "frame-0002.exr"))
        for levels, levels16, values in zip(narrow, wide, light):
            for level, level16, value in zip(levels, levels16, shown(values)):
                self.assertLessEqual(abs(level16 / 257 - level), 0.65)
                # A half float is right to 1/2048 of itself.
                self.assertLessEqual(abs(level16 - 65535 * value), 2 + level16 / 2000)
        self.assertGreater(len({level for levels in narrow for level in levels}), 20)
        return wide, light

    def test_files_hold_the_same_picture(self):
        film = spinning_teapot(4, [WIDTH, HEIGHT])
        film["camera"]["exposure"] = 1.5
        self.film = self.write("film.json", film)
        shown = lambda light: [srgb(value) for value in filmic([value * 2 ** 1.5 for value in light])]
        for backend in self.backends():
            with self.subTest(backend=backend):
                wide, light = self.pictures(shown, backend)
                self.assertGreater(max(max(values) for values in light), 1)
                self.assertLess(max(max(levels) for levels in wide), 65535)
        self.assertEqual(len({self.verified_hash(self.folder / f"exr-{backend}") for backend in self.backends()}), 1)

    def test_light_without_a_curve_is_cut(self):
        self.film = self.write("film.json", {**spinning_teapot(4, [WIDTH, HEIGHT]), "curve": "none", "samples": 1})
        wide, light = self.pictures(lambda light: [srgb(value) for value in light])
        self.assertGreater(max(max(values) for values in light), 1)
        self.assertEqual(max(max(levels) for levels in wide), 65535)

    def test_numbers_of_coded_films_are_stored_as_they_are(self):
        self.film = self.write("film.json", {**spinning_teapot(4, [WIDTH, HEIGHT]), "color": "coded"})
        light = self.pictures(lambda light: light)[1]
        self.assertLessEqual(max(max(values) for values in light), 1)

    def test_every_format_is_verified_and_the_same_for_all_nodes(self):
        for shape, pixels in PIXELS.items():
            hashes = set()
            for number, options in enumerate([["--nodes", 1], ["--nodes", 3, "--no-coherence"],
                                              ["--nodes", 3, "--groups", 2]]):
                out = self.render(f"{shape}{number}", shape, "--backend", "threads", *options)
                self.assertEqual(json.loads((out / "frames.json").read_text())["format"], shape)
                self.assertIn(f"pixels ({pixels}) ", self.succeed("mars", "verify", out))
                hashes.add(self.verified_hash(out))
            self.assertEqual(len(hashes), 1, shape)

    def test_alpha_is_the_same_for_all_nodes_and_over_the_background_the_film(self):
        for shape in PIXELS:
            out = [self.render(f"{shape}{nodes}", shape, "--alpha", "--backend", "threads", "--nodes", nodes, *more)
                   for nodes, more in ((1, ["--no-coherence"]), (3, ["--sharers", 3, "--groups", 1]))]
            self.assertEqual(len({self.verified_hash(each) for each in out}), 1)
            self.assertEqual(json.loads((out[0] / "frames.json").read_text())["format"], shape + "-alpha")
        refused = self.mars("render", self.film, "-o", "png1", "--backend", "threads")
        self.assertIn("add --alpha", refused.stderr)
        (self.folder / "png1" / "frame-0002.png").unlink()
        self.succeed("mars", "verify", "png1", "--repair", "--backend", "threads", "--nodes", 1)
        self.succeed("mars", "play", "png1", "-o", "sheet.png", "--frames", "0-3")

    def test_files_have_the_names_that_are_asked_for(self):
        quick = ["--backend", "threads", "--nodes", 1, "--quiet"]
        self.succeed("mars", "render", self.film, "-o", "out/shot_####.exr", "--first-number", 1001, "--every", 2, *quick)
        names = lambda: sorted(path.name for path in (self.folder / "out").iterdir())
        self.assertEqual(names(), ["film.mars", "frames.json", "shot_1001.exr", "shot_1003.exr"])
        manifest = json.loads((self.folder / "out/frames.json").read_text())
        self.assertEqual((manifest["version"], manifest["names"], manifest["first_number"], manifest["frames"]),
                         (4, "shot_####", 1001, [[0, 0], [2, 2]]))
        refused = self.mars("render", self.film, "-o", "out", "--format", "exr", *quick)
        self.assertIn("their first is 'shot_1001', not 'frame-0000'", refused.stderr)
        self.succeed("mars", "render", self.film, "-o", "out", "--name", "shot_%04d.exr", "--first-number", 1001, *quick)
        self.assertEqual(len(names()), 6)
        expected = self.verified_hash(self.folder / "out")
        (self.folder / "out/frames.json").write_text("{")
        (self.folder / "out/shot_1002.exr").unlink()
        self.mars("verify", "out", "--repair", *quick)
        self.succeed("mars", "render", self.film, "-o", "out/shot_%04d.exr", "--first-number", 1001, "--kept-film", *quick)
        self.assertEqual(self.verified_hash(self.folder / "out"), expected)
        self.assertEqual(self.verified_hash(self.render("plain", "exr", *quick[:-1])), expected)
        self.succeed("mars", "render", self.film, "-o", "png/f#.png", *quick)
        self.succeed("mars", "play", "png", "-o", "sheet.png", "--frames", "0-3")

    def test_missing_frames_are_rendered_again(self):
        out = self.render("out", "exr", "--backend", "threads")
        expected = self.verified_hash(out)
        torn = out / "frame-0001.exr"
        torn.write_bytes(torn.read_bytes()[:-20])
        (out / "frame-0003.exr").unlink()
        printed = self.mars("verify", out).stdout
        self.assertIn("frame 1: not a whole EXR picture", printed)
        self.assertEqual(self.succeed("mars", "verify", out, "--missing").strip(), "1,3")
        self.render("out", "exr", "--frames", "1,3", "--overwrite", "--backend", "threads")
        self.assertEqual(self.verified_hash(out), expected)

    def test_play_shows_png_and_exr(self):
        for shape in ("png16", "exr"):
            self.render(shape, shape, "--backend", "threads")
            self.succeed("mars", "play", shape, "-o", f"{shape}.png", "--frames", "0-3")
            self.assertTrue(intact(self.folder / f"{shape}.png"))


if __name__ == "__main__":
    main()
