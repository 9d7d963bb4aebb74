"""The tutorial's film is made in mars studio in a headless Chromium, by mouse and keyboard alone: it is, byte for byte, the
film that the tutorial's commands make."""

import re
import subprocess

from harness import *
from studio_browser import CTRL, PATIENCE, SHIFT
from studio_browser_test import StudioInBrowser

TUTORIAL = (SOURCES / "docs" / "tutorial.md").read_text()
MARGIN = 18  # pixels of the ruler beside the film


def commands_of(title):
    """A section's commands that make or change files, a line each."""
    section = TUTORIAL.partition(f"\n## {title}\n")[2].partition("\n## ")[0]
    lines = "".join(re.findall(r"```sh\n(.*?)```", section, re.S)).replace("\\\n", "").splitlines()
    return [line for line in lines if not re.match(r"mars (preview|model (set|check))|.*(list|check)\b", line)]


class TutorialsFilmTest(StudioInBrowser):
    """docs/tutorial.md, sections 2 to 4."""

    def make_by_commands(self):
        """What the film is to be; and its models, beside the film that the page makes."""
        self.by_commands, self.by_hand = (self.folder / name for name in ("commands", "hand"))
        self.by_commands.mkdir()
        lines = [line for title in ("1. A figure", "2. A film", "3. The figure walks, turns, waves and sits", "4. Keys by hand")
                 for line in commands_of(title)]
        made = subprocess.run(["sh", "-ec", "\n".join(lines)], cwd=self.by_commands, capture_output=True, text=True, timeout=SECONDS,
                              env=dict(ENVIRONMENT, PATH=f"{PROGRAMS}:{os.environ['PATH']}"))
        self.assertEqual(made.returncode, 0, made.stderr)
        self.by_hand.mkdir()
        for model in ("pip.json", "room.json"):
            shutil.copy(self.by_commands / model, self.by_hand / model)
        self.file = self.by_hand / "film.json"

    # ---- hands

    def fill(self, key, text):
        """A field that changes nothing by itself."""
        self.type(f'[data-key="{key}"]', text)

    def go_to(self, frame):
        self.type('[data-key="frame"]', str(frame), enter=True)
        self.until(f"frame {frame}", f"window.seen.project.frame === {frame}")

    def add_actor(self, model):
        self.fill("cast.model", model)
        self.changed_by(lambda: self.click('[data-key="cast.add"]'))

    def select_actor(self, name):
        self.click(f'#tree [data-key="{name}"] > .row')
        self.until(f"{name} selected", f"document.querySelector('#tree [data-key=\"{name}\"]').ariaSelected === 'true'")

    def write_vector(self, key, *numbers):
        for axis, number in zip("xyz", numbers):
            self.write(f"{key}.{axis}", number)

    def motion(self, name, end, **fields):
        """The page's motion, from the actor's last key to the frame `end`."""
        self.click(f"[data-motion={name}]")
        for field, value in fields.items():
            self.fill_motion(f"motion.{field.replace('_', '-')}", value)
        self.changed_by(lambda: self.click('[data-key="motion.apply"]'))
        self.until(f"{name} to {end}", f"window.seen.project.frames === {end + 1}")

    def fill_motion(self, key, value):
        if isinstance(value, str):
            return self.pick(f'[data-key="{key}"]', value)
        for at, number in enumerate(value if isinstance(value, list) else [value]):
            self.fill(f"{key}{at or ''}", f"{number:g}")

    def turn(self, joint, angle):
        """By the number beside the slider about z."""
        self.click(f'#tree [data-key="pip/{joint}"] > .row')
        self.until(f"{joint} selected", f"document.querySelector('[data-key=name]')?.value === '{joint}'")
        self.write("pose.z.number", angle)

    # ---- the timeline

    def select_rows(self, first, *others):
        if self.browser.run("return document.querySelector('[data-row=pip]').ariaExpanded") == "false":
            self.click("[data-row=pip] .twist")
        self.click(f'[data-row="pip {first}"] .name')
        for other in others:
            self.click(f'[data-row="pip {other}"] .name', keys=CTRL)

    def key_at(self, part, frame):
        """Where a key of a part that shows is in the sheet."""
        self.browser.settle()
        ruler, row, frames = self.browser.run("""
            const [ruler, row] = ['.ruler', arguments[0]].map((each) => document.querySelector(each).getBoundingClientRect());
            return [ruler.toJSON(), row.toJSON(), window.seen.project.frames];""", f'[data-row="pip {part}"]')
        return ruler["x"] + MARGIN + frame * (ruler["width"] - 2 * MARGIN) / (frames - 1), row["y"] + row["height"] / 2

    def pick_keys_of(self, *parts, frame=267):
        for number, part in enumerate(parts):
            self.browser.click(*self.key_at(part, frame), keys=SHIFT if number else 0)

    # ---- what is taken back

    def file_becomes(self, text):
        wait_until(lambda: self.file.read_text() == text, PATIENCE, "the file's text")

    def file_changed_by(self, act):
        before = self.file.read_text()
        act()
        wait_until(lambda: self.file.read_text() != before, PATIENCE, "a change of the file")

    def undone(self, act, steps):
        """Undo and redo take away and bring back, by the keyboard, what `act` changes; it is left undone."""
        before = self.file.read_text()
        act()
        changed = self.file.read_text()
        for text, key, held in ((before, "z", CTRL), (changed, "Z", CTRL | SHIFT), (before, "z", CTRL)):
            for _ in range(steps):
                self.keys(key, modifiers=held)
            self.file_becomes(text)

    def drag_key(self):
        self.pick_keys_of("head", frame=285)
        self.file_changed_by(lambda: self.browser.drag(self.key_at("head", 285), self.key_at("head", 276)))
        self.assertEqual([key["frame"] for key in self.pip()["keys"]][-3:], [267, 276, 285])

    def flatten_slope(self):
        """The curve goes on from its key at frame 267 as a spline that rests there."""
        self.pick_keys_of("neck")
        self.keys("e", "e")
        self.file_changed_by(lambda: self.choose_entry("Spline"))
        self.file_changed_by(lambda: self.click('[data-key="key.flat"]'))
        self.assertIn('"out": [0, 0, 0]', self.file.read_text())

    def pip(self):
        return json.loads(self.file.read_text())["actors"][1]

    def ghosts_show(self):
        shown = "document.querySelectorAll('.view .handle.ghost').length"
        self.assertEqual(self.browser.run(f"return {shown}"), 0)
        self.browser.run("document.querySelector('[data-key=view-0]').focus()")
        self.keys("a")
        self.keys("o")
        self.until("ghosts", f"{shown} > 0")
        self.keys("o")
        self.until("no ghosts", f"{shown} === 0")

    # ---- the tutorial

    def begin_film(self):
        self.tab("Scene")
        self.write("film.frames", 1.0)
        for model in ("room.json", "pip.json"):
            self.add_actor(model)
        self.select_actor("floor")  # that a new film of the studio has
        self.changed_by(lambda: self.click('[data-key="actor.remove"]'))
        self.select_actor("pip")
        self.write_vector("actor.place", 1.7, -2.2, 0.0)
        self.write_vector("actor.turn", 0.0, 0.0, 90.0)
        self.write_vector("camera.at", 1.4, -0.8, 0.85)
        self.write_vector("camera.eye", 6.2, -2.6, 1.6)

    def move_figure(self):
        self.tab("Motions")
        self.motion("walk", 82, to=[1.7, 0])
        self.motion("turn", 140, by=-90)
        self.motion("wave", 200, hand="right")
        self.motion("sit", 238, seat_height=0.35)
        self.motion("nod", 267)

    def keys_by_hand(self):
        self.go_to(267)
        self.select_rows("head", "neck")
        self.changed_by(lambda: self.keys("i", "i"))
        self.pick_keys_of("head", "neck")
        self.keys("e", "e")
        self.changed_by(lambda: self.choose_entry("Begin and end slowly"))
        self.tab("Scene")
        self.write("film.frames", 286.0)
        self.go_to(285)
        self.tab("Joint")
        self.turn("head", -45.0)
        self.turn("neck", -60.0)  # beyond its limit

    def test_film(self):
        self.make_by_commands()
        studio = self.start(self.file, "--film")
        self.begin_film()
        self.move_figure()
        self.keys_by_hand()
        self.file_becomes((self.by_commands / "film.json").read_text())
        self.ghosts_show()
        self.undone(self.drag_key, steps=1)
        self.undone(self.flatten_slope, steps=2)
        self.no_complaint()
        self.assertEqual(studio.end(), (0, ""))


if __name__ == "__main__":
    main()
