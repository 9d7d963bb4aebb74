"""Frames as PNG of 8 or 16 bits and as EXR: the files that --format writes, and what reads them."""

import json
import struct
import zlib

from harness import ProgramTest, main, spinning_teapot

WIDTH, HEIGHT = 64, 36
PIXELS = {"png": "8-bit sRGB", "png16": "16-bit sRGB", "exr": "half-float linear RGB"}


def png_rows(path, depth):
    """Rows of channels of a PNG file as MARS writes them: filtered by the row above, or not."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + length] if kind == b"IDAT" else b""
        at += 12 + length
    size, raw, rows = 3 * WIDTH * depth // 8, zlib.decompress(packed), []
    above = bytes(size)
    for y in range(HEIGHT):
        row = raw[y * (size + 1):(y + 1) * (size + 1)]
        above = bytes(a + b & 255 for a, b in zip(row[1:], above)) if row[0] == 2 else row[1:]
        rows.append(struct.unpack(f">{3 * WIDTH}{'B' if depth == 8 else 'H'}", above))
    return rows


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


class Formats(ProgramTest):
    def setUp(self):
        super().setUp()
        self.film = self.write("film.json", spinning_teapot(4, [WIDTH, HEIGHT]))

    def render(self, name, shape, *more):
        self.succeed("mars", "render", self.film, "-o", name, "--format", shape, "--quiet", *more)
        return self.folder / name

    def test_files_hold_the_same_picture(self):
        png, png16, exr = (self.render(shape, shape, "--backend", "threads", "--nodes", 2) for shape in PIXELS)
        self.assertEqual(sorted(path.name for path in exr.iterdir()), [f"frame-000{i}.exr" for i in range(4)] +
                         ["frames.json"])
        narrow, wide = png_rows(png / "frame-0002.png", 8), png_rows(png16 / "frame-0002.png", 16)
        light = exr_rows(exr / "frame-0002.exr")
        levels = set()
        for a, b, c in zip(narrow, wide, light):
            levels.update(a)
            for level, level16, value in zip(a, b, c):
                self.assertLessEqual(abs(level16 / 257 - level), 0.65)
                self.assertTrue(0 <= value < 100)
                if level == 0:
                    self.assertLess(value, 0.01)
        self.assertGreater(len(levels), 20)

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

    def test_missing_frames_are_rendered_again(self):
        out = self.render("out", "exr", "--backend", "threads")
        expected = self.verified_hash(out)
        torn = out / "frame-0001.exr"
        torn.write_bytes(torn.read_bytes()[:-20])
        (out / "frame-0003.exr").unlink()
        printed = self.mars("verify", out).stdout
        self.assertIn("frame 1: not a whole EXR picture", printed)
        self.assertEqual(self.succeed("mars", "verify", out, "--missing").strip(), "1,3")
        self.render("out", "exr", "--frames", "1,3", "--backend", "threads")
        self.assertEqual(self.verified_hash(out), expected)

    def test_play_shows_png_and_refuses_exr(self):
        for shape in ("png16", "exr"):
            self.render(shape, shape, "--backend", "threads")
        self.succeed("mars", "play", "png16", "-o", "sheet.png", "--frames", "0-3")
        self.fail_clearly(1, "play", "exr", "-o", "sheet.png", says="its frames are EXR files")


if __name__ == "__main__":
    main()
