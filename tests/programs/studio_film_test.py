"""The tutorial's film is made in mars studio in a headless Chromium, by mouse and keyboard alone: it is, byte for byte, the
film that the tutorial's commands make."""

import re
import subprocess

from selenium.webdriver.support.ui import Select

from harness import *
from studio_browser import CTRL, SHIFT
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
        self.click(f'[data-key="{key}"]')
        self.browser.run("document.activeElement.select()")
        self.browser.command("Input.insertText", text=text)

    def go_to(self, frame):
        self.fill("frame", str(frame))
        self.enter()
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
        self.browser.run("document.activeElement.blur()")
        Select(self.browser.driver.find_element("css selector", '[data-key="motion.start"]')).select_by_value("last")
        for field, value in fields.items():
            self.fill_motion(f"motion.{field.replace('_', '-')}", value)
        self.changed_by(lambda: self.click('[data-key="motion.apply"]'))
        self.until(f"{name} to {end}", f"window.seen.project.frames === {end + 1}")

    def fill_motion(self, key, value):
        if isinstance(value, str):
            Select(self.browser.driver.find_element("css selector", f'[data-key="{key}"]')).select_by_value(value)
            return
        for at, number in enumerate(value if isinstance(value, list) else [value]):
            self.fill(f"{key}{at or ''}", f"{number:g}")

    # ---- the tutorial

    def begin_film(self):
        self.tab("Scene")
        self.write("film.frames", 1.0)
        for model in ("room.json", "pip.json"):
            self.add_actor(model)
        self.select_actor("pip")
        self.write_vector("actor.place", 1.7, -2.2, 0.0)
        self.write_vector("actor.turn", 0.0, 0.0, 90.0)
        self.write_vector("camera.eye", 6.2, -2.6, 1.6)
        self.write_vector("camera.at", 1.4, -0.8, 0.85)

    def move_figure(self):
        self.tab("Motions")
        self.motion("walk", 82, to=[1.7, 0])
        self.motion("turn", 140, by=-90)
        self.motion("wave", 200, hand="right")
        self.motion("sit", 238, seat_height=0.35)
        self.motion("nod", 267)

    def test_film(self):
        self.make_by_commands()
        studio = self.start(self.file, "--film")
        self.begin_film()
        self.move_figure()


if __name__ == "__main__":
    main()
