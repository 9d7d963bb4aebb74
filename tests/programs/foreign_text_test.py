"""What messages repeat of arguments, files and the environment cannot act on the terminal that shows them."""

import json
import re

from harness import EXAMPLES, ENVIRONMENT, ProgramTest, main

# A cleared screen, a colour by a C1 character, a reversed ending, DEL, a byte that is no UTF-8.
NASTY = "a\x1b[2J\x9b31m\u202egnp.\u2066\x7f\r\udcff"
ACTS = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")


class ForeignText(ProgramTest):
    def assertPlain(self, done, shows=True):
        for stream in (done.stdout, done.stderr):
            text = stream.decode()  # UTF-8 throughout
            self.assertIsNone(ACTS.search(text), (done.args, text))
        if shows:
            self.assertIn(r"a\u001b[2J\u009b31m\u202egnp.\u2066\u007f\u000d\xff", (done.stdout + done.stderr).decode())

    def mars(self, *words, **more):
        return self.run_program("mars", *words, text=False, **more)

    def film(self, name="film.json", **changes):
        film = json.loads((EXAMPLES / "teapot.json").read_text())
        film.update(changes)
        return self.write(name, film)

    def test_arguments(self):
        film = EXAMPLES / "teapot.json"
        for words in [[NASTY], [f"--{NASTY}"], ["info", NASTY], ["render", film, "-o", "out", f"--{NASTY}"],
                      ["render", film, "-o", "out", "--nodes", NASTY],
                      ["render", NASTY, "-o", "out", "--backend", "threads"],
                      ["render", film, "-o", "out", "--backend", NASTY], ["plan", film, "--platform", NASTY],
                      ["compile", film, "-o", f"{NASTY}/x.mars"], ["verify", NASTY], ["status", NASTY],
                      ["animate", film, NASTY], ["animate", film, "list", NASTY], ["film", film, "remove", NASTY],
                      ["preview", NASTY], ["play", NASTY], ["plot", film, NASTY, "-o", "x.png"],
                      ["import", NASTY, "-o", "x.json"], ["model", NASTY, "show"], ["bench", NASTY]]:
            with self.subTest(words=words):
                done = self.mars(*words)
                self.assertNotEqual(done.returncode, 0)
                self.assertPlain(done)

    def test_names_of_files_and_folders(self):
        film, model = self.film(f"{NASTY}.json"), self.folder / f"{NASTY}-model.json"
        self.assertPlain(self.mars("model", model, "new", "hip", "--shape", "box"), shows=False)
        for words in [["info", film], ["animate", film, "list"], ["animate", film, "check"], ["model", model, "check"],
                      ["render", film, "-o", NASTY, "--size", "16x9", "--frames", "0", "--backend", "threads"],
                      ["verify", NASTY], ["status", NASTY], ["verify", NASTY, "--missing"]]:
            with self.subTest(words=words):
                done = self.mars(*words)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertPlain(done, shows=False)

    def test_names_in_films(self):
        name = "a\u009b31m\u202egnp."  # documents refuse others
        film = self.film()
        text = film.read_text()
        actor = json.loads(text)["actors"][0]["name"]
        film.write_text(text.replace(json.dumps(actor), json.dumps(name)))
        for words in [["info", film], ["animate", film, "list"], ["film", film, "show"], ["film", film, "remove", "x"]]:
            with self.subTest(words=words):
                done = self.mars(*words)
                self.assertPlain(done, shows=False)
                if words[0] != "info":
                    self.assertIn(r"a\u009b31m\u202egnp.", (done.stdout + done.stderr).decode())

    def test_json_for_programs_is_exact(self):
        self.film(f"{NASTY}.json")
        done = self.run_program("mars-threads", f"{NASTY}.json", "-o", "a\u009b\u202e", "--size", "16x9", "--frames",
                                "0", text=False)
        self.assertPlain(done, shows=False)
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertIn("a\u009b\u202e", [event.get("folder") for event in events])

    def test_the_environment(self):
        done = self.mars("render", EXAMPLES / "teapot.json", "-o", "out", "--backend", "threads",
                         env=dict(ENVIRONMENT, MARS_SIMD=NASTY))
        self.assertEqual(done.returncode, 1)
        self.assertPlain(done)


if __name__ == "__main__":
    main()
