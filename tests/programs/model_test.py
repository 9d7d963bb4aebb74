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
        self.model("new", "dog.json", "body", *BODY)
        self.model("add", "dog.json", "leg", *LEG)
        self.model("add", "dog.json", "paw", "--parent", "leg", "--place", 0, 0, -0.5, "--shape", "sphere",
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
        self.assertEqual(self.model("check", "dog.json"), "dog.json: a model of 3 joints, no warnings\n")
        shown = self.model("show", "dog.json")
        self.assertRegex(shown, r"\n  leg +y -60\.\.60 +- +capsule +\d+ +0\.12 x 0\.12 x 0\.56 +fur\n    paw +fixed ")
        self.assertRegex(shown, r"joints +3 with 4 freedoms\n")

    def test_the_figure_of_the_documentation(self):
        script, text = (SOURCES / "docs/modeling.md").read_text().split("```sh\n")[1].split("```")
        self.write("dog.sh", script)
        env = dict(os.environ, PATH=f"{PROGRAMS}:{os.environ['PATH']}")
        self.assertEqual(self.succeed("sh", "-e", "dog.sh", env=env), "dog.json: a model of 15 joints, no warnings\n")
        lines = [line.split("#")[0].replace("'", "").split() for line in text.splitlines() if line.startswith("    mars model")]
        self.assertGreater(len(lines), 8)
        for words in lines:
            if words[2] == "remove":
                self.refuse(*words[2:], says="joint 'left-hind-leg': carries 'left-hind-paw'")
            else:
                self.succeed(*words)
        self.assertIn("ear-left", self.joints())
        self.assertRegex(self.model("show", "dog.json"), r"at rest .* x 2, z")

    def test_set_changes_anything(self):
        self.dog()
        self.model("set", "dog.json", "leg", "--name", "thigh", "--limits", "x", 0, 10, "--x-axis", 1, 1, 0,
                   "--shape", "cone", "--with", "top=0.5", "--material", "red", "--color", 1, 0, 0)
        thigh = self.joints()["thigh"]
        self.assertEqual(thigh["limits"], {"x": [0, 10], "y": [-60, 60]})
        self.assertEqual(thigh["x_axis"], [1, 1, 0])
        self.assertEqual((thigh["segment"]["shape"], thigh["segment"]["top"]), ("cone", 0.5))
        self.assertEqual(self.joints()["paw"]["parent"], "thigh")
        self.assertIn("skewed, 45 degrees", self.model("show", "dog.json"))
        self.model("set", "dog.json", "thigh", "--reset", "axes", "--reset", "limits", "--place", 0, 0, 0)
        self.assertEqual(set(self.joints()["thigh"]), {"name", "parent", "place", "segment"})
        self.model("set", "dog.json", "--material", "red", "--name", "blue", "--color", 0, 0, 1, "--exponent", 8)
        materials = json.loads((self.folder / "dog.json").read_text())["materials"]
        self.assertEqual(materials["blue"], {"color": [0, 0, 1], "exponent": 8})
        self.assertEqual(self.joints()["thigh"]["segment"]["material"], "blue")

    def test_remove(self):
        self.dog()
        self.refuse("remove", "dog.json", "leg", says="joint 'leg': carries 'paw' (remove them too: --branch")
        self.refuse("remove", "dog.json", "--material", "fur", says="is what 'body', 'leg' are made of")
        self.model("remove", "dog.json", "leg", "--branch")
        self.assertEqual(list(self.joints()), ["body"])
        self.refuse("remove", "dog.json", "body", says="a model has at least one joint")
        self.model("add", "dog.json", "--material", "nose")
        self.model("remove", "dog.json", "--material", "nose")

    def test_scale(self):
        self.dog()
        self.model("scale", "dog.json", 2, "--no-ground")
        self.assertEqual(self.joints()["leg"]["place"], [0.8, 0.2, -0.2])
        self.model("scale", "dog.json", 1, 1, 0.5, "--joint", "l*g", "--no-ground")
        self.assertEqual(self.joints()["leg"]["segment"]["sbb"], [[-0.12, -0.12, -0.5], [0.12, 0.12, 0.06]])
        self.assertEqual(self.joints()["paw"]["place"], [0, 0, -0.5])
        self.model("scale", "dog.json", "--height", 3)
        self.assertRegex(self.model("show", "dog.json"), r"at rest .* x 3, z")
        self.refuse("scale", "dog.json", 2, "--joint", "tail", says="'tail'")
        self.refuse("scale", "dog.json", 1, 2, says="one for all axes, or three", code=2)
        self.refuse("scale", "dog.json", says="or --height", code=2)
        self.refuse("scale", "dog.json", 0, says="FACTOR", code=2)

    def test_a_model_derived_from_another(self):
        self.dog()
        self.model("new", "puppy.json", "--from", "dog.json")
        self.model("scale", "puppy.json", 0.5)
        self.model("scale", "puppy.json", 1.5, "--branch", "leg")
        self.assertEqual(json.loads((self.folder / "puppy.json").read_text()),
                         {"from": "dog.json", "proportions": {"scale": 0.5, "branches": {"leg": 1.5}}})
        self.assertIn("0.09 x 0.09 x 0.42", self.model("show", "puppy.json"))
        self.fail_clearly(1, "model", "set", "puppy.json", "leg", "--fixed", says="has no joints of its own (change dog.json")
        self.model("add", "puppy.json", "--material", "fur", "--color", 0, 0, 0)
        self.assertRegex(self.model("show", "puppy.json"), r"fur +0 0 0")

    def test_materials_of_a_film_are_left_to_it(self):
        self.write("dog.json", {"joints": [{"name": "body", "segment": {"shape": "box", "material": "films"}}]})
        self.model("new", "puppy.json", "--from", "dog.json")
        self.assertIn("films", self.model("show", "puppy.json"))
        self.assertIn("material 'films' is not the model's own", self.model("check", "puppy.json"))
        self.model("add", "dog.json", "tail", "--parent", "body", "--shape", "box", "--material", "films")
        self.refuse("set", "dog.json", "tail", "--material", "film", says="did you mean 'films'?")
        self.write("self.json", {"from": "self.json", "proportions": {}})
        self.fail_clearly(1, "model", "show", "self.json", says="derives the model from itself")

    def test_errors_leave_the_file_as_it_was(self):
        self.dog()
        for words, says in [
                (["new", "dog.json"], "dog.json: is there already"),
                (["add", "dog.json", "leg"], "joint 'leg': is in the model already"),
                (["add", "dog.json", "tail", "--parent", "bdoy"], "did you mean 'body'?"),
                (["add", "dog.json", "tail", "--shape", "spere"], "did you mean 'sphere'?"),
                (["add", "dog.json", "tail", "--shape", "box", "--material", "furr"], "did you mean 'fur'?"),
                (["add", "dog.json", "tail", "--shape", "box", "--with", "top=1"], "which has no 'top'"),
                (["add", "dog.json", "tail", "--shape", "cone", "--with", "top"], "write it like top=0.5"),
                (["add", "dog.json", "tail", "--shape", "cone", "--with", "top=2"], "write a number from 0 to 1"),
                (["add", "dog.json", "a/b"], "use '-' or '_' instead"),
                (["add", "dog.json"], "no joint and no material is named"),
                (["add", "dog.json", "--place", 0, 0, 0, "--material", "fur"], "no joint is named"),
                (["add", "dog.json", "tail", "--color", 1, 0, 0], "no material is named"),
                (["add", "dog.json", "--material", "fur", "--color", 1, 0, 0], "material 'fur': is in the model already"),
                (["set", "dog.json", "leg", "--color", 1, 0, 0, "--material", "fur", "--limits", "y", 5, 1], "lower one first"),
                (["set", "dog.json", "lge", "--fixed"], "did you mean 'leg'?"),
                (["set", "dog.json", "leg", "--parent", "paw"], "own ancestor"),
                (["set", "dog.json", "leg", "--y-axis", 2, 0, 0], "parallel x and y axes"),
                (["set", "dog.json", "leg", "--name", "paw"], "joint 'paw': is in the model already"),
                (["set", "dog.json", "leg", "--sbb", 0, 0, 0, 1, 1, 0], "without extent along z"),
                (["set", "dog.json", "leg", "--fixed", "--free"], "both fixed and free"),
                (["set", "dog.json", "--material", "fru", "--color", 1, 0, 0], "did you mean 'fur'?"),
                (["set", "dog.json", "--material", "fur", "--color", 1, 0, 2], "is 2"),
                (["remove", "dog.json", "tail"], "joint 'tail': is not in the model"),
                (["remove", "dog.json", "--material", "nose"], "material 'nose': is not in the model"),
        ]:
            self.refuse(*words, says=says)
        for words, says in [(["set", "dog.json", "leg", "--limits", "q", 0, 1], "'q' is no axis"),
                            (["set", "dog.json", "leg", "--limits", "y"],
                             "--limits: write x|y|z LOWER UPPER, as in --limits y -30 60"),
                            (["set", "dog.json", "--material", "fur", "--color", 1],
                             "--color: write R G B, as in --color 0.6 0.4 0.2"),
                            (["set", "dog.json", "leg", "--place", 0, 1], "--place: write X Y Z, as in"),
                            (["set", "dog.json", "leg", "--reset", "plcae"], "plcae"),
                            (["set", "dog.json", "leg", "--plcae", 0, 1, 0], "did you mean '--place'?"),
                            (["add"], "MODEL is required")]:
            self.refuse(*words, says=says, code=2)

    def test_files_that_are_no_models(self):
        self.fail_clearly(1, "model", "show", EXAMPLES / "demo.json", says="is a film, not a model (put the model into")
        self.fail_clearly(1, "model", "show", "no.json", says="no.json: there is no such file")
        self.write("half.json", '{"joints": [')
        for verb in ["show", "check", "add", "remove", "set"]:
            joint = ["leg"] if verb in ("add", "remove", "set") else []
            self.fail_clearly(1, "model", verb, "half.json", *joint, says="half.json:1")
        self.assertEqual((self.folder / "half.json").read_text(), '{"joints": [')
        self.fail_clearly(1, "model", "new", "no/where/dog.json", says="cannot write")

    def test_edits_at_the_same_time_are_all_done(self):
        self.dog()
        edits = [subprocess.Popen([PROGRAMS / "mars", "model", "add", "dog.json", f"toe-{i}", "--parent", "paw"],
                                  cwd=self.folder) for i in range(20)]
        self.assertEqual([edit.wait() for edit in edits], [0] * 20)
        self.assertEqual(len(self.joints()), 23)

    def test_a_killed_edit_leaves_the_file_whole(self):
        self.dog()
        model = json.loads((self.folder / "dog.json").read_text())
        model["joints"] += [{"name": f"hair-{i}", "parent": "body", "segment": {"shape": "box"}} for i in range(20000)]
        self.write("dog.json", model)
        self.model("set", "dog.json", "leg", "--place", 0, 0, 0)
        for delay in range(12):
            edit = subprocess.Popen([PROGRAMS / "mars", "model", "set", "dog.json", "leg", "--place", "0", "0", str(delay + 1)],
                                    cwd=self.folder, stderr=subprocess.DEVNULL)
            time.sleep(0.01 * delay)
            edit.kill()
            edit.wait()
            self.assertEqual(len(self.joints()), 20003)
        self.model("set", "dog.json", "leg", "--place", 7, 7, 7)
        self.assertEqual(self.joints()["leg"]["place"], [7, 7, 7])

    def test_check_prints_what_is_probably_not_meant(self):
        self.dog()
        self.model("set", "dog.json", "leg", "--place", 3, 0, 0)
        printed = self.model("check", "dog.json")
        self.assertIn("dog.json: joint 'leg' has its segment 2.34 away from that of 'body'", printed)
        self.assertIn("a model of 3 joints, 1 warning\n", printed)


if __name__ == "__main__":
    main()
