"""`mars bench peers` on small pictures: all that were built compete and draw alike, and the JSON holds what is printed.

Started as: peers_test.py BUILD_FOLDER."""
import contextlib
import io
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.append(os.path.join(os.path.dirname(__file__), "..", ".."))
sys.path.append(os.path.join(os.path.dirname(__file__), "..", "..", "programs"))
import cases  # noqa: E402
import films  # noqa: E402
import peers  # noqa: E402
import pictures  # noqa: E402
from png_reader import png_rows  # noqa: E402

BUILD = sys.argv[1]
PEERS = os.path.join(BUILD, "bench", "peers")
LLVMPIPE = os.path.join(PEERS, "peer-llvmpipe")
SMALL = ["--size", "384x216", "--dice", "4", "--columns", "1"]
NOT_BUILT = [name for name in ("peer-embree", "peer-llvmpipe") if not os.path.exists(os.path.join(PEERS, name))]
needs_a_peer = unittest.skipIf(len(NOT_BUILT) == 2, "no peer was built: ./bootstrap bench installs their packages")
needs_embree = unittest.skipIf("peer-embree" in NOT_BUILT, "peer-embree was not built")
needs_llvmpipe = unittest.skipIf("peer-llvmpipe" in NOT_BUILT, "peer-llvmpipe was not built")


def bench(*words):
    return subprocess.run([os.path.join(BUILD, "bin", "mars"), "bench", "peers", *words], capture_output=True, text=True)


