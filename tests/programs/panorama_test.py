"""Panoramas: faces that nodes draw and mars joins. The files are the same byte for byte however the faces are drawn, and
a rendering goes on where it stopped."""

import json
import shutil
import signal
import subprocess
import unittest

from harness import PROGRAMS, SANITIZED, SECONDS, ENVIRONMENT, ProgramTest, family, main, needs, send, wait_until
from png_reader import png_rows

THREADS = ["--backend", "threads", "-q"]


def a_film(frames=4, size=(64, 32), **more):
    """A box that flies once round the camera, over a still floor."""
    box = {"joints": [{"name": "a", "segment": {"shape": "box", "sbb": [[-1, -1, -1], [1, 1, 1]]}}]}
    floor = {"joints": [{"name": "a", "segment": {"shape": "box", "sbb": [[-9, -9, -3], [9, 9, -2]]}}]}
    ways = [[0, 4, 0], [4, 0, 0], [0, -4, 0], [-4, 0, 0]]
    return {"frames": frames, "size": list(size), "samples": 2, "background": [0.1, 0.2, 0.4],
            "camera": {"projection": "panorama", "eye": [0, 0, 0], "at": [0, 1, 0]},
            "models": {"box": box, "floor": floor}, "materials": {"red": {"color": [0.9, 0.1, 0.1]}},
            "actors": [{"name": "floor", "model": "floor"},
                       {"name": "box", "model": "box", "material": "red",
                        "keys": [{"frame": i, "place": way} for i, way in enumerate(ways)]}], **more}


