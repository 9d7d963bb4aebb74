"""Random edits of random films (tests/bench/identity): the film's file has the same bytes whether commands edit it one
after the other, or a studio executes the same words on the film in memory, each as a step or all of them in one."""

import json
import random
import subprocess
import sys

from harness import ENVIRONMENT, PROGRAMS, SOURCES, ProgramTest, main
from studio_page import Page

sys.path.insert(0, str(SOURCES / "tests" / "bench" / "identity"))
from random_edits import random_edit  # noqa: E402
from random_film import RandomFilm  # noqa: E402

FILMS = 4
EDITS = 6


class Studio:
    """A studio that has a film open, and its page."""

    def __init__(self, film):
        self.process = subprocess.Popen([PROGRAMS / "mars", "studio", film.name, "--no-browser", "--port", "0", "--nodes", "1"],
                                        cwd=film.parent, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True)
        link = next(line.split()[1] for line in self.process.stdout if line.startswith("Open "))
        self.page = Page(link)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.page.close()
        self.process.terminate()
        self.process.communicate()

    def commit(self, commands):
        """Whether the studio executed the commands."""
        step = {"commands": [[word for word in words if word != "FILM"] for words in commands]}
        self.page.say(do="commit", edit=1, step=step)
        return self.page.hear("done", "refused")["is"] == "done"


class EditsTest(ProgramTest):
    def film(self, seed, name):
        film = RandomFilm(seed)
        path = self.write(f"{name}.json", film.json)
        for words in film.commands:
            self.assertTrue(self.changed_by_command(path, words))
        return path

    def changed_by_command(self, path, words):
        done = subprocess.run([PROGRAMS / "mars", *(path if word == "FILM" else word for word in words)], env=ENVIRONMENT,
                              capture_output=True, text=True)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return done.returncode == 0

    def test_a_studio_edits_films_as_commands_do(self):
        for seed in range(FILMS):
            by_commands, by_steps, at_once = (self.film(seed, f"{name}{seed}") for name in ("commands", "steps", "once"))
            choose, executed = random.Random(seed), []
            with Studio(by_steps) as studio:
                for _ in range(EDITS):
                    words = random_edit(choose, json.loads(by_commands.read_text()))
                    changed = self.changed_by_command(by_commands, words)
                    self.assertEqual(studio.commit([words]), changed, words)
                    self.assertEqual(by_steps.read_bytes(), by_commands.read_bytes(), words)
                    executed += [words] if changed else []
            with Studio(at_once) as studio:
                self.assertTrue(studio.commit(executed), executed)
            self.assertEqual(at_once.read_bytes(), by_commands.read_bytes(), executed)


if __name__ == "__main__":
    main()
