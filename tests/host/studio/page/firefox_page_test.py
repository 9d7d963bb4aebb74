"""The studio's page in a headless Firefox, before a studio that is played by mock_studio.py: pictures are painted, hands,
keys and fields say what they say in Chromium. Takes Debian's firefox-esr and python3-websockets."""

import pathlib
import sys
import time
import unittest

import projects
from channels import channels
from firefox import Firefox
from mock_studio import DEFLATE, JPEG, RAW, MockStudio
from settled import PATIENCE

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3]))
from cases import main  # noqa: E402

PROGRAM = sys.argv[1]


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Firefox(PROGRAM, 1440, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()

    def show(self, project, things=()):
        self.studio = MockStudio(project)
        self.studio.channels = things
        self.studio.start()
        self.addCleanup(self.studio.stop)
        self.browser.open(self.studio.link)
        for view in range(4):
            self.studio.wait_for("painted", view=view)
        self.browser.js("window.errors = []; addEventListener('error', ({message}) => window.errors.push(message))")
        self.addCleanup(self.browser.js, "window.hand.leave()")
        self.addCleanup(lambda: self.assertEqual(self.browser.js("return window.errors"), []))

    def at(self, css):
        """Where the mouse finds it on a page that is settled, and that stands still until let_go()."""
        return self.browser.js("const {x, y} = await window.hand.take(arguments[0], null, arguments[1]); return [x, y];", css, 1000 * PATIENCE)

    def let_go(self):
        self.browser.js("window.hand.release()")

    def click(self, css):
        self.browser.click(self.at(css))
        self.let_go()

    def center(self, css):
        place = self.at(css)
        self.let_go()
        return place

    def press(self, *keys):
        self.browser.js("await window.hand.hold()")
        self.browser.press(*keys)
        self.let_go()

    def until(self, text, wanted=True):
        end = time.monotonic() + PATIENCE
        while (found := self.browser.js(f"return {text}")) != wanted:
            self.assertLess(time.monotonic(), end, f"{text} is {found!r}, not {wanted!r}")

    def step(self):
        """The last one committed, after which there may be another."""
        step = self.studio.wait_for("commit")["step"]
        self.studio.forget()
        return step

    # ---- tests

    def test_pictures(self):
        self.show(projects.model())
        pixels = bytes(part for i in range(12) for part in (i * 16, 255 - i, i * 7 % 256, 255))
        for encoding in (RAW, DEFLATE):
            number = self.studio.show(0, [(3, 5, 4, 3)], pixels, encoding=encoding)
            self.studio.wait_for("painted", view=0, picture=number)
            self.assertEqual(bytes(self.pixels(0, 3, 5, 4, 3)), pixels)
        asked = self.studio.views[1]
        jpeg = self.browser.js("""
            const canvas = new OffscreenCanvas(...arguments), pen = canvas.getContext("2d");
            pen.fillStyle = "rgb(200 40 90)";
            pen.fillRect(0, 0, canvas.width, canvas.height);
            const blob = await canvas.convertToBlob({type: "image/jpeg", quality: 1});
            return [...new Uint8Array(await blob.arrayBuffer())];""", asked["width"], asked["height"])
        number = self.studio.show(1, [(0, 0, asked["width"], asked["height"])], bytes(jpeg), encoding=JPEG)
        self.studio.wait_for("painted", view=1, picture=number)
        for painted, meant in zip(self.pixels(1, 9, 9, 1, 1), (200, 40, 90, 255)):
            self.assertAlmostEqual(painted, meant, delta=3)

    def pixels(self, view, *rectangle):
        return self.browser.js("""
            const [view, rectangle] = arguments, canvas = document.querySelectorAll(".view canvas")[view];
            return [...canvas.getContext("2d").getImageData(...rectangle).data];""", view, rectangle)

    def test_hands_in_views(self):
        self.show(projects.model())
        x, y = (round(each) for each in self.center(".picture"))
        for button, how in ((0, "turn"), (1, "turn"), (2, "pan")):
            self.browser.drag((x, y), (x + 50, y + 15), button=button)
            self.studio.wait_for("orbit", moving=False)
            moved = [each["by"] for each in self.studio.heard if each["do"] == "orbit" and each["how"] == how]
            self.assertEqual([sum(way) for way in zip(*moved)], [50, 15])
            self.studio.forget()
        self.browser.wheel((x, y), 120)
        self.assertEqual(self.studio.wait_for("orbit", how="zoom", moving=True)["by"], [0, 120])
        self.studio.there = lambda grab: {"actor": "model", "joint": "left-thigh", "handle": None}
        self.browser.drag((x, y), (x + 50, y + 15))
        grab = self.studio.wait_for("grab", view=0, button=0)
        self.studio.wait_for("drag", x=grab["x"] + 50, y=grab["y"] + 15)
        self.studio.wait_for("drop")
        self.press("z")
        self.studio.wait_for("orbit", how="selected")
        self.press("Control+z")
        self.studio.wait_for("undo")

    def test_fields_and_menus(self):
        self.show(projects.model())
        self.click('[data-key="model/left-thigh"] .name')
        self.studio.wait_for("select", joint="left-thigh")
        self.press("ArrowDown")
        self.studio.wait_for("select", joint="left-shin")
        x, y = self.center('[data-key="pose.y"]')
        self.browser.drag((x - 40, y), (x, y))
        self.studio.wait_for("preview")
        self.assertGreater(self.step()["pose"]["left-shin"][1], 50)
        self.click('[data-key="pose.y.number"]')
        self.press("4", "5", "Enter")
        self.assertEqual(self.step()["pose"]["left-shin"][1], 45)
        self.browser.js("document.querySelector('[data-key=shape]').focus()")
        self.press("c", "a", "p")
        self.assertEqual(self.step(), {"commands": [["model", "set", "left-shin", "--shape", "capsule"]]})
        self.click(".title")
        self.press("p", "Enter")
        self.studio.wait_for("view", view=0, **{"as": "prisms"})
        self.press("?")
        self.until("document.querySelector('dialog.help')?.open")
        self.press("Escape")
        self.until("document.querySelector('dialog.help').open", False)

    def test_a_film(self):
        self.show(projects.film(), channels())
        self.click('[data-key="watcher"] .name')
        self.until("document.querySelector('[data-key=\"actor.attach\"]')?.length", 1)
        self.click('[data-key="actor.attach"]')
        self.press(*"walker \u203a h", "Enter")
        self.assertEqual(self.step()["commands"][0][:5], ["animate", "attach", "watcher", "--to", "walker/head"])
        self.click("[data-row=walker] .twist")
        self.until("document.querySelector('[data-row=\"walker left-shin\"]') !== null")
        left, width = self.browser.js("const at = document.querySelector('.ruler').getBoundingClientRect(); return [at.x, at.width]")
        x = lambda frame: left + 18 + frame * (width - 36) / (self.studio.project["frames"] - 1)  # noqa: E731
        y = self.at('[data-row="walker left-shin"]')[1]
        self.browser.drag((x(20), y), (x(24), y))
        self.let_go()
        self.assertEqual(self.step(), {"commands": [["animate", "move", "walker", "left-shin", "--frame", "20", "--to", "24"]]})
        self.browser.click((x(60), self.at(".ruler")[1]))
        self.let_go()
        self.studio.wait_for("frame", frame=60)
        self.click('[data-row="walker left-shin"] .name')
        self.press("k")
        self.studio.wait_for("curves", thing="walker", parts=["left-shin"])
        self.press(" ")
        self.studio.wait_for("frame", count=4)
        self.press(" ")


if __name__ == "__main__":
    main()