class Panoramas(ProgramTest):
    def render(self, film, folder, *words):
        return self.succeed("mars", "render", film, "-o", folder, "--backend", "threads", *words)

    def files(self, folder):
        return {path.name: path.read_bytes() for path in (self.folder / folder).glob("frame-*")}

    def left(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_files_are_the_same_for_every_division(self):
        film = self.write("film.json", a_film())
        for form in [[], ["--format", "exr", "--alpha"], ["--format", "png16"]]:
            self.render(film, "alone", *form, "--nodes", 1, "--no-coherence")
            self.assertEqual(len(self.files("alone")), 4)
            for how in [["--nodes", 3], ["--nodes", 3, "--groups", 1, "--write", "nodes"]]:
                self.render(film, "out", *form, *how)
                self.assertEqual(self.files("out"), self.files("alone"), (form, how))
                self.assertIn("4 frames, all there and whole", self.succeed("mars", "verify", "out"))
                self.assertEqual(self.left(), ["alone", "film.json", "out"], "no faces are left")
                shutil.rmtree(self.folder / "out")
            shutil.rmtree(self.folder / "alone")

    def test_the_box_goes_round(self):
        """It is ahead, then to the right, behind and to the left."""
        film = self.write("film.json", a_film())
        self.render(film, "out")
        for number, middle in enumerate([32, 48, 0, 16]):
            row = png_rows(self.folder / "out" / f"frame-{number:04}.png")[16]
            red = [x for x in range(64) if row[3 * x] > 1.3 * row[3 * x + 2] + 5]
            expected = {(middle + x) % 64 for x in range(-3, 3)}  # 2 * atan(1 / 3) is 6.6 pixels
            self.assertEqual(set(red), expected, number)

    def test_it_goes_on(self):
        film = self.write("film.json", a_film())
        self.assertIn("4 frames joined in out", self.render(film, "out"))
        whole = self.files("out")
        before = {path.name: path.stat().st_ino for path in (self.folder / "out").glob("frame-*")}
        self.assertIn("4 of 4 frames are there already", self.render(film, "out"))
        for number in [1, 3]:
            (self.folder / "out" / f"frame-000{number}.png").unlink()
        printed = self.render(film, "out")
        self.assertIn("2 of 4 frames are there already", printed)
        self.assertIn("2 frames joined in out", printed)
        self.assertEqual(self.files("out"), whole)
        for number in [0, 2]:
            self.assertEqual((self.folder / "out" / f"frame-000{number}.png").stat().st_ino, before[f"frame-000{number}.png"])
        (self.folder / "out" / "frame-0002.png").write_bytes(b"torn")
        self.succeed("mars", "verify", "out", "--repair", "--backend", "threads")
        self.assertEqual(self.files("out"), whole)
        # Only frames of an edited film that show something else are joined again.
        edited = a_film()
        edited["actors"][1]["keys"][3]["place"] = [-5, 0, 0]
        self.write("film.json", edited)
        self.assertIn("1 frame joined in out", self.render(film, "out"))
        self.assertEqual({name for name, content in self.files("out").items() if content != whole[name]}, {"frame-0003.png"})

    def test_a_stopped_run_goes_on_with_its_faces(self):
        film = self.write("film.json", a_film(40))
        self.render(film, "whole")
        words = ["render", film, "-o", "out", *THREADS]
        process = subprocess.Popen([str(PROGRAMS / "mars"), *map(str, words)], cwd=self.folder, env=ENVIRONMENT,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(self.end, process)
        faces = self.folder / "out.mars-work" / "faces"
        wait_until(lambda: process.poll() is not None or len(list(faces.glob("*.exr"))) > 20, SECONDS, "no face")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=SECONDS)
        if process.returncode == 0:
            self.skipTest("it was done too soon")
        drawn = {path.name: path.stat().st_ino for path in faces.glob("*.exr")}
        self.assertEqual(self.files("out"), {})
        self.assertGreater(len(drawn), 20)
        self.assertIn("frames are there already", self.render(film, "out"))
        self.assertEqual(self.files("out"), self.files("whole"))
        self.assertFalse(faces.parent.exists())

    def test_a_damaged_face_is_drawn_again(self):
        film = self.write("film.json", a_film())
        self.render(film, "whole")
        self.render(film, "out", "--frames", "0-1")
        work = self.folder / "out.mars-work"
        work.mkdir()
        (work / "made-by-mars").touch()
        self.render(film, "all", "--frames", "2-3")
        self.render(film, work / "faces", "--faces", "--format", "exr", "--frames", "12-17")
        face = sorted((work / "faces").glob("*.exr"))[3]
        face.write_bytes(face.read_bytes()[:200])
        printed = self.render(film, "out", "--report", "report.json")
        self.assertIn("1 damaged or missing frame of out.mars-work/faces", printed)
        self.assertIn("the report and the trace have nothing of what is drawn again", printed)
        self.assertEqual(len(json.loads((self.folder / "report.json").read_text())["frames"]), 10)
        self.assertEqual(self.files("out"), self.files("whole"))
        self.assertFalse(work.exists())

    def test_a_damaged_face_is_named_while_another_run_draws_faces(self):
        film = self.write("film.json", a_film(1000, (1024, 512)))
        work = self.folder / "out.mars-work"
        work.mkdir()
        (work / "made-by-mars").touch()
        faces = ["render", film, "-o", work / "faces", "--faces", "--format", "exr", *THREADS]
        self.succeed("mars", *faces, "--every", 1000)
        face = sorted((work / "faces").glob("*.exr"))[3]
        face.write_bytes(face.read_bytes()[:200])
        words = [PROGRAMS / "mars", *faces, "--frames", "1-999,1001-1999", "--nodes", 1]
        process = subprocess.Popen([*map(str, words)], cwd=self.folder, env=ENVIRONMENT, stderr=subprocess.PIPE)
        self.addCleanup(self.end, process)
        wait_until(lambda: len(list((work / "faces").glob("*.exr"))) > 6, SECONDS, "no face")
        send([process.pid, *family(process.pid)], signal.SIGSTOP)
        self.assertLess(len(list((work / "faces").glob("*.exr"))), 1998, "the other run still has faces to draw")
        done = self.fail_clearly(1, "render", film, "-o", "out", "--frames", "0", *THREADS, says=face.name)
        self.assertNotIn("another run", done.stderr)

    def test_faces_that_a_killed_process_left_go(self):
        """Those of the frames that are there; a folder that somebody rendered on purpose stays."""
        film = self.write("film.json", a_film())
        self.render(film, "out.faces", "--faces", "--format", "exr")
        self.render(film, "out")
        work = self.folder / "out.mars-work"
        work.mkdir()
        (work / "made-by-mars").touch()
        shutil.copytree(self.folder / "out.faces", work / "faces")
        (work / "faces" / "frames.json").unlink()
        self.render(film, "out")
        self.assertEqual(self.left(), ["film.json", "out", "out.faces"])
        self.assertEqual(len(self.files("out.faces")), 24)

    def test_some_frames_with_names_and_faces_themselves(self):
        film = self.write("film.json", a_film())
        self.render(film, "dir/shot_####.exr", "--every", 2)
        self.assertEqual(sorted(path.name for path in (self.folder / "dir").iterdir()),
                         ["film.mars", "frames.json", "shot_0000.exr", "shot_0002.exr"])
        self.render(film, "faces", "--faces")
        self.assertEqual(len(self.files("faces")), 24)
        self.succeed("mars", "compile", film, "-o", "film.mars")
        self.render("film.mars", "compiled")
        self.render(film, "out")
        pictures = lambda folder: [png_rows(path) for path in sorted((self.folder / folder).glob("*.png"))]
        self.assertEqual(pictures("compiled"), pictures("out"))
        self.assertIn("panorama, of six faces of 24 x 24", self.succeed("mars", "info", film))
        self.succeed("mars", "render", film, "--sink", "none", *THREADS)
        plan = json.loads(self.succeed("mars", "plan", film, "--platform", "fat-tree", "--nodes", 2, "--frames", "1-2", "--json"))
        self.assertEqual(plan["frames"], 12)
        self.succeed("mars", "render", film, "--backend", "simulated", "--sink", "none", "--nodes", 2, "-q")

    def test_what_cannot_be(self):
        wide = self.write("wide.json", a_film(size=(64, 36)))
        self.fail_clearly(1, "render", wide, "-o", "out", *THREADS, says="twice as wide as high, not 64x36")
        self.render(wide, "out", "--size", "64x32")
        film = self.write("film.json", a_film())
        self.fail_clearly(1, "render", film, "-o", "b", "--eye", "left", *THREADS, says="has no stereo pair")
        plain = a_film()
        del plain["camera"]["projection"]
        plain = self.write("plain.json", plain)
        self.fail_clearly(1, "render", plain, "-o", "b", "--faces", *THREADS, says="is no panorama, so it has no faces")
        self.assertIn("mars render joins", self.run_program("mars-threads", film, "-o", "b", "--nodes", 1).stderr)

    @unittest.skipIf(SANITIZED, "sanitizers have memory of their own")
    def test_what_joining_takes_is_forecast_and_refused_before_faces_are_drawn(self):
        film = self.write("film.json", a_film(frames=1))
        planned = [json.loads(self.succeed("mars", "plan", film, "--platform", "fat-tree", "--nodes", 1, "--size", size,
                                           "--json", *words))
                   for size, *words in [["512x256"], ["1024x512"], ["512x256", "--faces"]]]
        small, large = (plan["joining_memory"] for plan in planned[:2])
        self.assertAlmostEqual(large / small, 4, delta=0.1)
        self.assertNotIn("joining_memory", planned[2])
        done = self.run_program("prlimit", f"--as={2 << 30}", PROGRAMS / "mars", "render", film, "--size", "16384x8192",
                                "-o", "out", *THREADS)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"joining each frame of its faces takes 3\.\d GB of memory, where there are 2\.1 GB")
        self.assertEqual(self.files("out"), {})

    @needs("ffmpeg", "ffprobe")
    def test_a_video_alone(self):
        film = self.write("film.json", a_film())
        self.render(film, "film.mp4", "--frames", "0-1")
        self.assertEqual(self.left(), ["film.json", "film.mp4"])
        self.assertIn("2 frames of film.json (0-1), 64x32", self.succeed("mars", "verify", "film.mp4"))
        self.assertIn("film.mp4 is there already", self.render(film, "film.mp4", "--frames", "0-1"))


if __name__ == "__main__":
    main()
