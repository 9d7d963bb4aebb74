"""mars animate and mars plot, as a person types them: what the film file says afterwards, and what is printed."""

import json
import os
import re
import subprocess

from harness import ENVIRONMENT, EXAMPLES, PROGRAMS, SECONDS, SOURCES, ProgramTest, main, needs

ARM = {"joints": [
    {"name": "shoulder", "limits": {"x": [-90, 90], "y": [-90, 90], "z": [-90, 90]}, "segment": {"shape": "box"}},
    {"name": "elbow", "parent": "shoulder", "place": [1, 0, 0], "limits": {"y": [0, 150]}, "segment": {"shape": "box"}}]}


def film(**more):
    return {"frames": 48, "camera": {"eye": [0, -9, 2]}, "models": {"arm": ARM},
            "actors": [{"name": "robot", "model": "arm"}], **more}


class Animate(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("film.json", film())

    def animate(self, *words):
        return self.mars("animate", "film.json", *words)

    def changed(self, *words):
        """The actor after words that succeed and tell nothing."""
        ended = self.animate(*words)
        self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (0, "", ""))
        return self.actor()

    def actor(self):
        return json.loads((self.folder / "film.json").read_text())["actors"][0]

    def refused(self, *words, code=1):
        """What is printed; the film stays, byte for byte."""
        before = (self.folder / "film.json").read_bytes()
        ended = self.animate(*words)
        self.assertEqual(ended.returncode, code, ended.stderr)
        self.assertEqual((self.folder / "film.json").read_bytes(), before)
        self.assertEqual(len(ended.stderr.splitlines()), 1)
        return ended.stderr

    def frames(self):
        return [key["frame"] for key in self.actor()["keys"]]

    def test_a_film_from_poses(self):
        self.changed("pose", "robot", "elbow.y=90", "place=1,0,0", "--frame", 24, "--ease", "both")
        self.changed("pose", "robot", "shoulder.z=-30", "--frame", 24)
        self.assertEqual(self.actor()["keys"], [
            {"frame": 0, "place": [0, 0, 0], "pose": {"elbow": [0, 0, 0], "shoulder": [0, 0, 0]}},
            {"frame": 24, "place": [1, 0, 0], "pose": {"elbow": [0, 90, 0], "shoulder": {"value": [0, 0, -30], "ease": "linear"}},
             "ease": "both"}])
        self.assertIn("matrices    50\n", self.succeed("mars", "info", "film.json"))

    def test_negative_numbers_need_no_care(self):
        actor = self.changed("pose", "robot", "place=-1,-2,-0.5", "turn.z=-45", "--frame", 0)
        self.assertEqual(actor["keys"], [{"frame": 0, "place": [-1, -2, -0.5], "turn": [0, 0, -45]}])
        self.changed("time", "robot", "--frame", 0, "--shift", 12)
        self.changed("time", "robot", "--frame", 12, "--shift", -6)
        self.assertEqual(self.frames(), [6])

    def test_turns_about_own_axes(self):
        """After three quarter turns, each about an axis as it then stands, the arm stands as by one about y."""
        for setting in ["shoulder.x+=90", "shoulder.z-=90", "shoulder.x-=90"]:
            self.assertEqual(self.animate("pose", "robot", setting, "--local", "--frame", 24).returncode, 0)
        self.assertEqual(self.actor()["keys"][1]["pose"], {"shoulder": [90, 90, -90]})
        self.animate("pose", "robot", "shoulder=0,0,40", "--frame", 24)
        said = self.refused("pose", "robot", "shoulder.x+=150", "--local", "--frame", 24)
        self.assertIn("turned 150 degrees about its own x, turns ", said)
        self.assertIn("--clamp", said)
        self.assertIn("elbow.x+=30", self.refused("pose", "robot", "elbow.y=30", "--local", "--frame", 24))

    def test_scripts_turn_about_own_axes_as_the_command_does(self):
        settings = ["shoulder.x+=80", "shoulder.z-=70", "sh*.x-=60"]
        for setting in settings:
            self.animate("pose", "robot", setting, "--local", "--frame", 24)
        by_command = self.actor()["keys"]
        self.write("film.json", film())
        self.write("arm.script", "".join(f"at 24 robot pose {setting} local\n" for setting in settings))
        self.assertEqual(self.animate("script", "arm.script").returncode, 0)
        self.assertEqual(self.actor()["keys"], by_command)
        self.write("arm.script", "at 24 robot pose shoulder=0,0,40\nthen robot pose shoulder.x+=150 local\n")
        said = self.refused("script", "arm.script")
        self.assertRegex(said, "arm.script:2: .* turned 150 degrees about its own x, turns ")

    def test_relative_turns_of_patterns_and_ranges(self):
        self.changed("pose", "robot", "elbow.y=90", "--frame", 24)
        self.changed("pose", "robot", "e*.y+=10", "--frame", "0-")
        self.changed("pose", "robot", "place.x-=1", "--frame", 24)
        self.assertEqual(self.actor()["keys"], [{"frame": 0, "place": [0, 0, 0], "pose": {"elbow": [0, 10, 0]}},
                                                {"frame": 24, "place": [-1, 0, 0], "pose": {"elbow": [0, 100, 0]}}])
        self.assertIn("finds no key", self.refused("pose", "robot", "shoulder.x+=9", "--frame", "0-24"))

    def test_lights_are_posed_listed_and_checked(self):
        self.write("film.json", film(lights=[{"direction": [0, -1, 1]}, {"place": [0, 0, 5]}]))
        self.animate("pose", "light/2", "intensity=3", "color=1,0.8,0.6", "--frame", 24)
        self.assertRegex(self.animate("list", "light/2", "int*").stdout, r"light/2\n.*\n +0  intensity  1\n +24 +intensity +3")
        self.assertIn("light/1 to light/2", self.refused("pose", "light/3", "intensity=3", "--frame", 24))
        self.animate("move", "light/2", "--frame", 24, "--to", 90)
        self.assertIn("light/2: has keys up to frame 90", self.animate("check").stdout)

    def test_a_film_is_begun_and_rendered(self):
        self.succeed("mars", "film", "new.json", "new", "size=32,18", "frames=1", "--figure", "man")
        before = (self.folder / "new.json").read_bytes()
        again = self.mars("film", "new.json", "new")
        self.assertEqual((again.returncode, (self.folder / "new.json").read_bytes()), (1, before))
        self.assertIn("is there already", again.stderr)
        self.succeed("mars", "film", "new.json", "add", "ball", "--model", "ball", "--place", 1, -1, 0.275)
        self.succeed("mars", "render", "new.json", "-o", "out", "--backend", "threads", "--nodes", 1, "--quiet")
        self.assertIn("Usage: mars film FILM light add", self.succeed("mars", "film", "light", "add", "--help"))

    def test_model_files_are_named_as_the_shell_names_them(self):
        (self.folder / "films").mkdir()
        (self.folder / "models").mkdir()
        self.succeed("mars", "model", "models/pip.json", "new", "hip", "--shape", "box", "--material", "clay",
                     "--color", 1, 1, 1)
        self.succeed("mars", "film", "films/play.json", "new", "frames=1")
        self.succeed("mars", "film", "films/play.json", "add", "pip", "--model", "models/pip.json")
        self.succeed("mars", "film", "play.json", "add", "pip2", "--model", "../models/pip.json",
                     cwd=self.folder / "films")
        film = json.loads((self.folder / "films/play.json").read_text())
        self.assertEqual(film["models"], {"pip": "../models/pip.json"})
        absolute = self.folder / "models/pip.json"
        self.succeed("mars", "film", "films/play.json", "add", "pip3", "--model", absolute)
        self.assertIn("actors      3", self.succeed("mars", "info", "films/play.json"))
        # Through a link, whose ".." is not the film's.
        (self.folder / "deep").mkdir()
        (self.folder / "deep/linked").symlink_to(self.folder / "films")
        self.succeed("mars", "film", "deep/linked/other.json", "new", "frames=1")
        self.succeed("mars", "film", "deep/linked/other.json", "add", "pip", "--model", "models/pip.json")
        self.succeed("mars", "info", "films/other.json")

    def test_a_model_file_beside_the_film_is_pointed_at(self):
        (self.folder / "films").mkdir()
        self.succeed("mars", "model", "films/pip.json", "new", "hip", "--shape", "box", "--material", "clay",
                     "--color", 1, 1, 1)
        self.succeed("mars", "film", "films/play.json", "new", "frames=1")
        self.fail_clearly(1, "film", "films/play.json", "add", "pip", "--model", "pip.json",
                          says="pip.json: there is no such model file (beside the film there is one: "
                               "name it films/pip.json)")
        self.fail_clearly(1, "film", "films/play.json", "add", "pip", "--model", "none.json",
                          says="none.json: there is no such model file (check its name)")

    def test_an_actor_of_another_film_comes_with_its_keys(self):
        self.animate("pose", "robot", "elbow.y=90", "--frame", 24)
        robot = self.actor()
        (self.folder / "films").mkdir()
        self.succeed("mars", "film", "films/play.json", "new", "frames=4")
        self.succeed("mars", "film", "films/play.json", "add", "arm", "--from", "film.json", "--lengthen")
        play = json.loads((self.folder / "films/play.json").read_text())
        self.assertEqual(play["actors"], [{**robot, "name": "arm"}])
        self.assertEqual(play["frames"], 25)
        self.succeed("mars", "info", "films/play.json")
        self.fail_clearly(1, "film", "films/play.json", "add", "arm", "--from", "film.json", says="is an actor of the film already")
        self.fail_clearly(1, "film", "films/play.json", "add", "leg", "--from", "none.json", says="none.json")
        self.fail_clearly(2, "film", "films/play.json", "add", "leg", "--from", "film.json", "--place", 1, 0, 0, says="--from")
        self.fail_clearly(2, "film", "films/play.json", "add", "leg", says="--model")

    def test_limits(self):
        printed = self.refused("pose", "robot", "elbow.y=170", "--frame", 24)
        self.assertIn("actor 'robot', joint 'elbow': turns 170 degrees about y, outside its limits 0 to 150", printed)
        self.assertIn("--clamp", printed)
        clamped = self.animate("pose", "robot", "elbow.y=170", "--frame", 24, "--clamp")
        self.assertEqual((clamped.returncode, clamped.stderr),
                         (0, "mars: actor 'robot', joint 'elbow': 170 degrees about y is beyond its limits 0 to 150: "
                             "keyed as 150\n"))
        self.assertEqual(self.actor()["keys"][1]["pose"]["elbow"], [0, 150, 0])

    def test_keys_moved_copied_and_timed(self):
        self.changed("pose", "robot", "elbow.y=90", "--frame", 12)
        self.changed("copy", "robot", "--frame", "0-12", "--to", 24)
        self.assertEqual(self.frames(), [0, 12, 24, 36])
        self.changed("move", "robot", "elbow", "--frame", 36, "--to", 40)
        self.changed("time", "robot", "--frame", "0-24", "--stretch", 0.5)
        self.assertEqual(self.frames(), [0, 6, 12, 28])
        self.changed("time", "robot", "--frame", 6, "--hold", 4)
        self.assertEqual(self.frames(), [0, 6, 10, 16, 32])
        self.changed("delete", "robot", "--frame", "16-")
        self.assertEqual(self.frames(), [0, 6, 10])
        actor = self.changed("time", "robot", "--frame", 0, "--anticipate", 10, "--overshoot", 20)
        self.assertEqual(len(actor["keys"][0]["ease"]), 4)

    def test_keys_behind_the_end_are_reported_or_the_film_grows(self):
        ended = self.animate("pose", "robot", "elbow.y=90", "--frame", 60)
        self.assertEqual(ended.returncode, 0)
        self.assertEqual(ended.stderr, "")
        self.assertIn("the last key is at frame 60; the film shows only its 48 frames: --lengthen, or set its frames "
                      "to 61", ended.stdout)
        self.assertIn("has keys up to frame 60", self.animate("check").stdout)
        self.assertEqual(self.animate("move", "robot", "--frame", 60, "--to", 61, "--lengthen").stdout,
                         "the film has 62 frames now, not 48\n")
        self.assertEqual(json.loads((self.folder / "film.json").read_text())["frames"], 62)

    def test_a_motion_behind_the_end_is_reported_and_done_again_from_where_it_began(self):
        ended = self.animate("spin", "robot", "--at", 12)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertEqual(ended.stdout, "frames 12 to 60; the film shows only its 48 frames: set its frames to 61, "
                                       "or repeat this with --at 12 --lengthen\n")
        keys = self.actor()["keys"]
        self.assertEqual(self.animate("spin", "robot", "--at", 12, "--lengthen").stdout, "frames 12 to 60; the film has 61 frames now, not 48\n")
        self.assertEqual(self.actor()["keys"], keys)
        self.assertEqual(json.loads((self.folder / "film.json").read_text())["frames"], 61)

    def test_numbers_that_are_missing_are_asked_for_by_an_example(self):
        self.assertEqual(self.refused("go", "robot", "--to", 2),
                         "mars: go: --to has 1 of its 3 numbers (write --to 2 0 0)\n")

    def test_all_and_the_camera(self):
        self.changed("pose", "robot", "elbow.y=90", "--frame", 12)
        self.changed("pose", "camera", "eye.x=3", "fov=30", "--frame", 12)
        self.changed("time", "--all", "--frame", 5, "--shift", 10)
        table = self.animate("list").stdout
        self.assertEqual(self.frames(), [0, 22])
        self.assertRegex(table, r"camera\n.*\n +0  eye   x 0  y -9  z 2\n +fov   40\n +22  eye   x 3")

    def test_the_camera_is_cut(self):
        self.changed("cut", "camera", "eye", "--frame", 12)
        self.changed("pose", "camera", "eye.x=3", "--frame", 12)
        self.assertEqual(self.animate("list", "camera").stdout,
                         "camera\n  frame  part  value           ease\n"
                         "      0  eye   x 0  y -9  z 2  hold\n     12  eye   x 3  y -9  z 2\n")
        self.assertIn("cut at a later frame", self.refused("cut", "camera", "--frame", 0))

    def test_list_shows_what_is_keyed(self):
        self.changed("pose", "robot", "elbow.y=90", "--frame", 12, "--ease", "out")
        self.assertEqual(self.animate("list", "robot").stdout,
                         "actor 'robot'\n  frame  part   value  ease\n      0  elbow  y 0\n     12  elbow  y 90   out\n")

    def test_check_finds_limits_left_between_keys_and_a_key_mends_them(self):
        self.changed("pose", "robot", "shoulder=0,80,0", "--frame", 0)
        self.changed("pose", "robot", "shoulder=85,80,-90", "--frame", 24)
        data = json.loads((self.folder / "film.json").read_text())
        data["models"]["arm"]["joints"][0]["limits"]["y"] = [-81, 81]
        self.write("film.json", data)
        ended = self.animate("check")
        self.assertEqual(ended.returncode, 1)
        self.assertRegex(ended.stdout, r"actor 'robot', joint 'shoulder': turns \S+ degrees about y between keys, "
                                       r"outside its limits -81 to 81, in frame 12")
        line = "film.json: actor 'robot', joint 'shoulder': turns "
        typed = "mars animate film.json key robot shoulder --frame 12 --clamp"
        self.assertRegex(self.succeed("mars", "info", "film.json"), f"\nwarning     {line}.* in frame 12 .*{typed}")
        compiled = self.mars("compile", "film.json", "-o", "film.mars")
        self.assertEqual((compiled.returncode, compiled.stdout), (0, ""))
        self.assertRegex(compiled.stderr, f"^mars: warning: {line}.* in frame 12 .*{typed}\\)\n$")
        rendered = self.mars("render", "film.json", "-o", "frames", "--backend", "threads", "--nodes", 1, "--frames", 0,
                             "--size", "32x18", "--quiet")
        self.assertEqual((rendered.returncode, rendered.stdout, rendered.stderr), (0, "", compiled.stderr))
        fix = re.search(r"fix it with: (.*)\)", ended.stdout)[1]
        worst = self.degrees_outside(ended.stdout)
        self.assertIn("is beyond its limits -81 to 81: keyed as ", self.animate(*fix.split()).stderr)
        after = self.animate("check").stdout
        self.assertLess(self.degrees_outside(after) if "turns" in after else 0, worst / 2)

    def test_a_film_in_which_nobody_acts_is_warned_of(self):
        self.write("film.json", film(actors=[]))
        compiled = self.mars("compile", "film.json", "-o", "film.mars")
        printed = "film.json: has no actors: every frame shows the background alone (give the film actors)\n"
        self.assertEqual((compiled.returncode, compiled.stderr), (0, f"mars: warning: {printed}"))
        self.assertTrue(self.succeed("mars", "info", "film.json").endswith(f"\nwarning     {printed}"))
        rendered = self.mars("render", "film.mars", "-o", "frames", "--backend", "threads", "--nodes", 1, "--frames", 0,
                             "--size", "32x18")
        self.assertEqual((rendered.returncode, rendered.stderr),
                         (0, f"mars: warning: {printed.replace('json', 'mars')}"))

    def test_what_a_pose_does_besides_is_told(self):
        ended = self.animate("pose", "robot", "turn.z=270", "--frame", 20)
        self.assertEqual((ended.returncode, ended.stdout), (0, ""))
        self.assertIn("mars: actor 'robot': turn goes 90 degrees back from frame 0 to 20", ended.stderr)
        self.changed(*re.search(r"also (pose .*)\)", ended.stderr)[1].split())

    def test_eases_and_slopes_of_single_parts(self):
        self.changed("pose", "robot", "elbow.y=90", "place=1,0,0", "--frame", 24)
        actor = self.changed("time", "robot", "elbow", "--frame", 0, "--ease", "both")
        self.assertEqual(actor["keys"][0], {"frame": 0, "place": [0, 0, 0],
                                            "pose": {"elbow": {"value": [0, 0, 0], "ease": "both"}}})
        actor = self.changed("tangent", "robot", "elbow.y", "--frame", 24, "--in", "-2.5")
        self.assertEqual(actor["keys"][0]["pose"]["elbow"]["ease"], "spline")
        self.assertEqual(actor["keys"][1]["pose"]["elbow"], {"value": [0, 90, 0], "in": [0, -2.5, 0]})
        self.assertEqual(next(iter(json.loads((self.folder / "film.json").read_text()).items())), ("version", 2))
        self.assertIn("elbow  y 90           in 0 -2.5 0\n", self.animate("list", "robot").stdout)
        self.assertEqual(self.changed("tangent", "robot", "elbow", "--frame", 24, "--auto")["keys"][1]["pose"],
                         {"elbow": [0, 90, 0]})
        self.assertIn("use --in and --out, or --flat, or --auto",
                      self.refused("tangent", "robot", "elbow", "--frame", 24))

    def degrees_outside(self, printed):
        return float(re.search(r"turns (\S+) degrees", printed)[1]) - 81

    def test_what_cannot_be_done_is_told(self):
        self.changed("pose", "robot", "elbow.y=90", "--frame", 12)
        self.assertIn("did you mean 'elbow'?", self.refused("pose", "robot", "elbwo.y=9", "--frame", 3))
        self.assertIn("did you mean 'robot'?", self.refused("key", "robbot", "--frame", 3))
        self.assertIn("its keys stand at 0, 12", self.refused("move", "robot", "--frame", "3-5", "--to", 9))
        self.assertIn("name an actor, camera, light/N or material/NAME, or use --all", self.refused("delete", "--frame", 0))
        self.assertIn("--all and 'robot'", self.refused("delete", "robot", "--all", "--frame", 0))
        self.assertIn("use one of --ease", self.refused("time", "robot", "--frame", 0))
        self.assertIn("is no frame", self.refused("key", "robot", "--frame", "twelve"))
        self.assertIn("ends before it begins", self.refused("delete", "robot", "--frame", "12-3"))
        for typed, says in [("", "is empty (write --ease 0.4,0,0.6,1)"), ("boht", "is 'boht' (did you mean 'both'?)"),
                            ("0.4,0,0.6", "has 3 numbers (write --ease 0.4,0,0.6,1)"), ("0.4,0,0.6,x", "is '0.4,0,0.6,x' ("),
                            ("5,0,0.6,1", "is 5 (write a number from 0 to 1)")]:
            self.assertIn("mars: --ease: " + says,
                          self.refused("time", "robot", "--frame", 0, "--ease", typed, code=2))
        self.assertIn("camera, frame 3: has its eye where it looks at",
                      self.refused("pose", "camera", "at=0,0,0", "eye=0,0,0", "--frame", 3))
        self.succeed("mars", "film", "film.json", "light", "add", "place=0,-3,4", "at=0,0,1")
        self.assertIn("frame 3: has its place where it shines at", self.refused("pose", "light/4", "at=0,-3,4", "--frame", 3))
        self.assertIn("looks along its up vector", self.refused("pose", "camera", "eye=0,0,5", "--frame", 3))
        self.assertEqual(self.animate("tyme").returncode, 2)

    def test_films_without_keys_to_change(self):
        self.succeed("mars", "compile", "film.json", "-o", "film.mars")
        for words in [["animate", "film.mars", "list"], ["plot", "film.mars", "-o", "a.png"]]:
            self.assertIn("is compiled: it has matrices, no keys", self.mars(*words).stderr)
        self.assertIn("there is no such file", self.mars("animate", "none.json", "list").stderr)
        rows = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]
        self.write("film.json", film(actors=[{"name": "robot", "model": "arm", "matrices": [
            {"frame": 0, "segments": {"shoulder": rows, "elbow": rows}}]}]))
        self.assertIn("is moved by matrices", self.refused("pose", "robot", "elbow.y=9", "--frame", 3))

    def test_of_changes_at_once_none_is_lost(self):
        self.write("film.json", film(frames=200))
        wishes = [["pose", "robot", "elbow.y=9", "--frame", str(frame)] for frame in range(0, 60, 5)]
        wishes += [["spin", "robot", "--at", str(frame), "--seconds", "0.1"] for frame in range(100, 160, 5)]
        running = [subprocess.Popen([PROGRAMS / "mars", "animate", "film.json", *words], cwd=self.folder,
                                    stdout=subprocess.DEVNULL) for words in wishes]
        self.assertEqual([each.wait(SECONDS) for each in running], [0] * len(running))
        frames = set(self.frames())
        self.assertLessEqual(set(range(0, 60, 5)) | set(range(100, 160, 5)), frames)
        self.assertEqual(sorted(os.listdir(self.folder)), ["film.json"])

    def write_very_many_keys(self):
        turns = [{"frame": frame, "turn": [0, 0, frame % 90]} for frame in range(100000)]
        self.write("film.json", film(frames=1000000, actors=[{"name": "robot", "model": "arm", "keys": turns}]))

    def test_films_of_very_many_keys_and_frames(self):
        self.write_very_many_keys()
        self.assertEqual(len(self.succeed("mars", "animate", "film.json", "list").splitlines()), 100003)

    @needs("gnuplot")
    def test_plot_of_very_many_keys_and_frames(self):
        self.write_very_many_keys()
        self.succeed("mars", "plot", "film.json", "-o", "a.svg")

    def test_examples_are_sound(self):
        for name in ["robot-arm", "teapot", "demo", "bodies"]:
            ended = self.mars("animate", EXAMPLES / f"{name}.json", "check")
            self.assertEqual(ended.returncode, 0, ended.stdout)

    @needs("gnuplot")
    def test_the_page_about_it_holds_what_it_says(self):
        page = (SOURCES / "docs/animating.md").read_text()
        blocks = re.findall(r"^```(\w+)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 8)
        printed = ""
        for kind, text in blocks:
            if kind == "text":
                self.assertEqual(printed, text)
                continue
            path = {**ENVIRONMENT, "PATH": f"{PROGRAMS}:{os.environ['PATH']}"}
            ended = subprocess.run(["bash", "-ec", text], cwd=self.folder, env=path, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self.assertEqual(ended.returncode, 0, ended.stdout)
            printed = ended.stdout
        self.assertTrue((self.folder / "lamp.png").exists())

    @needs("gnuplot")
    def test_plot(self):
        self.changed("pose", "robot", "elbow.y=90", "shoulder.x=20", "--frame", 12)
        self.succeed("mars", "plot", "film.json", "-o", "a.png")
        self.assertEqual((self.folder / "a.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.succeed("mars", "plot", "film.json", "robot", "elbow", "-o", "a.svg")
        picture = (self.folder / "a.svg").read_text()
        self.assertIn("actor 'robot': elbow", picture.replace("&#39;", "'"))
        self.assertNotIn("shoulder", picture)

    def test_plot_without_gnuplot_or_keys(self):
        self.assertIn("has no keys to draw", self.mars("plot", "film.json", "-o", "a.png").stderr)
        self.changed("pose", "robot", "elbow.y=90", "--frame", 12)
        self.assertIn("is neither .png nor .svg", self.mars("plot", "film.json", "-o", "a.jpg").stderr)
        none = self.mars("plot", "film.json", "-o", "a.png", env={"PATH": str(self.folder)})
        self.assertEqual(none.returncode, 1)
        self.assertIn("gnuplot: is not installed (install it, on Debian with: apt install gnuplot-nox)", none.stderr)
        self.assertFalse((self.folder / "a.png").exists())


if __name__ == "__main__":
    main()
