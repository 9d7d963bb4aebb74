"""Parts of pictures, pixels that are not square and views of OpenColorIO: what files say of them, and what reads them."""

import json
import re
import struct

from harness import ProgramTest, main, needs, spinning_teapot
from png_reader import png_rows

SMALL = ["--backend", "threads", "-q"]
CONFIG = """ocio_profile_version: 2
search_path: .
roles: {scene_linear: light, default: light}
displays:
  screen:
    - !<View> {name: Film, colorspace: film}
    - !<View> {name: Plain, colorspace: light}
colorspaces:
  - !<ColorSpace>
    name: light
  - !<ColorSpace>
    name: film
    from_scene_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1], direction: inverse}
"""


def chunk(path, wanted):
    data, at = path.read_bytes(), 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == wanted:
            return data[at + 8:at + 8 + length]
        at += 12 + length
    return None


class Parts(ProgramTest):
    def setUp(self):
        super().setUp()
        self.film("film.json")

    def film(self, name, **more):
        film = {**spinning_teapot(2, [64, 36]), "color": "linear", "curve": "none", **more}
        self.write(name, json.dumps(film))

    def render(self, folder, *words, film="film.json"):
        self.succeed("mars", "render", film, "-o", folder, *SMALL, *words)
        return self.folder / folder

    def header(self, file):
        return self.run_program("exrheader", file).stdout

    def test_a_crop_is_a_part_of_the_whole_picture(self):
        whole, part = self.render("whole"), self.render("part", "--crop", "20,10,30x16", "--nodes", "2")
        for name in ("frame-0000.png", "frame-0001.png"):
            rows = [row[3 * 20:3 * 50] for row in png_rows(whole / name)[10:26]]
            self.assertEqual([bytes(row) for row in png_rows(part / name)], [bytes(row) for row in rows])
        self.succeed("mars", "verify", "part")

    @needs("exrheader")
    def test_exr_files_say_where_the_part_lies(self):
        for writer in ("host", "nodes"):
            part = self.render(writer, "--crop", "20,10,30x16", "--margin", "14", "--format", "exr", "--write", writer)
            header = self.header(part / "frame-0001.exr")
            self.assertRegex(header, re.escape("dataWindow (type box2i): (6 -4) - (63 39)"))
            self.assertRegex(header, re.escape("displayWindow (type box2i): (0 0) - (63 35)"))
            self.succeed("mars", "verify", writer)
        for name in ("frame-0000.exr", "frame-0001.exr"):
            self.assertEqual((self.folder / "host" / name).read_bytes(), (self.folder / "nodes" / name).read_bytes())
        self.succeed("mars", "play", "host", "-o", "shown.png", "--frames", "1")
        self.assertEqual(len(png_rows(self.folder / "shown.png")), 44)

    def test_a_folder_has_one_part(self):
        self.render("part", "--crop", "20,10,30x16", "--frames", "0")
        self.fail_clearly(1, "render", "film.json", "-o", "part", *SMALL, "--crop", "21,10,30x16",
                          says="30x16 from 20,10 of 64x36")
        self.fail_clearly(1, "render", "film.json", "-o", "part", *SMALL, says="30x16 from 20,10 of 64x36")
        self.render("part", "--crop", "20,10,30x16")
        (self.folder / "part" / "frame-0000.png").unlink()
        self.succeed("mars", "verify", "part", "--repair", "--backend", "threads")
        self.succeed("mars", "verify", "part")

    def test_what_is_no_part_is_refused(self):
        for words, code, says in ((["--crop", "40,10,30x16"], 1, "its picture has 64x36 pixels"),
                                  (["--crop", "4,1,0x6"], 2, "it has no pixels"),
                                  (["--crop", "40,10"], 2, "is no part of a picture"),
                                  (["--margin", "65"], 1, "give --margin 0 to 64")):
            self.fail_clearly(code, "render", "film.json", "-o", "none", *SMALL, *words, says=says)

    def test_a_compiled_film_keeps_its_part(self):
        self.succeed("mars", "compile", "film.json", "-o", "part.mars", "--crop", "20,10,30x16")
        self.assertIn("30x16 from 20,10 of 64x36", self.succeed("mars", "info", "part.mars"))
        self.fail_clearly(1, "render", "part.mars", "-o", "none", *SMALL, "--size", "32x18", says="is a part of a picture")
        of_film, of_part = self.render("a", "--crop", "1,2,8x8"), self.render("b", "--crop", "1,2,8x8", film="part.mars")
        self.assertEqual(png_rows(of_film / "frame-0001.png"), png_rows(of_part / "frame-0001.png"))

    @needs("exrheader")
    def test_files_say_which_shape_pixels_have(self):
        self.film("wide.json", pixel_aspect=2)
        png = self.render("png", film="wide.json") / "frame-0000.png"
        self.assertEqual(chunk(png, b"pHYs"), struct.pack(">IIB", 1, 2, 0))
        self.assertIsNone(chunk(self.render("square") / "frame-0000.png", b"pHYs"))
        exr = self.render("exr", "--format", "exr", film="wide.json") / "frame-0000.exr"
        self.assertRegex(self.header(exr), r"pixelAspectRatio \(type float\): 2\n")
        self.succeed("mars", "play", "png", "-o", "shown.png", "--frames", "1")
        self.assertEqual(len(png_rows(self.folder / "shown.png")[0]), 3 * 128)

    @needs("ffmpeg", "ffprobe")
    def test_videos_say_which_shape_pixels_have(self):
        self.film("wide.json", pixel_aspect=1.5)
        self.render("frames", "-o", "a.mp4", "-o", "a.mkv", "-o", "a.webm", "-o", "a.gif", film="wide.json")
        for name in ("a.mp4", "a.mkv", "a.webm", "a.gif"):
            found = self.run_program("ffprobe", "-v", "error", "-show_entries", "stream=sample_aspect_ratio", name).stdout
            self.assertIn("sample_aspect_ratio=3:2", found, name)
        for name in ("a.mp4", "a.mkv", "a.webm"):
            self.succeed("mars", "verify", name)

    def test_a_view_shows_light(self):
        self.write("config.ocio", CONFIG)
        view = ["--ocio", "config.ocio"]
        one, three = self.render("one", *view, "--nodes", "1"), self.render("three", *view, "--nodes", "3")
        self.assertEqual((one / "frame-0001.png").read_bytes(), (three / "frame-0001.png").read_bytes())
        self.succeed("mars", "verify", "one")
        shown, coded = png_rows(one / "frame-0001.png"), png_rows(self.render("srgb") / "frame-0001.png")
        for ours, other in zip(shown, coded):  # sRGB's curve is one of about 2.2
            self.assertLess(max(abs(a - b) for a, b in zip(ours, other)), 12)
        self.assertNotEqual([bytes(row) for row in shown], [bytes(row) for row in coded])
        self.render("light", "--format", "exr")
        self.succeed("mars", "play", "light", "-o", "shown.png", "--frames", "1", *view)
        self.assertEqual(png_rows(self.folder / "shown.png"), shown)

    def test_views_are_not_mixed(self):
        self.write("config.ocio", CONFIG)
        view = ["--ocio", "config.ocio"]
        self.render("frames", *view, "--frames", "0")
        again = ["render", "film.json", "-o", "frames", *SMALL]
        self.fail_clearly(1, *again, *view, "--view", "Plain", says="are shown by the view Film")
        self.fail_clearly(1, *again, says="are shown by the view Film")
        (self.folder / "frames" / "frame-0000.png").unlink()
        self.succeed("mars", "verify", "frames", "--repair", "--backend", "threads")
        self.write("config.ocio", CONFIG.replace("2.2, 2.2", "2.2, 2.3"))
        self.fail_clearly(1, *again, *view, says="as it was before")
        self.fail_clearly(2, *again, *view, "--format", "exr", says="EXR files hold light")
        self.fail_clearly(2, *again, *view, "--write", "nodes", says="have no OpenColorIO config")
        self.fail_clearly(2, *again, "--view", "Film", says="add --ocio CONFIG")
        self.write("coded.json", json.dumps({**spinning_teapot(2, [64, 36]), "color": "coded"}))
        self.fail_clearly(1, "render", "coded.json", "-o", "none", *SMALL, *view, says="coded colours")


if __name__ == "__main__":
    main()
