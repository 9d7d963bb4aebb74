"""Videos that `mars render` and `mars play` write: their frames, colours, size, rate and sound, how they go on, and what
is left when ffmpeg fails."""

import functools
import json
import os
import shutil
import signal
import struct
import subprocess
import wave

import harness
from harness import ENVIRONMENT, PROGRAMS, SECONDS, ProgramTest, main, needs
from png_reader import png_rows

needs_ffmpeg = needs("ffmpeg", "ffprobe")
SMALL = ["--backend", "threads", "-q"]


def a_film(frames=6, size=(64, 36), **more):
    """A red, a green and a blue box that stand on a grey ground while a fourth moves: flat, as coded colours are."""
    box = {"joints": [{"name": "a", "segment": {"shape": "box", "sbb": [[-1, -1, -1], [1, 1, 1]]}}]}
    colours = {"red": [1, 0, 0], "green": [0, 0.8, 0], "blue": [0, 0, 1], "white": [1, 1, 1]}
    look = {"ambient": 1, "diffuse": 0, "specular": 0}
    actors = [{"name": name, "model": "box", "material": name, "place": [3 * i - 4.5, 0, 0]}
              for i, name in enumerate(colours)]
    actors[-1]["keys"] = [{"frame": 0, "place": [4.5, 0, 0]}, {"frame": max(frames - 1, 1), "place": [4.5, 0, 3]}]
    del actors[-1]["place"]
    return {"frames": frames, "size": list(size), "samples": 1, "color": "coded", "background": [0.4, 0.4, 0.4],
            "ambient": [1, 1, 1], "lights": [], "camera": {"eye": [0, -12, 0], "at": [0, 0, 0]},
            "materials": {name: {"color": colour, **look} for name, colour in colours.items()},
            "models": {"box": box}, "actors": actors, **more}


@functools.cache
def encoders():
    """The encoders that ffmpeg lists. Each program asks, and to start ffmpeg takes longer than most tests do."""
    return subprocess.run(["ffmpeg", "-v", "error", "-encoders"], capture_output=True, text=True).stdout


class VideoTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.environment = ENVIRONMENT
        if shutil.which("ffmpeg"):
            self.environment = self.with_ffmpeg('exec $FFMPEG "$@"')

    def with_ffmpeg(self, script):
        """An environment whose ffmpeg knows its encoders at once and is else a script, which finds the real one as $FFMPEG."""
        folder = self.temporary_folder()
        (folder / "encoders").write_text(encoders())
        knows = f'case "$*" in *-encoders*) exec cat {folder}/encoders;; esac\n' if "$FFMPEG" in script else ""
        (folder / "ffmpeg").write_text(f"#!/bin/sh\nFFMPEG={shutil.which('ffmpeg')}\n{knows}{script}\n")
        (folder / "ffmpeg").chmod(0o755)
        return {**ENVIRONMENT, "PATH": f"{folder}:{os.environ['PATH']}"}

    def run_program(self, *words, **more):
        return super().run_program(*words, **{"env": self.environment, **more})

    def probe(self, file):
        printed = self.run_program("ffprobe", "-v", "error", "-count_frames", "-show_streams", "-show_format", "-of", "json", file)
        found = json.loads(printed.stdout)
        self.streams = {stream["codec_type"]: stream for stream in found["streams"]}
        return self.streams["video"]

    def decoded(self, file):
        """Each picture as rows of RGB."""
        stream = self.probe(file)
        width, height = stream["width"], stream["height"]
        raw = subprocess.run(["ffmpeg", "-v", "error", "-i", file, "-map", "0:v", "-vf", "scale=in_color_matrix=bt709:flags=accurate_rnd+full_chroma_int",
                              "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], cwd=self.folder, capture_output=True, check=True).stdout
        size = 3 * width * height
        return [[raw[at + 3 * width * y:at + 3 * width * (y + 1)] for y in range(height)] for at in range(0, len(raw), size)]

    def render(self, film, *words):
        return self.succeed("mars", "render", film, *words, "--backend", "threads")

    def frames(self, folder):
        return [png_rows(file) for file in sorted((self.folder / folder).glob("frame-*.png"))]

    def left(self):
        return sorted(path.name for path in self.folder.iterdir())


@needs_ffmpeg
class Rendered(VideoTest):
    def test_a_video_alone(self):
        """Its frames have a folder of their own until it is there; it plays in browsers and phones."""
        film = self.write("film.json", a_film(6))
        printed = self.render(film, "-o", "film.mp4")
        self.assertIn("6 frames in film.mp4", printed)
        self.assertEqual(self.left(), ["film.json", "film.mp4"])
        stream = self.probe("film.mp4")
        expected = {"codec_name": "h264", "profile": "High", "pix_fmt": "yuv420p", "width": 64, "height": 36,
                    "r_frame_rate": "24/1", "nb_read_frames": "6", "color_range": "tv", "color_space": "bt709",
                    "color_transfer": "bt709", "color_primaries": "bt709"}
        self.assertEqual({key: stream.get(key) for key in expected}, expected)
        data = (self.folder / "film.mp4").read_bytes()
        self.assertLess(data.index(b"moov"), data.index(b"mdat"), "it plays while it is loaded")
        self.assertIn("6 frames of film.json (0-5), 64x36, 24 frames/s, h264, all there and whole",
                      self.succeed("mars", "verify", "film.mp4"))
        before = (self.folder / "film.mp4").stat()
        self.assertIn("film.mp4 is there already", self.render(film, "-o", "film.mp4"))
        self.assertEqual((self.folder / "film.mp4").stat().st_ino, before.st_ino)
        self.render(film, "-o", "film.mp4", "--frames", "1-3")
        self.assertEqual(self.probe("film.mp4")["nb_read_frames"], "3")
        self.render(film, "-o", "film.mp4", "--frames", "1-3", "--alpha")
        self.assertNotIn("already", self.render(film, "-o", "film.mp4", "--frames", "1-3"))
        self.render(film, "-o", "film.mp4", "--frames", "1-3", "--report", "report.json")
        self.assertTrue((self.folder / "report.json").exists(), "what is to be measured is rendered")

    def test_names(self):
        """Names of videos and frames: nothing in them is a pattern, an address or an option."""
        film = self.write("film.json", a_film(3))
        (self.folder / "a#b?c'd").mkdir()
        for name, *words in [["b%d.mp4", "--name", "shot_##"], ["b##.mp4", "-o", "a#b?c'd/e%20.mp4", "--name", "-x_####"]]:
            self.render(film, "-o", name, *words)
        self.assertEqual(self.left(), ["a#b?c'd", "b##.mp4", "b%d.mp4", "film.json"])
        for name in ["a#b?c'd/e%20.mp4", "b##.mp4", "b%d.mp4"]:
            self.assertEqual(self.probe(name)["nb_read_frames"], "3")

    def test_every_other_frame(self):
        """The video takes as long as the film."""
        film = self.write("film.json", a_film(6))
        self.render(film, "-o", "film.mp4", "--every", "2")
        stream = self.probe("film.mp4")
        self.assertEqual((stream["nb_read_frames"], stream["r_frame_rate"]), ("3", "12/1"))
        self.succeed("mars", "verify", "film.mp4")

    def test_short_gifs(self):
        """Fast films give at least one picture."""
        for rate, frames in [(120, "0"), (1000, "0-5"), (1000, "0"), (50, "0")]:
            film = self.write("film.json", a_film(6, rate=rate))
            self.render(film, "-o", "film.gif", "--frames", frames)
            self.assertEqual(self.probe("film.gif")["nb_read_frames"], "1", (rate, frames))

    def test_frames_of_another_size(self):
        film, small = self.write("film.json", a_film(3)), self.write("small.json", a_film(3, (32, 18)))
        self.render(film, "-o", "out")
        self.render(small, "-o", "small")
        (self.folder / "small/frame-0001.png").replace(self.folder / "out/frame-0001.png")
        self.fail_clearly(1, "play", "out", "-o", "film.mp4", says="out/frame-0001.png: has 32x18 pixels instead of 64x36")

    def test_pictures_are_the_frames(self):
        """In their order, with the right colours: flat ones within 2 levels; lossless ones exactly."""
        film = self.write("film.json", a_film(8, (160, 90), rate=29.97))
        self.render(film, "-o", "out", "-o", "film.mp4", "-o", "film.webm", "-o", "film.apng", "-o", "film.gif", "--write", "nodes",
                    "--nodes", "3", "--groups", "2")
        frames = self.frames("out")
        self.assertEqual(len(frames), 8)
        self.assertEqual(self.decoded("film.apng"), frames)
        for name in ["film.mp4", "film.webm"]:
            shown = self.decoded(name)
            self.assertEqual(len(shown), 8, name)
            self.assertEqual(self.streams["video"]["r_frame_rate"], "30000/1001", name)
            for number, (picture, frame) in enumerate(zip(shown, frames)):
                error = sum((a - b) ** 2 for row, other in zip(picture, frame) for a, b in zip(row, other)) / (3 * 160 * 90)
                self.assertLess(error, 65025 / 10 ** 3, f"{name}, frame {number}: less than 30 dB")
                for x in [6, 32, 63, 96]:  # the ground and three boxes, away from edges
                    here, there = picture[45][3 * x:3 * x + 3], frame[45][3 * x:3 * x + 3]
                    self.assertLessEqual(max(abs(a - b) for a, b in zip(here, there)), 2, (name, number, x, *here, *there))
        self.assertEqual(self.probe("film.gif")["nb_read_frames"], "8")
        self.assertEqual(self.left(), ["film.apng", "film.gif", "film.json", "film.mp4", "film.webm", "out"])

    def test_odd_sizes(self):
        """Codecs that need even sides have the last column and row twice; nothing is scaled."""
        film = self.write("film.json", a_film(3, (63, 35)))
        printed = self.render(film, "-o", "out", "-o", "film.mp4", "-o", "film.webm")
        self.assertIn("film.mp4 has 64x36 pixels, because h264 needs even sides: the last column and row are repeated", printed)
        self.assertNotIn("film.webm has", printed)
        self.assertEqual([(s["width"], s["height"]) for s in map(self.probe, ["film.mp4", "film.webm"])], [(64, 36), (63, 35)])
        self.assertNotIn("pixels", self.render(film, "-o", "film.mkv", "--codec", "ffv1"))
        self.assertEqual(self.decoded("film.mkv"), self.frames("out"))

    def test_codecs(self):
        film = self.write("film.json", a_film(3))
        for name, codec, found in [("a.mp4", "h265", "hevc"), ("a.webm", "av1", "av1"), ("a.mov", "prores", "prores"),
                                   ("b.mkv", "vp9", "vp9")]:
            self.render(film, "-o", "out", "-o", name, "--codec", codec)
            stream = self.probe(name)
            self.assertEqual((stream["codec_name"], stream["nb_read_frames"], stream.get("color_space")), (found, "3", "bt709"))
        self.render(film, "-o", "out", "-o", "bad.mkv", "--codec", "vp9", "--quality", "63")
        self.assertLess((self.folder / "bad.mkv").stat().st_size, (self.folder / "b.mkv").stat().st_size)

    def test_processors_change_nothing(self):
        """A piece that was made elsewhere is the one that would be made."""
        processors = os.sched_getaffinity(0)
        self.addCleanup(os.sched_setaffinity, 0, processors)
        self.render(self.write("film.json", a_film(24)), "-o", "out")
        for codec in "h264", "h265", "vp9", "av1", "prores", "ffv1":
            for name, some in [("one", {min(processors)}), ("all", processors)]:
                os.sched_setaffinity(0, some)
                self.succeed("mars", "play", "out", "-o", f"{name}-{codec}.mkv", "--codec", codec)
            self.assertEqual(*((self.folder / f"{name}-{codec}.mkv").read_bytes() for name in ["one", "all"]), codec)

    def test_sound(self):
        with wave.open(str(self.folder / "tone.wav"), "wb") as tone:
            tone.setparams((1, 2, 8000, 0, "NONE", ""))
            tone.writeframes(b"".join(struct.pack("<h", 8000 * (i // 10 % 2)) for i in range(16000)))
        film = self.write("film.json", a_film(24, audio="tone.wav", audio_delay=0.5))
        self.render(film, "-o", "out", "-o", "film.mp4", "-o", "film.webm")
        for name, codec in [("film.mp4", "aac"), ("film.webm", "opus")]:
            self.probe(name)
            self.assertEqual(self.streams["audio"]["codec_name"], codec)
            raw = subprocess.run(["ffmpeg", "-v", "error", "-i", name, "-f", "s16le", "-ac", "1", "-ar", "8000", "-"],
                                 cwd=self.folder, capture_output=True, check=True).stdout
            heard = [value for (value,) in struct.iter_unpack("<h", raw)]
            first = next(i for i, value in enumerate(heard) if abs(value) > 1000)
            self.assertAlmostEqual(first / 8000, 0.5, delta=0.05, msg=name)
            self.assertAlmostEqual(len(heard) / 8000, 1, delta=0.1, msg=f"{name} ends with the film")
        self.assertIn("h264, aac, all there and whole", self.succeed("mars", "verify", "film.mp4"))
        subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", "anullsrc=channel_layout=5.1(side)", "-t", "1", "side.flac"],
                       cwd=self.folder, check=True)
        self.succeed("mars", "play", "out", "-o", "side.webm", "--audio", "side.flac")
        self.probe("side.webm")
        self.assertEqual(self.streams["audio"]["channels"], 6)
        before = (self.folder / "film.mp4").read_bytes()
        self.write("film.json", a_film(24, audio="film.mp4"))
        self.fail_clearly(1, "render", film, "-o", "film.mp4", *SMALL, says="is the file that is read")
        self.assertEqual((self.folder / "film.mp4").read_bytes(), before)
        self.write("film.json", a_film(24, audio="none.wav"))
        self.fail_clearly(1, "render", film, "-o", "b.mp4", *SMALL, says="none.wav', which does not exist")

    def test_played_frames(self):
        film = self.write("film.json", dict(a_film(4), color="linear"))
        self.render(film, "-o", "out")
        self.render(film, "-o", "light", "--format", "exr")
        for folder in ["out", "light"]:
            self.succeed("mars", "play", folder, "-o", f"{folder}.apng")
        shown = self.decoded("out.apng")
        self.assertEqual(shown, self.frames("out"))
        near = zip(self.decoded("light.apng"), self.frames("out"))
        self.assertLessEqual(max(abs(a - b) for one, other in near for row, same in zip(one, other) for a, b in zip(row, same)), 1,
                             "exposed as the film says")
        self.succeed("mars", "play", "light", "-o", "dark.apng", "--exposure", "-3", "--curve", "none")
        self.assertLess(sum(map(sum, self.decoded("dark.apng")[0])), sum(map(sum, shown[0])) / 2)
        for words in [["--exposure", "0"], ["--curve", "agx"]]:
            self.fail_clearly(1, "play", "out", "-o", "b.mp4", *words, says="exposed already")
        (self.folder / "light/film.mars").unlink()
        self.fail_clearly(1, "play", "light", "-o", "b.mp4", says="--exposure 0 --curve filmic")

    def test_verify(self):
        film = self.write("film.json", a_film(6))
        self.render(film, "-o", "film.mp4")
        subprocess.run(["ffmpeg", "-v", "error", "-i", "film.mp4", "-c", "copy", "-frames:v", "4", "cut.mp4"], cwd=self.folder, check=True)
        done = self.mars("verify", "cut.mp4")
        self.assertEqual((done.returncode, done.stdout.splitlines()[0]), (1, "has 4 of 6 frames"))
        data = (self.folder / "film.mp4").read_bytes()
        (self.folder / "torn.mp4").write_bytes(data[:data.index(b"mdat") + 100])
        done = self.mars("verify", "torn.mp4")
        self.assertEqual(done.returncode, 1, done.stdout)
        (self.folder / "no.mp4").write_text("no video")
        self.fail_clearly(1, "verify", "no.mp4", says="no.mp4")


class GoingOn(VideoTest):
    @needs_ffmpeg
    def test_pieces_that_are_there_stay(self):
        """ffmpeg is killed in the second of three pieces: the first stays, as do all frames."""
        film = self.write("film.json", a_film(500, (16, 10)))
        killed = self.with_ffmpeg('case "$*" in *rawvideo*) if mkdir once 2>/dev/null; then exec $FFMPEG "$@"; fi; '
                                  'head -c 3000 >/dev/null; kill -9 $$;; *) exec $FFMPEG "$@";; esac')
        self.fail_clearly(1, "render", film, "-o", "film.mp4", *SMALL, says="ffmpeg was killed by signal 9", env=killed)
        self.assertEqual([name for name in self.left() if "film" in name], ["film.json", "film.mp4.mars-work"])
        pieces = list((self.folder / "film.mp4.mars-work" / "pieces").iterdir())
        self.assertEqual(len(pieces), 1, pieces)
        printed = self.render(film, "-o", "film.mp4")
        self.assertIn("500 of 500 frames are there already", printed)
        self.assertIn("240 frames of film.mp4 are encoded already", printed)
        stream = self.probe("film.mp4")
        self.assertEqual((stream["nb_read_frames"], stream["avg_frame_rate"]), ("500", "24/1"))
        self.assertEqual([name for name in self.left() if "film" in name], ["film.json", "film.mp4"])

    @needs_ffmpeg
    def test_two_of_the_same_name(self):
        """The second waits, says so, and goes on where the first has left nothing."""
        film = self.write("film.json", a_film(3))
        self.render(film, "-o", "out")
        slow = self.with_ffmpeg('case "$*" in *rawvideo*) sleep 0.5; exec $FFMPEG "$@";; *) exec $FFMPEG "$@";; esac')
        play = [PROGRAMS / "mars", "play", "out", "-o", "film.mp4"]
        first = subprocess.Popen(play, cwd=self.folder, env=slow)
        harness.wait_until(lambda: (self.folder / "film.mp4.mars-work" / "pieces").exists(), SECONDS, "no pieces")
        second = subprocess.run(play, cwd=self.folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=SECONDS)
        self.assertEqual((first.wait(SECONDS), second.returncode), (0, 0), second.stderr)
        self.assertIn("film.mp4: another process makes it", second.stdout + second.stderr)
        self.assertEqual(self.probe("film.mp4")["nb_read_frames"], "3")

    @needs_ffmpeg
    def test_two_renderings_of_the_same_name(self):
        """The second waits while the first still draws, and finds the video."""
        film = self.write("film.json", harness.spinning_teapot(60, [160, 90]))
        words = [PROGRAMS / "mars", "render", film, "-o", "film.mp4", "--backend", "threads", "--nodes", "1"]
        first = subprocess.Popen(words, cwd=self.folder, env=ENVIRONMENT, stdout=subprocess.DEVNULL)
        frames = self.folder / "film.mp4.mars-work" / "frames"
        harness.wait_until(lambda: (frames / "frame-0000.png").exists(), SECONDS, "no frame")
        second = subprocess.run(words, cwd=self.folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=SECONDS)
        self.assertEqual((first.wait(SECONDS), second.returncode), (0, 0), second.stderr)
        self.assertIn("film.mp4: another process makes it", second.stdout + second.stderr)
        self.assertIn("film.mp4 is there already", second.stdout + second.stderr)
        self.assertEqual(self.left(), ["film.json", "film.mp4"])

    @needs_ffmpeg
    def test_a_damaged_frame_of_a_working_folder_is_drawn_again(self):
        film = self.write("film.json", a_film(6))
        self.render(film, "-o", "whole.mp4")
        failing = self.with_ffmpeg('case "$*" in *rawvideo*) exit 3;; *) exec $FFMPEG "$@";; esac')
        self.assertEqual(self.mars("render", film, "-o", "film.mp4", *SMALL, env=failing).returncode, 1)
        frames = self.folder / "film.mp4.mars-work" / "frames"
        (frames / "frame-0002.png").write_bytes((frames / "frame-0002.png").read_bytes()[:60])
        self.assertIn("1 damaged or missing frame of film.mp4.mars-work/frames", self.render(film, "-o", "film.mp4"))
        self.assertEqual((self.folder / "film.mp4").read_bytes(), (self.folder / "whole.mp4").read_bytes())

    @needs_ffmpeg
    def test_what_a_killed_process_left_goes(self):
        """mars was killed when the video had its name, and some of the working folder was still there."""
        film = self.write("film.json", a_film(3))
        for words in [["-o", "film.mp4"], ["-o", "out", "-o", "film.mp4"], ["-o", "film.gif"]]:
            self.render(film, *words)
            work = self.folder / (words[-1] + ".mars-work")
            (work / "pieces").mkdir(parents=True)
            (work / "frames").mkdir()
            (work / "made-by-mars").touch()
            (work / "pieces" / "piece-0123.mp4").write_text("left")
            (work / "frames" / "frame-0001.png").write_text("left")
            faces = work / "frames.mars-work" / "faces"
            faces.mkdir(parents=True)
            (faces.parent / "made-by-mars").touch()
            (faces / "frame-0001.exr").write_text("left")
            self.render(film, *words, *(["--overwrite"] if words[-1] == "film.gif" else []))
            self.assertFalse(work.exists(), words)

    @needs_ffmpeg
    def test_what_mars_has_not_made_stays(self):
        film = self.write("film.json", a_film(3))
        (self.folder / "film.mp4").write_text("mine")
        for words in [["render", film, *SMALL], ["preview", film]]:
            self.fail_clearly(1, *words, "-o", "film.mp4", says="is there already, and MARS has not made it")
        (self.folder / "film.gif").write_text("mine")
        self.fail_clearly(1, "render", film, "-o", "film.gif", *SMALL, says="is there already, and MARS has not made it")
        self.assertEqual(self.left(), ["film.gif", "film.json", "film.mp4"], "nothing was rendered")
        self.render(film, "-o", "film.mp4", "--overwrite")
        self.render(film, "-o", "film.mp4", "--size", "40x20")
        (self.folder / "own.mp4.mars-work").mkdir()
        (self.folder / "own.mp4.mars-work" / "mine").touch()
        self.fail_clearly(1, "render", film, "-o", "own.mp4", *SMALL, says="MARS has not made this one")
        self.render(film, "-o", "x.mp4.frames")
        self.render(film, "-o", "x.mp4")
        self.assertTrue((self.folder / "x.mp4.frames" / "frame-0002.png").exists())

    @needs_ffmpeg
    def test_a_killed_rendering_goes_on(self):
        film = self.write("film.json", harness.spinning_teapot(3000, [160, 90]))
        process = subprocess.Popen([PROGRAMS / "mars", "render", film, "-o", "film.mp4", *SMALL, "--nodes", "1"], cwd=self.folder)
        frames = self.folder / "film.mp4.mars-work" / "frames"
        harness.wait_until(lambda: len(list(frames.glob("frame-*.png"))) > 5, SECONDS, "no frames")
        process.send_signal(signal.SIGTERM)
        process.wait(SECONDS)
        self.assertFalse((self.folder / "film.mp4").exists())
        printed = self.render(film, "-o", "film.mp4", "--frames", "0-9")
        self.assertRegex(printed, r"\d+ of 10 frames are there already")
        self.assertEqual(self.probe("film.mp4")["nb_read_frames"], "10")

    @needs_ffmpeg
    def test_a_signal_while_ffmpeg_works(self):
        """However mars ends, so does ffmpeg; the file that was there stays."""
        film = self.write("film.json", a_film(3))
        (self.folder / "film.mp4").write_text("kept")
        slow = self.with_ffmpeg('case "$*" in *rawvideo*) exec sleep 1000;; *) exec $FFMPEG "$@";; esac')
        for sent in [signal.SIGTERM, signal.SIGKILL]:
            process = subprocess.Popen([PROGRAMS / "mars", "render", film, "-o", "film.mp4", "--overwrite", *SMALL], cwd=self.folder, env=slow)
            sleeps = lambda: [p for p, (_, _, program) in harness.family(process.pid).items() if program.endswith("/sleep")]
            harness.wait_until(sleeps, SECONDS, "ffmpeg is not started")
            everyone = harness.family(process.pid)
            process.send_signal(sent)
            self.assertEqual(process.wait(harness.PROMPT), -sent)
            harness.wait_until(lambda: not harness.living(everyone), harness.PROMPT, "ffmpeg lives on")
            self.assertEqual((self.folder / "film.mp4").read_text(), "kept")

    def test_ffmpeg_is_missing(self):
        film = self.write("film.json", a_film(3))
        done = self.mars("render", film, "-o", "film.mp4", *SMALL, env={**ENVIRONMENT, "PATH": str(self.folder)})
        self.assertEqual(done.returncode, 1)
        self.assertClear(done.stderr, "needs the program ffmpeg, which is not installed (install it (Debian: apt install ffmpeg)")
        self.assertEqual(self.left(), ["film.json"], "nothing was rendered")

    @needs_ffmpeg
    def test_failures(self):
        """The file that was there stays, and nothing half-written beside it."""
        film = self.write("film.json", a_film(3))
        (self.folder / "film.mp4").write_text("kept")
        for script, says in [('case "$*" in *rawvideo*) echo "no such encoder" >&2; exit 3;; *) exec $FFMPEG "$@";; esac', "no such encoder"),
                             ('case "$*" in *rawvideo*) echo "x: No space left on device" >&2; exit 1;; *) exec $FFMPEG "$@";; esac', "free some space"),
                             ('case "$*" in *rawvideo*) exit 0;; *) exec $FFMPEG "$@";; esac', "film.mp4"),
                             ('case "$*" in *concat*) kill -9 $$;; *) exec $FFMPEG "$@";; esac', "signal 9"),
                             ("echo none", "no encoder libx264")]:
            with self.subTest(says):
                done = self.mars("render", film, "-o", "film.mp4", "--overwrite", *SMALL, env=self.with_ffmpeg(script))
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertClear(done.stderr, says)
                self.assertEqual((self.folder / "film.mp4").read_text(), "kept")
                self.assertEqual([str(part) for part in self.folder.rglob("*.part")], [])
        self.fail_clearly(1, "render", film, "-o", "none/film.mp4", *SMALL, says="none/film.mp4")

    def test_wishes_that_make_no_sense(self):
        film = self.write("film.json", a_film(3))
        for words, says in [(["-o", "a.mp4", "--codec", "ffv1"], "its codecs: h264, h265, av1, vp9"),
                            (["-o", "a.mp4", "--codec", "x"], "no codec"), (["-o", "a.mp4", "--quality", "99"], "from 1 to 63"),
                            (["-o", "a.mp4", "--quality", "60"], "from 1, the best, to 51"), (["-o", "a.mp4", "--sink", "none"], "needs frames"),
                            (["-o", "a.mp4", "-o", "a.mp4"], "twice"), (["-o", "a", "-o", "b"], "one folder"), (["-o", "a.avi"], "videos are .mp4")]:
            self.fail_clearly(2, "render", film, *words, says=says)
        self.fail_clearly(2, "render", film, "-o", "a", "--codec", "h264", says="there is no video that --codec")
        self.fail_clearly(2, "render", film, "-o", "a.mp4", "--report", "a.mp4", says="a.mp4: is named for two things")
        self.fail_clearly(2, "play", "a", "--columns", "3", says="--columns is for a file that is written")
        self.fail_clearly(2, "play", "a", "-o", "a.png", "--codec", "h264", says="--codec is for videos")
        self.fail_clearly(2, "play", "a", "-o", "a.mp4", "--columns", "3", says="--columns is for contact sheets")
        self.assertEqual(self.left(), ["film.json"])

    @needs_ffmpeg
    def test_a_line_end_in_a_name_is_refused_before_frames_are_rendered(self):
        film = self.write("film.json", a_film(3))
        self.fail_clearly(1, "render", film, "-o", "a\nb.mp4", *SMALL, says="has a line's end in its name")
        self.assertEqual(self.left(), ["film.json"])

    @needs_ffmpeg
    def test_sounds_and_videos_are_regular_files(self):
        """Nobody writes into these pipes: whoever opened them would wait for ever."""
        os.mkfifo(self.folder / "pipe.wav")
        os.mkfifo(self.folder / "pipe.mp4")
        (self.folder / "folder.wav").mkdir()
        for name, says in [("pipe.wav", "pipe.wav', which is not a regular file"), ("folder.wav", "is not a regular file"),
                           ("none.wav", "none.wav', which does not exist")]:
            film = self.write("film.json", a_film(3, audio=name))
            self.fail_clearly(1, "render", film, "-o", "film.mp4", *SMALL, says=says)
            self.fail_clearly(1, "submit", film, "-o", "film.mp4", "--print", says=says)
            checked = self.mars("animate", film, "check")
            self.assertIn(says, checked.stdout)
            self.assertEqual(checked.returncode, 1)
            for words in [["render", film, "-o", f"out-{name[:4]}", *SMALL], ["compile", film, "-o", "film.mars"]]:
                done = self.mars(*words)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(says, done.stderr)
        self.assertFalse(list(self.folder.glob("film.mp4*")))
        self.fail_clearly(1, "verify", "pipe.mp4", says="pipe.mp4: is not a regular file")
        film = self.write("film.json", a_film(3))
        self.render(film, "-o", "out")
        self.fail_clearly(1, "play", "out", "-o", "film.mp4", "--audio", "pipe.wav", says="pipe.wav: is not a regular file")


if __name__ == "__main__":
    main()