class Benchmark(unittest.TestCase):
    def measured(self, *words):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "measured.json")
            run = bench(*SMALL, *words, "-o", file)
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(file) as text:
                return json.load(text)["results"]

    @needs_a_peer
    def test_all_compete_and_draw_alike(self):
        for name in NOT_BUILT:
            with self.subTest(peer=name):
                self.skipTest("was not built")
        results = self.measured("--scenes", "s1,s3", "--rounds", "2")
        self.assertEqual([result["course"] for result in results], ["s1", "s3", "s3's inbetweens", "s3's film with files"])
        for result in results:
            self.check_rows(result, 2)

    @needs_embree  # llvmpipe has at most four samples
    def test_samples_compete_side_by_side_and_draw_alike(self):
        results = self.measured("--scenes", "s3", "--rounds", "1", "--samples", "1,4,16")
        self.assertEqual([result["samples"] for result in results], [1, 4, 16] * 3)
        for single, *others in results[:3], results[3:6]:
            of_one = {row["name"]: row["best"] for row in single["competitors"]}
            for result in others:
                self.check_rows(result, 1)
                for row in result["competitors"]:
                    self.assertAlmostEqual(row["cost"], row["best"] / of_one[row["name"]])

    @needs_llvmpipe
    def test_shadows_compete_and_look_alike(self):
        results = self.measured("--scenes", "s1s", "--rounds", "1", "--samples", "1,4", "--dice", "16")
        self.assertEqual([(result["samples"], result["sun"]) for result in results],
                         [(1, "hard"), (1, "soft"), (4, "hard"), (4, "soft")])
        for result in results:
            names = [row["name"] for row in result["competitors"]]
            self.assertIn("llvmpipe 1, map kept", names)
            for row in result["competitors"]:
                self.assertLess(row["rms"], 2, f"{row['name']}, {result['samples']}, {result['sun']}")
            self.assertIn("llvmpipe 1", result["costs"])
            for name, cost in result["costs"].items():
                self.assertGreater(cost["amount"], 1, name)

    @needs_a_peer
    def test_shadows_darken_pictures_and_inbetweens_have_them(self):
        film = films.lengthened(films.load("s3", [384, 216], 4), 30, 30)
        for peer, shadows in ("peer-embree", "0"), ("peer-embree", "0.01"), ("peer-llvmpipe", "map"):
            for samples in "1", "4":
                if peer in NOT_BUILT:
                    continue
                with self.subTest(peer=peer, shadows=shadows, samples=samples):
                    whole, inbetween, without = self.draw(film, peer, [("whole", samples, shadows, 11),
                                                                       ("inbetween", samples, shadows, 10),
                                                                       ("whole", samples, "none", 11)])
                    self.assertLess(pictures.rms(whole, inbetween), 0.5)
                    self.assertGreater(pictures.rms(whole, without), 3)
                    self.assertLess(sum(pictures.read(whole)[1]), sum(pictures.read(without)[1]))

    def draw(self, film, peer, courses):
        """The pictures of a peer's last frames."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        mesh = os.path.join(folder.name, "mesh")
        subprocess.run([os.path.join(PEERS, "bench-mesh"), films.save(film, mesh + ".json"), mesh], check=True)
        files = []
        for course, samples, shadows, frames in courses:
            files.append(os.path.join(folder.name, f"{len(files)}.ppm"))
            subprocess.run([os.path.join(PEERS, peer), mesh, "1", course, samples, shadows],
                           input=f"go {frames}\npicture {files[-1]}\n", text=True, check=True, stdout=subprocess.DEVNULL)
        return files

    @needs_llvmpipe
    def test_a_film_has_the_shadows_of_its_inbetweens(self):
        film = films.lengthened(films.load("s3", [384, 216], 4), 30, 30)
        inbetween, whole = self.draw(film, "peer-llvmpipe", [("inbetween", "1", "map", 29), ("whole", "1", "map", 30)])
        with tempfile.TemporaryDirectory() as folder:
            mesh, shown = os.path.join(folder, "mesh"), os.path.join(folder, "shown.ppm")
            subprocess.run([os.path.join(PEERS, "bench-mesh"), films.save(film, mesh + ".json"), mesh], check=True)
            subprocess.run([LLVMPIPE, mesh, "1", "film", "1", "map", folder, "libpng"], check=True, text=True,
                           input=f"go 30\npicture {shown}\n", stdout=subprocess.DEVNULL)
            self.assertEqual(pictures.read(shown), pictures.read(inbetween))
            self.assertLess(pictures.rms(shown, whole), 0.5)

    def test_scenes_with_shadows_are_the_others_whose_light_casts(self):
        for name, other in films.SHADOWED.items():
            film = films.load(name, sun=0.01)
            size = film["lights"][0].pop("size")  # in degrees
            self.assertAlmostEqual(math.tan(math.radians(size / 2)), 0.01)
            self.assertEqual(film["lights"], [{"direction": [-0.4, -0.7, 0.8], "shadow": True}])
            self.assertEqual(films.without_shadows(film), films.load(other))

    @needs_a_peer
    def test_adaptive_dicing_is_told_apart(self):
        result, = self.measured("--scenes", "s1", "--rounds", "1", "--adaptive")
        fine = {row["name"]: row["rms_fine"] for row in result["competitors"]}
        self.assertLess(fine["ours, adaptive, threads"], fine["ours, threads"] / 2)

    @needs_llvmpipe
    def test_a_competitor_writes_the_pictures_it_draws(self):
        film = films.lengthened(films.load("s3", [384, 216], 4), 30, 30)
        built = subprocess.run([LLVMPIPE, "encoders"], stdout=subprocess.PIPE, text=True, check=True).stdout.split()
        self.assertIn("libpng", built)
        with tempfile.TemporaryDirectory() as folder:
            mesh = os.path.join(folder, "mesh")
            subprocess.run([os.path.join(PEERS, "bench-mesh"), films.save(film, mesh + ".json"), mesh], check=True)
            for encoder in built:
                files = pathlib.Path(folder, encoder)
                files.mkdir()
                shown = files / "shown.ppm"
                subprocess.run([LLVMPIPE, mesh, "1", "film", "1", "none", files, encoder], input=f"go 30\npicture {shown}\n",
                               text=True, check=True, stdout=subprocess.DEVNULL)
                self.assertEqual(len(list(files.glob("*.png"))), 30)
                self.assertEqual(b"".join(png_rows(files / "frame-0029.png")), pictures.read(shown)[1], encoder)

    def test_a_library_that_was_missing_is_named(self):
        result = {"course": "s3's film with files", "column": 1, "samples": 1, "sun": None, "costs": {},
                  "absent": [("igzip", "not built")],
                  "competitors": [{"name": "ours, threads", "best": 1, "middle": 1, "rms": 0}]}
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            peers.tell(result)
        self.assertRegex(printed.getvalue(), "igzip +not built")

    def check_rows(self, result, rounds):
        rows = {row["name"]: row for row in result["competitors"]}
        self.assertIn("ours, threads", rows)
        self.assertIn(result["best_peer"], rows)
        fastest = min(row["best"] for name, row in rows.items() if not name.startswith("ours"))
        for name, row in rows.items():
            self.assertEqual(len(row["milliseconds"]), rounds)
            self.assertEqual(row["best"], min(row["milliseconds"]))
            # Several samples of a triangle are shaded elsewhere in the pixel than ours and Embree's.
            most = 1.5 if "llvmpipe" in name and result["samples"] > 1 else 0.5
            self.assertLess(row["rms"], most, f"{name}, {result['course']}, samples: {result['samples']}")
            if name.startswith("ours"):
                self.assertAlmostEqual(row["ratio"], row["best"] / fastest)

    def test_pictures_that_differ_end_it(self):
        row = {"name": "ours, threads", "rms": peers.MOST_RMS + 0.1}
        with self.assertRaisesRegex(peers.Trouble, "s1, 4 samples: .* differs from Embree's by 0.60"):
            peers.check_alike({"course": "s1", "samples": 4, "sun": None, "competitors": [row]})
        peers.check_alike({"course": "s1", "samples": 4, "sun": None, "competitors": [{**row, "rms": peers.MOST_RMS}]})

    def test_rms(self):
        with tempfile.TemporaryDirectory() as folder:
            files = [os.path.join(folder, name) for name in "ab"]
            for file, pixels in zip(files, (b"\x00\x10\x20" * 2, b"\x00\x10\x26" * 2)):
                with open(file, "wb") as out:
                    out.write(b"P6\n2 1\n255\n" + pixels)
            self.assertAlmostEqual(pictures.rms(*files), (6 * 6 / 3) ** 0.5)

    @needs_a_peer
    def test_what_a_competitor_says_at_its_end_is_told(self):
        run = bench("--scenes", "s1", "--dice", "300", "--rounds", "1")
        self.assertEqual(run.returncode, 1)
        self.assertIn("300", run.stderr)


if __name__ == "__main__":
    cases.main()
