"""Frames as programs that have no code in common with MARS read them, where they are installed: Pillow, pngcheck,
ImageMagick, Chromium and OpenEXR's own. Frames have several bands, and a last one that is shorter."""

import functools
import json
import shutil
import struct
import subprocess
import unittest

from harness import SECONDS, ProgramTest, main, needs, spinning_teapot
from png_reader import png_rows

WIDTH, HEIGHT = 500, 300  # pixels: three bands and a part of one
LIBRARIES_PYTHON = "/usr/bin/python3"  # the one to which packages belong
FRAME = "frame-0001"
PILLOW = "import PIL.Image, sys; i = PIL.Image.open(sys.argv[1]); i.load(); print(i.mode, *i.size, i.text['MARS'])"
PIXELS = "import PIL.Image, sys; sys.stdout.buffer.write(PIL.Image.open(sys.argv[1]).convert('RGB').tobytes())"


def needs_pillow(test):
    found = subprocess.run([LIBRARIES_PYTHON, "-c", "import PIL.Image"], capture_output=True, check=False).returncode
    return unittest.skipIf(found != 0, "not installed: Pillow")(test)


class Readers(ProgramTest):
    @functools.cached_property
    def film(self):
        """Of which EXR files have the numbers that PNG files have, without a curve."""
        return self.write("film.json", {**spinning_teapot(2, [WIDTH, HEIGHT]), "color": "coded"})

    def frame(self, shape, *more):
        folder = "-".join([shape, *more]).replace("--", "")
        self.succeed("mars", "render", self.film, "-o", folder, "--format", shape, "--backend", "threads", "--quiet", *more)
        return next((self.folder / folder).glob(FRAME + ".*"))

    @needs_pillow
    def test_pillow_reads_the_same_pixels_and_the_mark(self):
        for shape in "png", "png16":
            frame = self.frame(shape)
            mode, width, height, mark = self.succeed(LIBRARIES_PYTHON, "-c", PILLOW, frame).split(" ", 3)
            self.assertEqual((mode, int(width), int(height)), ("RGB", WIDTH, HEIGHT))
            self.assertEqual((json.loads(mark)["format"], json.loads(mark)["frame"]), (shape, 1))
        pixels = subprocess.run([LIBRARIES_PYTHON, "-c", PIXELS, self.folder / "png" / (FRAME + ".png")],
                                capture_output=True, check=True).stdout
        self.assertEqual(pixels, b"".join(png_rows(self.folder / "png" / (FRAME + ".png"))))

    @needs("pngcheck")
    def test_pngcheck_finds_no_fault(self):
        for shape, bits in ("png", 24), ("png16", 48):
            printed = self.succeed("pngcheck", "-v", self.frame(shape))
            self.assertIn(f"{WIDTH} x {HEIGHT} image, {bits}-bit RGB, non-interlaced", printed)
            self.assertIn("No errors detected", printed)
            self.assertGreater(printed.count("chunk IDAT"), 2)
        for shape, bits in ("png", 32), ("png16", 64):
            printed = self.succeed("pngcheck", "-v", self.frame(shape, "--alpha"))
            self.assertIn(f"{WIDTH} x {HEIGHT} image, {bits}-bit RGB+alpha, non-interlaced", printed)
            self.assertIn("No errors detected", printed)

    @needs("ffmpeg", "pngcheck")
    def test_pngcheck_finds_no_fault_in_an_animation(self):
        self.succeed("mars", "render", self.film, "-o", "film.apng", "--size", "64x36", "--backend", "threads", "--quiet")
        printed = self.succeed("pngcheck", "-v", "film.apng")
        self.assertIn("64 x 36 image, 24-bit RGB, non-interlaced", printed)
        self.assertIn("No errors detected", printed)
        self.assertEqual((printed.count("chunk acTL"), printed.count("chunk fcTL")), (1, 2), printed)

    @needs_pillow
    def test_pillow_reads_straight_alpha(self):
        alpha, plain = self.frame("png", "--alpha"), self.frame("png")
        script = PIXELS.replace(".convert('RGB')", "")
        rgba = subprocess.run([LIBRARIES_PYTHON, "-c", script, alpha], capture_output=True, check=True).stdout
        rgb = b"".join(png_rows(plain))
        self.assertEqual(len(rgba), 4 * WIDTH * HEIGHT)
        shares = set(rgba[3::4])
        self.assertEqual(shares, {0, 64, 128, 191, 255})
        for at in range(WIDTH * HEIGHT):
            red, green, blue, share = rgba[4 * at:4 * at + 4]
            if share == 0:
                self.assertEqual((red, green, blue), (0, 0, 0))
            if share == 255:
                self.assertEqual(bytes((red, green, blue)), rgb[3 * at:3 * at + 3])

    @needs("identify")
    def test_imagemagick_reads_all_pixels_without_a_warning(self):
        for shape, bits in ("png", "8"), ("png16", "16"):
            printed = self.succeed("identify", "-regard-warnings", "-format", "%w %h %z %[fx:mean>0]", self.frame(shape))
            self.assertEqual(printed.split(), [str(WIDTH), str(HEIGHT), bits, "1"])

    @needs("chromium")
    @needs_pillow
    def test_a_browser_shows_the_same_pixels(self):
        self.write("page.html", f'<body style="margin:0"><img src="png/{FRAME}.png" style="display:block">')
        frame = self.frame("png")
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--hide-scrollbars", "--force-color-profile=srgb",
                        f"--user-data-dir={self.folder / 'chromium'}", f"--window-size={WIDTH},{HEIGHT}",
                        "--screenshot=shown.png", "page.html"], cwd=self.folder, capture_output=True, timeout=SECONDS,
                       check=True)
        shown = subprocess.run([LIBRARIES_PYTHON, "-c", PIXELS, self.folder / "shown.png"], capture_output=True,
                               check=True).stdout
        self.assertEqual(shown, b"".join(png_rows(frame)))

    @needs("exrheader")
    def test_openexr_reads_the_header_and_the_mark(self):
        printed = self.succeed("exrheader", self.frame("exr"))
        for line in (f"dataWindow (type box2i): (0 0) - ({WIDTH - 1} {HEIGHT - 1})", "compression (type compression): zip",
                     "R, 16-bit floating-point, sampling 1 1", "chromaticities (type chromaticities)", "mars (type string)"):
            self.assertIn(line, printed)
        for line in ("framesPerSecond (type rational): 24/1", "imageCounter (type int): 1", "time 00:00:00:01"):
            self.assertIn(line, printed)
        self.assertNotIn("capDate", printed)
        self.assertNotIn("A, 16-bit", printed)
        printed = self.succeed("exrheader", self.frame("exr", "--alpha", "--compression", "piz"))
        for line in ("A, 16-bit floating-point, sampling 1 1", "compression (type compression): piz"):
            self.assertIn(line, printed)

    @functools.cached_property
    def layered(self):
        return self.frame("exr", "--alpha", "--layers", "all", "--size", "64x36")

    @needs("exrheader")
    def test_openexr_reads_the_header_of_layers(self):
        ours = [f"{kind}{rank}.{channel}" for kind in ("CryptoActor", "CryptoJoint", "CryptoMaterial")
                for rank in ("00", "01", "02") for channel in "RGBA"]
        kinds = {**dict.fromkeys(["R", "G", "B", "A", "N.X", "N.Y", "N.Z", *(f"unshadowed.{c}" for c in "RGB")], "half"),
                 **dict.fromkeys(["Z", "backward.u", "backward.v", *ours], "float")}
        for program, line in [("exrheader", {"half": "    {}, 16-bit floating-point, sampling 1 1",
                                             "float": "    {}, 32-bit floating-point, sampling 1 1"}),
                              ("exrinfo", {"half": "   '{}': half samp 1 1", "float": "   '{}': float samp 1 1"})]:
            if not shutil.which(program):
                continue
            done = self.run_program(program, *(["-a"] if program == "exrinfo" else []), self.layered)
            self.assertEqual(done.stderr, "")
            if program == "exrheader":  # exrinfo's exit code is whatever was in memory (OpenEXR 3.1.5)
                self.assertEqual(done.returncode, 0)
            printed = done.stdout.splitlines()
            for name, kind in kinds.items():
                self.assertIn(line[kind].format(name), printed, program)
            manifests = [text for text in printed if "/manifest" in text and "cryptomatte/" in text]
            self.assertEqual(len(manifests), 3, program)

    @needs("identify")
    def test_imagemagick_reads_the_colours_of_layers(self):
        """Layers beside them neither warn nor change what it sees."""
        plain = self.frame("exr", "--alpha", "--size", "64x36")
        seen = [self.succeed("identify", "-regard-warnings", "-format", "%w %h %#", file) for file in (plain, self.layered)]
        self.assertTrue(seen[0].startswith("64 36 "), seen)
        self.assertEqual(*seen)

    @needs("exrmaketiled")
    def test_openexr_reads_the_same_pixels(self):
        """As one tile that is not compressed: of each line the channels, blue first."""
        self.succeed("exrmaketiled", "-o", "-z", "none", "-t", WIDTH, HEIGHT, self.frame("exr"), "tile.exr")
        size = 6 * WIDTH * HEIGHT
        tile = (self.folder / "tile.exr").read_bytes()[-size:]
        for y, row in enumerate(png_rows(self.frame("png16"), 16)):
            levels = struct.unpack(f">{3 * WIDTH}H", row)
            for channel in range(3):
                numbers = struct.unpack_from(f"<{WIDTH}e", tile, (3 * y + channel) * 2 * WIDTH)
                for level, number in zip(levels[2 - channel::3], numbers):
                    self.assertLessEqual(abs(level - 65535 * number), 2 + level / 2000)


if __name__ == "__main__":
    main()
