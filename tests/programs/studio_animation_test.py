"""The animation screen of mars studio in a headless Chromium, by mouse and keyboard: keys, curves, motions, scripts. After
each step the film's file is what the commands make of it that the screen shows."""

import json
import subprocess

from harness import *
from studio_browser import CTRL, SHIFT
from studio_browser_test import StudioInBrowser

FILM = {
    "frames": 60, "size": [320, 180], "camera": {"eye": [5, -2, 1.6], "at": [0, 0, 0.9], "fov": 30},
    "models": {"human": "human.json"},
    "actors": [{"name": "tom", "model": "human", "keys": [
        {"frame": 0, "pose": {"head": [0, 0, 0], "left-shin": [0, 0, 0]}},
        {"frame": 20, "pose": {"head": [0, 0, 30], "left-shin": [0, 40, 0]}},
        {"frame": 40, "pose": {"head": [0, 0, 0]}},
        {"frame": 50, "pose": {"left-shin": [0, 0, 0]}}]}],
}
MARGIN = 18  # pixels of the ruler beside the film


class AnimationTest(StudioInBrowser):
    def begin(self):
        """The film, opened, and its like, which the shown commands change."""
        self.film, self.like = (self.folder / name for name in ("film.json", "like.json"))
        for path in (self.film, self.like):
            path.write_text(json.dumps(FILM))
        shutil.copy(EXAMPLES / "models" / "human.json", self.folder / "human.json")
        self.done = 0
        self.start(self.film)
        self.until("rows of keys", "document.querySelector('[data-row=tom]') !== null")

    def shown_commands(self):
        self.click("#frames .commands")
        lines = self.browser.run("return [...document.querySelectorAll('.command-lines code')].map((each) => each.textContent)")
        self.click("h1")
        self.until("no list of commands", "document.querySelector('.popover') === null")
        return lines

    def same_as_commands(self, *expected):
        lines = self.shown_commands()
        new, self.done = lines[self.done:], len(lines)
        self.assertEqual([line.replace(" film.json ", " ").removeprefix("mars animate ") for line in new], list(expected))
        for line in new:
            ran = subprocess.run(line.replace(" film.json ", " like.json ").replace("mars ", f"{PROGRAMS}/mars ", 1), shell=True,
                                 cwd=self.folder, capture_output=True, text=True, env=ENVIRONMENT, timeout=SECONDS)
            self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertEqual(self.film.read_text(), self.like.read_text())

    # ---- where things are

    def box_of(self, selector):
        self.browser.settle()
        return self.browser.run("const at = document.querySelector(arguments[0]).getBoundingClientRect(); return [at.x, at.y, at.width, at.height]", selector)

    def is_seen(self, selector):
        """Whether the mouse would find its middle there, as the page stands."""
        return self.browser.run("""
            const it = document.querySelector(arguments[0]), at = it.getBoundingClientRect();
            return it.contains(document.elementFromPoint(at.x + at.width / 2, at.y + at.height / 2));""", selector)

    def at(self, row, frame):
        left, _, width, _ = self.box_of(".ruler")
        _, top, _, height = self.box_of(f"[data-row='{row}']")
        return left + MARGIN + frame * (width - 2 * MARGIN) / (FILM["frames"] - 1), top + height / 2

    # ---- tests

    def test_keys_are_dragged_boxed_and_eased(self):
        self.begin()
        self.until("parts", "document.querySelector('[data-row=\"tom head\"]') !== null")
        self.changed_by(lambda: self.browser.drag(self.at("tom head", 20), self.at("tom head", 26)))
        self.same_as_commands("move tom head --frame 20 --to 26")
        self.browser.drag(self.at("tom", 56), self.at("tom left-shin", 15))
        self.until("selected keys", "document.querySelector('.key-values').textContent.startsWith('4 keys')")
        self.keys("e", "e")
        self.changed_by(lambda: self.choose_entry("Begin and end slowly"))
        self.same_as_commands("time tom --frame 20-50 --ease both")
        self.changed_by(lambda: self.browser.drag(self.at("tom head", 26), self.at("tom head", 36)))
        self.same_as_commands("move tom --frame 20-50 --to 30")
        self.browser.click(*self.at("tom left-shin", 60 - 1))
        self.changed_by(lambda: self.keys("z", modifiers=CTRL))
        self.no_complaint()

    def test_slopes_of_curves_are_pulled(self):
        self.begin()
        self.until("parts", "document.querySelector('[data-row=\"tom left-shin\"]') !== null")
        self.click('[data-row="tom left-shin"]')
        self.keys("e", "e")
        self.changed_by(lambda: self.choose_entry("Spline"))
        self.same_as_commands("time tom left-shin --frame 0-50 --ease spline")
        self.tab("Curves")
        self.until("curves", "document.querySelector('.drawing .nothing').hidden")
        self.until("a key at its place", "document.querySelector('.panel:not([hidden]) > .drawing canvas').width > 300")
        _, top, _, height = self.box_of(".panel:not([hidden]) > .drawing")
        x = self.at("tom left-shin", 20)[0]
        y = self.point_on_curve(x, top, height)
        self.browser.click(x, y)
        self.until("one key", "document.querySelector('[data-key=\"key.y\"]')?.value === '40'")
        self.changed_by(lambda: self.click('[data-key="key.flat"]'))
        self.same_as_commands("tangent tom left-shin --frame 20 --flat")
        # The handle is a third of the way to the next key at 50.
        self.changed_by(lambda: self.browser.drag((self.at("tom left-shin", 30)[0], y), (x + 90, top + height / 2)))
        line = self.shown_commands()[-1].replace(" film.json ", " ").removeprefix("mars animate ")
        self.assertRegex(line, r"^tangent tom left-shin.y --frame 20 --in -[\d.]+ --out -[\d.]+$")
        self.same_as_commands(line)
        self.no_complaint()

    def point_on_curve(self, x, top, height):
        """Where the mouse finds a key."""
        for y in range(round(top) + 8, round(top + height), 3):
            self.browser.move(x, y)
            if self.browser.run("return document.querySelector('.panel:not([hidden]) > .drawing').style.cursor") == "pointer":
                return y + 4
        raise AssertionError("no key there")

    def test_a_walk_is_shown_and_kept(self):
        self.begin()
        self.click("#tree .row")
        self.tab("Motions")
        self.click("[data-motion=walk]")
        self.type('[data-key="motion.steps"]', "3")
        before = self.film.read_text()
        self.assertTrue(self.is_seen('[data-key="motion.apply"]'), "below the fold")
        self.click('[data-key="motion.preview"]')
        self.assertEqual(self.film.read_text(), before)
        self.changed_by(lambda: self.click('[data-key="motion.apply"]'))
        self.same_as_commands("walk tom --steps 3 --lengthen")
        walked = json.loads(self.film.read_text())["actors"][0]["keys"]
        self.click("[data-motion=nod]")
        self.changed_by(lambda: self.click('[data-key="motion.apply"]'))
        self.same_as_commands("nod tom --lengthen")
        self.assertEqual(json.loads(self.film.read_text())["actors"][0]["keys"][:len(walked) - 1], walked[:-1], "the walk stays")
        self.reduce_to_few_keys()
        self.cut_camera()
        self.no_complaint()

    def message(self, pattern):
        self.until(pattern, lambda: re.search(pattern, self.browser.run("return document.getElementById('messages').textContent")))

    def reduce_to_few_keys(self):
        before = self.film.stat().st_size
        self.click("[data-row=tom] .name")
        self.keys("t", "t")
        self.choose_entry("Reduce\u2026")
        self.changed_by(self.enter)
        last = json.loads(self.film.read_text())["actors"][0]["keys"][-1]["frame"]
        self.message(r"keys? in \d+ frames became")
        self.assertLess(self.film.stat().st_size, before * 2 / 3)
        self.same_as_commands(f"reduce tom --error 1 --frame 0-{last}")

    def cut_camera(self):
        """It looks from elsewhere at once, and only from the frame on."""
        self.tab("Scene")
        self.go_to(30)
        self.changed_by(lambda: self.click('[data-key="camera.cut"]'))
        self.write("camera.eye.x", -3.0)
        self.same_as_commands("cut camera --frame 30", "pose camera eye=-3,-2,1.6 --frame 30")
        for frame, x in ((29, 5), (30, -3)):
            self.go_to(frame)
            self.assertEqual(self.project()["camera"]["eye"][0], x)

    def go_to(self, frame):
        self.type('[data-key="frame"]', str(frame), enter=True)
        self.until(f"frame {frame}", f"window.seen.project.frame === {frame}")

    def test_a_script_says_what_is_wrong_at_its_line(self):
        self.begin()
        self.tab("Scripts")
        self.type('[data-key="script.text"]', "at 0  tom nod times 2\nthen  tom wlave\n")
        self.until("the error", "document.querySelector('.line-numbers .bad')?.textContent === '2'")
        self.assertIn("wlave", self.browser.run("return document.querySelector('.script-problem').textContent"))
        self.assertTrue(self.browser.run("return document.querySelector('[data-key=\"script.apply\"]').disabled"))
        self.type('[data-key="script.text"]', "at 0  tom nod times 2\n")
        self.until("no error", "!document.querySelector('[data-key=\"script.apply\"]').disabled && document.querySelector('.line-numbers .bad') === null")
        self.changed_by(lambda: self.click('[data-key="script.apply"]'))
        self.assertEqual((self.folder / "new.script").read_text(), "at 0  tom nod times 2\n")
        self.same_as_commands("script new.script --lengthen")
        self.no_complaint()


if __name__ == "__main__":
    main()
