"""mars model: every command, its errors, and that a file is changed whole or not at all."""

import json
import os
import subprocess
import time

from harness import EXAMPLES, PROGRAMS, SOURCES, ProgramTest, main

BODY = ["--shape", "sphere", "--sbb", -0.6, -0.2, -0.2, 0.6, 0.2, 0.2, "--material", "fur", "--color", 0.6, 0.4, 0.2]
LEG = ["--parent", "body", "--place", 0.4, 0.1, -0.1, "--shape", "capsule", "--sbb", -0.06, -0.06, -0.5, 0.06, 0.06, 0.06,
       "--limits", "y", -60, 60, "--material", "fur"]


class Model(ProgramTest):
    def model(self, *words):
        return self.succeed("mars", "model", *words)

    def joints(self, name="dog.json"):
        joints = json.loads((self.folder / name).read_text())["joints"]
        return {joint["name"]: joint for joint in joints}

    def dog(self):
        self.model("dog.json", "new", "body", *BODY)
        self.model("dog.json", "add", "leg", *LEG)
        self.model("dog.json", "add", "paw", "--parent", "leg", "--place", 0, 0, -0.5, "--shape", "sphere",
                   "--sbb", -0.05, -0.05, -0.05, 0.1, 0.05, 0.05, "--fixed")

    def refuse(self, *words, says, code=1):
        """A command that must fail with one clear message, and leave the file as it was."""
        before = (self.folder / "dog.json").read_bytes()
        self.fail_clearly(code, "model", *words, says=says)
        self.assertEqual((self.folder / "dog.json").read_bytes(), before)
        self.assertEqual([path.name for path in self.folder.iterdir() if path.suffix == ".part"], [])

    def test_a_figure_from_nothing_renders(self):
        self.dog()
        film = {"frames": 1, "size": [64, 64], "camera": {"eye": [0, -3, 0], "at": [0, 0, -0.2]},
                "models": {"dog": "dog.json"}, "actors": [{"name": "dog", "model": "dog", "pose": {"leg": [0, 60, 0]}}]}
        self.succeed("mars", "render", self.write("film.json", film), "-o", "out", "--backend", "threads")
        self.assertEqual(self.model("dog.json", "check"), "dog.json: a model of 3 joints, no warnings\n")
        shown = self.model("dog.json", "show")
        self.assertRegex(shown, r"\n  leg +y -60\.\.60 +- +capsule +\d+ +0\.12 x 0\.12 x 0\.56 +fur\n    paw +fixed ")
        self.assertRegex(shown, r"joints +3 with 4 freedoms\n")

    def test_the_order_of_former_versions_is_understood(self):
        self.dog()
        done = subprocess.run([PROGRAMS / "mars", "model", "show", "dog.json"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.stderr, "mars: the model comes first now: mars model dog.json show\n")
        self.assertEqual(done.stdout, self.model("dog.json", "show"))

    def test_what_the_studio_does_a_command_does(self):
        self.model("man.json", "new", "--figure", "man", "--height", 5)
        self.assertRegex(self.model("man.json", "show"), r"at rest .* x 5, z")
        self.model("man.json", "new", "--figure", "dog", "--replace")
        self.assertIn("left-fore-paw", self.model("man.json", "show"))
        self.dog()
        self.assertIn("the model's own now: 'leg-shape'", self.remarked("dog.json", "point", "leg", "--at", 1, 1, "--to", 0.5, 0.2, 1))
        self.fail_clearly(1, "model", "dog.json", "point", "leg", "--at", 1, 1, "--to", 0.5, 0.2, 1.4,
                          says="leg': has a point at 1.4 of its box (write numbers from 0 to 1; to make the box larger, change its sbb)")
        self.assertIn("leg-shape", json.loads((self.folder / "dog.json").read_text())["shapes"])
        self.assertIn("added as in a mirror: right-leg", self.remarked("dog.json", "mirror", "left", "leg"))
        self.assertEqual(self.joints()["right-leg"]["place"], [0.4, -0.1, -0.1])

    def remarked(self, *words):
        done = subprocess.run([PROGRAMS / "mars", "model", *map(str, words)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def test_the_figure_of_the_documentation(self):
        script, text = (SOURCES / "docs/modeling.md").read_text().split("```sh\n")[1].split("```")
        self.write("dog.sh", script)
        env = dict(os.environ, PATH=f"{PROGRAMS}:{os.environ['PATH']}")
        self.assertEqual(self.succeed("sh", "-e", "dog.sh", env=env), "dog.json: a model of 15 joints, no warnings\n")
        lines = [line.split("#")[0].replace("'", "").split() for line in text.splitlines() if line.startswith("    mars model")]
        self.assertGreater(len(lines), 8)
        for words in lines:
            if words[3] == "remove":
                self.refuse(*words[2:], says="joint 'left-hind-leg': carries 'left-hind-paw'")
            else:
                self.succeed(*words)
        self.assertIn("ear-left", self.joints())
        self.assertRegex(self.model("dog.json", "show"), r"at rest .* x 2, z")

    def test_set_changes_anything(self):
        self.dog()
        self.model("dog.json", "set", "leg", "--name", "thigh", "--limits", "x", 0, 10, "--x-axis", 1, 1, 0,
                   "--shape", "cone", "--with", "top=0.5", "--material", "red", "--color", 1, 0, 0)
        thigh = self.joints()["thigh"]
        self.assertEqual(thigh["limits"], {"x": [0, 10], "y": [-60, 60]})
        self.assertEqual(thigh["x_axis"], [1, 1, 0])
        self.assertEqual((thigh["segment"]["shape"], thigh["segment"]["top"]), ("cone", 0.5))
        self.assertEqual(self.joints()["paw"]["parent"], "thigh")
        self.assertIn("skewed, 45 degrees", self.model("dog.json", "show"))
        self.model("dog.json", "set", "thigh", "--reset", "axes", "--reset", "limits", "--place", 0, 0, 0)
        self.assertEqual(set(self.joints()["thigh"]), {"name", "parent", "place", "segment"})
        self.model("dog.json", "set", "--place", 0, 0, 0.25, "thigh")  # in the order of the help's first line
        self.assertEqual(self.joints()["thigh"]["place"], [0, 0, 0.25])
        self.model("dog.json", "set", "--material", "red", "--name", "blue", "--color", 0, 0, 1, "--exponent", 8)
        materials = json.loads((self.folder / "dog.json").read_text())["materials"]
        self.assertEqual(materials["blue"], {"color": [0, 0, 1], "exponent": 8})
        self.assertEqual(self.joints()["thigh"]["segment"]["material"], "blue")

    def test_keys_are_printed_from_their_table(self):
        self.assertRegex(self.succeed("mars", "keys"), r"Of a model: model, joint, .*, shape\n")
        self.assertRegex(self.succeed("mars", "keys", "shape"), r"\n  ends +of a capsule: .* \(0.001 to 0.5\); default: 0.25\n")

    def test_remove(self):
        self.dog()
        self.refuse("dog.json", "remove", "leg", says="joint 'leg': carries 'paw' (remove them too: --branch")
        self.refuse("dog.json", "remove", "--material", "fur", says="is what 'body', 'leg' are made of")
        self.model("dog.json", "remove", "leg", "--branch")
        self.assertEqual(list(self.joints()), ["body"])
        self.refuse("dog.json", "remove", "body", says="a model has at least one joint")
        self.model("dog.json", "add", "--material", "nose")
        self.model("dog.json", "remove", "--material", "nose")

    def test_scale(self):
        self.dog()
        self.model("dog.json", "scale", 2, "--no-ground")
        self.assertEqual(self.joints()["leg"]["place"], [0.8, 0.2, -0.2])
        self.model("dog.json", "scale", 1, 1, 0.5, "--joint", "l*g", "--no-ground")
        self.assertEqual(self.joints()["leg"]["segment"]["sbb"], [[-0.12, -0.12, -0.5], [0.12, 0.12, 0.06]])
        self.assertEqual(self.joints()["paw"]["place"], [0, 0, -0.5])
        self.model("dog.json", "scale", "--height", 3)
        self.assertRegex(self.model("dog.json", "show"), r"at rest .* x 3, z")
        self.refuse("dog.json", "scale", 2, "--joint", "tail", says="'tail'")
        self.refuse("dog.json", "scale", 1, 2, says="one for all axes, or three", code=2)
        self.refuse("dog.json", "scale", says="or --height", code=2)
        self.refuse("dog.json", "scale", 0, says="FACTOR", code=2)

    def test_a_model_derived_from_another(self):
        self.dog()
        self.model("puppy.json", "new", "--from", "dog.json")
        self.model("puppy.json", "scale", 0.5)
        self.model("puppy.json", "scale", 1.5, "--branch", "leg")
        self.assertEqual(json.loads((self.folder / "puppy.json").read_text()),
                         {"from": "dog.json", "proportions": {"scale": 0.5, "branches": {"leg": 1.5}}})
        self.assertIn("0.09 x 0.09 x 0.42", self.model("puppy.json", "show"))
        self.fail_clearly(1, "model", "puppy.json", "set", "leg", "--fixed", says="has no joints of its own (change dog.json")
        self.model("puppy.json", "add", "--material", "fur", "--color", 0, 0, 0)
        self.assertRegex(self.model("puppy.json", "show"), r"fur +0 0 0")

    def test_materials_of_a_film_are_left_to_it(self):
        self.write("dog.json", {"joints": [{"name": "body", "segment": {"shape": "box", "material": "films"}}]})
        self.model("puppy.json", "new", "--from", "dog.json")
        self.assertIn("films", self.model("puppy.json", "show"))
        self.assertIn("material 'films' is not the model's own", self.model("puppy.json", "check"))
        self.model("dog.json", "add", "tail", "--parent", "body", "--shape", "box", "--material", "films")
        self.refuse("dog.json", "set", "tail", "--material", "film", says="did you mean 'films'?")
        self.write("self.json", {"from": "self.json", "proportions": {}})
        self.fail_clearly(1, "model", "self.json", "show", says="derives the model from itself")

    def test_errors_leave_the_file_as_it_was(self):
        self.dog()
        for words, says in [
                (["dog.json", "new"], "dog.json: is there already"),
                (["dog.json", "add", "leg"], "joint 'leg': is in the model already"),
                (["dog.json", "add", "tail", "--parent", "bdoy"], "did you mean 'body'?"),
                (["dog.json", "add", "tail", "--shape", "spere"], "did you mean 'sphere'?"),
                (["dog.json", "add", "tail", "--shape", "box", "--material", "furr"], "did you mean 'fur'?"),
                (["dog.json", "add", "tail", "--shape", "box", "--with", "top=1"], "belongs to the shape cone, not to box"),
                (["dog.json", "add", "tail", "--shape", "cone", "--with", "top"], "write it like top=0.5"),
                (["dog.json", "add", "tail", "--shape", "cone", "--with", "top=2"], "write a number from 0 to 1"),
                (["dog.json", "add", "a/b"], "use '-' or '_' instead"),
                (["dog.json", "add"], "no joint and no material is named"),
                (["dog.json", "add", "--place", 0, 0, 0, "--material", "fur"], "no joint is named"),
                (["dog.json", "add", "tail", "--color", 1, 0, 0], "no material is named"),
                (["dog.json", "add", "--material", "fur", "--color", 1, 0, 0], "material 'fur': is in the model already"),
                (["dog.json", "set", "leg", "--color", 1, 0, 0, "--material", "fur", "--limits", "y", 5, 1], "write the lower first"),
                (["dog.json", "set", "lge", "--fixed"], "did you mean 'leg'?"),
                (["dog.json", "set", "leg", "--parent", "paw"], "own ancestor"),
                (["dog.json", "set", "leg", "--y-axis", 2, 0, 0], "parallel x and y axes"),
                (["dog.json", "set", "leg", "--name", "paw"], "joint 'paw': is in the model already"),
                (["dog.json", "set", "leg", "--sbb", 0, 0, 0, 1, 1, 0], "no extent along z"),
                (["dog.json", "set", "leg", "--fixed", "--free"], "both fixed and free"),
                (["dog.json", "set", "--material", "fru", "--color", 1, 0, 0], "did you mean 'fur'?"),
                (["dog.json", "set", "--material", "fur", "--color", 1, 0, 2], "is 2"),
                (["dog.json", "remove", "tail"], "joint 'tail': is not in the model"),
                (["dog.json", "remove", "--material", "nose"], "material 'nose': is not in the model"),
        ]:
            self.refuse(*words, says=says)
        for words, says in [(["dog.json", "set", "leg", "--limits", "q", 0, 1], "'q' is no axis"),
                            (["dog.json", "set", "leg", "--limits", "y"],
                             "--limits: write x|y|z LOWER UPPER, as in --limits y -30 60"),
                            (["dog.json", "set", "--material", "fur", "--color", 1],
                             "--color: write R G B, as in --color 0.8 0.4 0.2"),
                            (["dog.json", "set", "leg", "--place", 0, 1], "--place: write X Y Z, as in"),
                            (["dog.json", "set", "leg", "--place", 5, 6, ""], "--place: is empty"),
                            (["dog.json", "set", "leg", "--reset", "plcae"], "plcae"),
                            (["dog.json", "set", "leg", "--plcae", 0, 1, 0], "did you mean '--place'?"),
                            (["add"], "'add' comes later: write mars model MODEL add")]:
            self.refuse(*words, says=says, code=2)

    def test_files_that_are_no_models(self):
        self.fail_clearly(1, "model", EXAMPLES / "demo.json", "show", says="is a film, not a model (put the model into")
        self.fail_clearly(1, "model", "no.json", "show", says="no.json: there is no such file")
        self.write("half.json", '{"joints": [')
        for verb in ["show", "check", "add", "remove", "set"]:
            joint = ["leg"] if verb in ("add", "remove", "set") else []
            self.fail_clearly(1, "model", "half.json", verb, *joint, says="half.json:1")
        self.assertEqual((self.folder / "half.json").read_text(), '{"joints": [')
        self.fail_clearly(1, "model", "no/where/dog.json", "new", says="cannot write")

    def test_edits_at_the_same_time_are_all_done(self):
        self.dog()
        edits = [subprocess.Popen([PROGRAMS / "mars", "model", "dog.json", "add", f"toe-{i}", "--parent", "paw"],
                                  cwd=self.folder) for i in range(20)]
        self.assertEqual([edit.wait() for edit in edits], [0] * 20)
        self.assertEqual(len(self.joints()), 23)

    def test_a_killed_edit_leaves_the_file_whole(self):
        self.dog()
        model = json.loads((self.folder / "dog.json").read_text())
        model["joints"] += [{"name": f"hair-{i}", "parent": "body", "segment": {"shape": "box"}} for i in range(20000)]
        self.write("dog.json", model)
        self.model("dog.json", "set", "leg", "--place", 0, 0, 0)
        for delay in range(12):
            edit = subprocess.Popen([PROGRAMS / "mars", "model", "dog.json", "set", "leg", "--place", "0", "0", str(delay + 1)],
                                    cwd=self.folder, stderr=subprocess.DEVNULL)
            time.sleep(0.01 * delay)
            edit.kill()
            edit.wait()
            self.assertEqual(len(self.joints()), 20003)
        self.model("dog.json", "set", "leg", "--place", 7, 7, 7)
        self.assertEqual(self.joints()["leg"]["place"], [7, 7, 7])

    def test_check_prints_what_is_probably_not_meant(self):
        self.dog()
        self.model("dog.json", "set", "leg", "--place", 3, 0, 0)
        printed = self.model("dog.json", "check")
        self.assertIn("dog.json: joint 'leg' has its segment 2.34 away from that of 'body'", printed)
        self.assertIn("a model of 3 joints, 1 warning\n", printed)


if __name__ == "__main__":
    main()
