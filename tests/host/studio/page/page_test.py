"""The studio's page in a headless Chromium, before a studio that is played by mock_studio.py. Takes Debian's chromium,
chromium-driver, python3-selenium and python3-websockets."""

import base64
import contextlib
import functools
import math
import pathlib
import re
import struct
import sys
import time
import unittest
import zlib

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import projects
from chromium import Chromium
from mock_studio import DEFLATE, PAGE, MockStudio, bits
from settled import PATIENCE

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3]))
from cases import main  # noqa: E402

CHROMEDRIVER = sys.argv[1]
SIZE = (1280, 720)


@functools.cache
def one_browser():
    browser = Chromium(CHROMEDRIVER, *SIZE)
    unittest.addModuleCleanup(browser.driver.quit)
    return browser


def numbers(words, option):
    """Those after an option of a command, up to the next one."""
    values = words[words.index(option) + 1:]
    end = next((at for at, word in enumerate(values) if word.startswith("--")), len(values))
    return [float(word) for word in values[:end]]


def figure_picture():
    """A PNG of 32 x 32: a bar on the ground of previews."""
    row = lambda y: b"\0" + b"".join(bytes((200, 40, 40) if 13 <= x < 19 and 6 <= y < 28 else (31, 36, 51)) for x in range(32))  # noqa: E731
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))  # noqa: E731
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 32, 32, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(b"".join(map(row, range(32))))) + chunk(b"IEND", b""))


class Page(unittest.TestCase):
    kind = projects.model

    def setUp(self):
        self.browser = one_browser()
        self.driver = self.browser.driver
        self.studio = MockStudio(type(self).kind()).start()
        self.scheme("dark")
        self.driver.get(self.studio.link)
        for view in range(4):
            self.studio.wait_for("painted", view=view)
        self.allowed = "willReadFrequently"  # the test's own reading of canvases

    def tearDown(self):
        errors = [entry["message"] for entry in self.driver.get_log("browser")]
        self.js("dispatchEvent(new Event('pagehide')); localStorage.clear(); sessionStorage.clear(); window.hand.leave()")
        self.studio.stop()
        self.assertEqual([error for error in errors if self.allowed not in error], [])

    # Small words for what tests do.

    def find(self, css):
        """An element of a settled page, to read."""
        self.browser.settle()
        return self.driver.find_element(By.CSS_SELECTOR, css)

    def find_all(self, css):
        self.browser.settle()
        return self.driver.find_elements(By.CSS_SELECTOR, css)

    def js(self, text, *arguments):
        return self.browser.run(text, *arguments)

    def click(self, css, text=None, **how):
        self.browser.click_on(css, text, **how)

    def type(self, css, *keys):
        with self.browser.on(css) as (element, _):
            element.send_keys(*keys)

    def press(self, *keys):
        with self.browser.still():
            self.driver.switch_to.active_element.send_keys(*keys)

    @contextlib.contextmanager
    def held(self, *modifiers):
        for each in modifiers:
            ActionChains(self.driver).key_down(each).perform()
        yield
        for each in modifiers:
            ActionChains(self.driver).key_up(each).perform()

    def chord(self, *keys):
        chain = ActionChains(self.driver)
        for key in keys:
            chain = chain.key_down(key)
        for key in reversed(keys):
            chain = chain.key_up(key)
        with self.browser.still():
            chain.perform()

    def until(self, what, wanted=True):
        end = time.monotonic() + PATIENCE
        while (found := what()) != wanted:
            self.assertLess(time.monotonic(), end, f"is {found!r}, not {wanted!r}")
            time.sleep(0.01)

    def scheme(self, scheme):
        self.browser.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def select(self, joint):
        self.click(f'[data-key$="/{joint}"] > .row')
        self.studio.wait_for("select", joint=joint)

    def heard(self, what):
        """The messages that do this, after all that the page sent has come."""
        self.browser.settle()
        return [each for each in self.studio.heard if each["do"] == what]

    def commit(self, begin):
        """The words of the last command that was committed and begins so."""
        return self.committed(lambda step: [words for words in step.get("commands", []) if " ".join(words).startswith(begin)], begin)

    def posed(self, joint):
        """How the last committed pose of a model turns the joint."""
        return self.committed(lambda step: [step["pose"][joint]] if joint in step.get("pose", {}) else [], joint)

    def committed(self, found_in, wanted):
        end = time.monotonic() + PATIENCE
        while True:
            steps = [each["step"] for each in self.studio.heard if each["do"] == "commit"]
            found = [each for step in steps for each in found_in(step)]
            if found:
                return found[-1]
            self.assertLess(time.monotonic(), end, f"no commit of {wanted} among {steps}")
            time.sleep(0.01)

    def canvas(self, view):
        return self.driver.find_elements(By.CSS_SELECTOR, ".view canvas")[view]

    def pixels(self, view, x, y, width, height):
        return self.js("return [...arguments[0].getContext('2d').getImageData(...arguments[1]).data]", self.canvas(view),
                       [x, y, width, height])


def picture(view=0):
    return f"[data-key=view-{view}]"


class Pictures(Page):
    def test_pictures_are_painted_pixel_for_pixel(self):
        rects = [(3, 5, 4, 3), (20, 9, 2, 2)]
        pixels = bytes(part for i in range(16) for part in (i * 16, 255 - i, i * 7 % 256, 255))
        for encoding in (0, DEFLATE):
            for view, color in ((0, (40, 60, 80)), (2, (100, 60, 80))):
                with self.subTest(encoding=encoding, view=view):
                    number = self.studio.show(view, rects, pixels, encoding=encoding)
                    self.studio.wait_for("painted", view=view, picture=number)
                    self.assertEqual(bytes(self.pixels(view, 3, 5, 4, 3) + self.pixels(view, 20, 9, 2, 2)), pixels)
                    self.assertEqual(self.pixels(view, 0, 0, 1, 1), [*color, 255])

    def test_pictures_have_the_views_pixels_and_jpeg_is_painted(self):
        for view in range(4):
            asked = self.studio.views[view]
            self.assertEqual(self.js("return [arguments[0].width, arguments[0].height]", self.canvas(view)),
                             [asked["width"], asked["height"]])
            self.assertAlmostEqual(self.js("return arguments[0].getBoundingClientRect().width", self.canvas(view)), asked["width"], delta=1)
        asked = self.studio.views[1]
        jpeg = self.js("""const canvas = new OffscreenCanvas(arguments[0], arguments[1]), pen = canvas.getContext("2d");
                          pen.fillStyle = "rgb(200 40 90)";
                          pen.fillRect(0, 0, canvas.width, canvas.height);
                          return canvas.convertToBlob({type: "image/jpeg", quality: 1}).then((blob) => blob.arrayBuffer())
                            .then((buffer) => [...new Uint8Array(buffer)]);""", asked["width"], asked["height"])
        number = self.studio.show(1, [(0, 0, asked["width"], asked["height"])], bytes(jpeg), encoding=2)
        self.studio.wait_for("painted", view=1, picture=number)
        for painted, meant in zip(self.pixels(1, 9, 9, 1, 1), (200, 40, 90, 255)):
            self.assertAlmostEqual(painted, meant, delta=3)

    def test_latency_is_measured_from_the_event_to_its_paint(self):
        self.js("window.marsLatencies.length = 0")
        self.click(picture())
        began = time.monotonic()
        self.type(picture(), Keys.ARROW_LEFT)
        orbit = self.studio.wait_for("orbit", view=0, how="turn", moving=True)
        self.until(lambda: self.js("return window.marsLatencies.filter(({edit}) => edit === arguments[0]).length", orbit["edit"]), 4)
        most = 1000 * (time.monotonic() - began)
        self.assertTrue(all(0 < each["ms"] < most for each in self.js("return window.marsLatencies") if each["edit"] == orbit["edit"]))
        self.until(lambda: re.search(r"\d+ ms to a picture", self.find("#status").text) is not None)

    def test_handles_come_with_their_picture(self):
        ring = {"id": "ring x", "kind": "ring", "axis": "x", "points": [[10, 10], [30, 12], [40, 30]], "hot": True}
        label = {"id": "angle", "kind": "label", "points": [[50, 50]], "text": "30°"}
        self.studio.tell({"is": "handles", "view": 0, "picture": self.studio.numbers[0] + 1, "shapes": [ring, label]})
        self.assertEqual(self.js("return document.querySelectorAll('.handle').length"), 0)
        number = self.studio.show(0, [(0, 0, 1, 1)], b"\1\2\3\xff")
        self.studio.wait_for("painted", view=0, picture=number)
        self.assertEqual(self.js("return [...document.querySelectorAll('.handle')].map((each) => each.getAttribute('class'))"),
                         ["handle ring axis-x hot", "handle label"])
        self.assertEqual(self.find(".handle text").text, "30°")


class Hands(Page):
    def drag(self, *moves, view=0, button=0):
        chain = ActionChains(self.driver, duration=20).move_to_element(self.find(picture(view))).click_and_hold()
        for right, down in moves:
            chain = chain.move_by_offset(right, down)
        chain.release().perform()

    def test_a_drag_on_empty_space_orbits(self):
        self.drag((30, 10), (20, 5))
        self.studio.wait_for("orbit", moving=False)
        moved = [each["by"] for each in self.studio.heard if each["do"] == "orbit"]
        self.assertEqual([sum(way) for way in zip(*moved)], [50, 15])
        self.assertEqual(self.heard("drag") + self.heard("drop"), [])

    def test_a_drag_on_a_limb_pulls_it_and_escape_lets_go(self):
        self.studio.there = lambda grab: {"actor": "model", "joint": "left-thigh", "handle": None}
        self.drag((30, 10), (20, 5))
        grab = self.studio.wait_for("grab", view=0, button=0, keys=[])
        drop = self.studio.wait_for("drop")
        drag = self.studio.wait_for("drag", x=grab["x"] + 50, y=grab["y"] + 15)
        self.assertLess(grab["edit"], drag["edit"])
        self.assertLess(drag["edit"], drop["edit"])
        self.studio.forget()
        chain = ActionChains(self.driver, duration=20).move_to_element(self.find(picture())).click_and_hold().move_by_offset(9, 9)
        chain.send_keys(Keys.ESCAPE).release().perform()
        self.studio.wait_for("let_go")
        self.assertEqual(self.heard("drop") + self.heard("commit"), [])

    def test_wheel_keys_and_buttons_move_the_eye(self):
        ActionChains(self.driver).scroll_from_origin(ScrollOrigin.from_element(self.find(picture(3)), 20, 10), 0, 120).perform()
        zoom = self.studio.wait_for("orbit", view=3, how="zoom", moving=True)
        self.assertEqual(zoom["by"], [0, 120])
        self.assertTrue({"x", "y"} <= zoom.keys())
        self.studio.wait_for("orbit", view=3, moving=False)
        with self.held(Keys.SHIFT):
            self.drag((10, 0), view=3)
            self.studio.wait_for("orbit", view=3, how="pan", moving=True)
            self.type(picture(3), Keys.ARROW_UP)
        self.type(picture(3), "+")
        self.studio.wait_for("orbit", view=3, how="zoom")
        with self.held(Keys.ALT):
            self.drag((10, 0), view=3)
        self.studio.wait_for("orbit", view=3, how="turn")
        self.assertEqual(self.heard("grab"), [])

    def touch(self, kind, *places):
        points = [{"id": number, "x": x, "y": y} for number, (x, y) in enumerate(places)]
        self.browser.command("Input.dispatchTouchEvent", type=kind, touchPoints=points)

    def test_fingers_that_pinch_zoom_between_them(self):
        self.studio.there = lambda grab: {"actor": "model", "joint": "left-thigh", "handle": None}
        at = self.find(picture(3)).rect
        x, y = at["x"] + at["width"] / 2, at["y"] + at["height"] / 2
        self.touch("touchStart", (x - 20, y))
        self.touch("touchStart", (x - 20, y), (x + 20, y))
        self.studio.wait_for("let_go")  # what one finger had begun
        for spread in (24, 32, 40):
            self.touch("touchMove", (x - spread, y), (x + spread, y))
        self.touch("touchEnd", (x - 40, y))
        self.touch("touchMove", (x + 30, y + 30))
        self.touch("touchEnd")
        self.studio.wait_for("orbit", view=3, moving=False)
        orbits = [each for each in self.heard("orbit") if each["moving"]]
        self.assertEqual({each["how"] for each in orbits}, {"zoom"})
        self.assertAlmostEqual(math.exp(0.0015 * sum(each["by"][1] for each in orbits)), 0.5, places=3)  # twice as large
        view = self.studio.views[3]
        self.assertAlmostEqual(orbits[-1]["x"], view["width"] / 2, delta=1)
        self.assertEqual(self.heard("drag") + self.heard("drop"), [])

    def test_a_pinch_of_a_trackpad_zooms_as_far_as_the_fingers(self):
        at = self.find(picture(3)).rect
        self.browser.command("Input.dispatchMouseEvent", type="mouseWheel", x=at["x"] + 50, y=at["y"] + 50, deltaX=0,
                             deltaY=-100 * math.log(2), modifiers=2)
        zoom = self.studio.wait_for("orbit", view=3, how="zoom", moving=True)
        self.assertAlmostEqual(math.exp(0.0015 * zoom["by"][1]), 0.5, delta=0.01)

    def test_a_click_on_empty_space_selects_nothing(self):
        self.select("head")
        self.click(picture())
        self.studio.wait_for("select", actor=None, joint=None)


class Controls(Page):
    def test_tree_by_keyboard(self):
        self.js("document.querySelector('#tree [role=tree]').focus()")
        self.press(Keys.ARROW_DOWN)
        self.studio.wait_for("select", actor="model", joint="spine")
        self.press("/")
        self.press("left-sh")
        self.studio.wait_for("select", joint="left-shin")
        self.press(Keys.ENTER)
        shut = lambda: self.js(  # noqa: E731
            "return document.getElementById(document.activeElement.getAttribute('aria-activedescendant')).ariaExpanded")
        self.assertEqual(shut(), "true")
        self.press(Keys.ARROW_LEFT)
        self.assertEqual(shut(), "false")
        self.press(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.studio.wait_for("select", joint="left-foot")
        self.press(Keys.HOME)
        self.studio.wait_for("select", joint="pelvis")
        self.press(Keys.END)
        self.studio.wait_for("select", joint="right-toe-sole")
        current = self.js("return document.activeElement.getAttribute('aria-activedescendant')")
        self.assertEqual(self.find(f"#{current}").get_attribute("data-key"), "model/right-toe-sole")
        self.assertTrue(self.find(f"#{current}").is_displayed())

    def test_shift_selects_further_joints(self):
        def chosen():
            return {each.get_attribute("data-key") for each in self.find_all("#tree [aria-selected=true]")}
        self.select("left-shin")
        self.click('[data-key$="/right-shin"] > .row', keys=8)
        self.studio.wait_for("select", joint="right-shin", more=["left-shin"])
        self.js("document.querySelector('#tree [role=tree]').focus()")
        self.chord(Keys.SHIFT, Keys.ARROW_DOWN)
        self.studio.wait_for("select", joint="right-foot", more=["right-shin", "left-shin"])
        self.assertEqual(chosen(), {"model/right-foot", "model/right-shin", "model/left-shin"})
        self.click('[data-key$="/right-foot"] > .row', keys=8)
        self.studio.wait_for("select", joint="right-shin", more=["left-shin"])
        self.driver.refresh()
        self.studio.wait_for("select", count=3, joint="right-shin", more=["left-shin"])
        self.select("head")
        self.assertEqual(chosen(), {"model/head"})

    def test_letters_are_shortcuts_after_a_click_in_the_tree(self):
        self.click('[data-key$="/left-shin"] > .row > .name')
        self.studio.wait_for("select", joint="left-shin")
        self.press("s")
        self.studio.wait_for("view", view=0, **{"as": "vertices"})
        self.press("2")
        self.until(lambda: self.js("return document.activeElement === document.querySelectorAll('.picture')[1]"))

    def test_sliders_stop_at_limits_and_commit_once(self):
        self.select("left-shin")
        slider = self.find('[data-key="pose.y"]')
        limits = [float(slider.get_attribute(end)) for end in ("min", "max")]
        self.type('[data-key="pose.y"]', Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.assertEqual(self.posed("left-shin"), [0, 2, 0])
        self.assertEqual(self.heard("preview")[-1]["step"]["pose"]["left-shin"][1], 2)
        self.assertEqual(len(self.heard("commit")), 1)
        self.studio.forget()
        self.type('[data-key="pose.y"]', Keys.END)
        self.assertEqual(self.posed("left-shin"), [0, limits[1], 0])
        self.studio.forget()
        self.type('[data-key="pose.y"]', Keys.HOME, Keys.ESCAPE)
        self.studio.wait_for("cancel")
        self.assertEqual(float(self.find('[data-key="pose.y"]').get_attribute("value")), limits[1])

    def test_numbers_are_written_stepped_and_given_up(self):
        self.select("left-thigh")
        self.type('[data-key="place.y"]', Keys.CONTROL, "a", Keys.NULL, "0,5", Keys.ENTER)
        self.assertEqual(numbers(self.commit("model set left-thigh"), "--place")[1], 0.5)
        self.studio.forget()
        self.type('[data-key="place.z"]', Keys.ARROW_UP, Keys.ESCAPE)
        self.studio.wait_for("cancel")
        self.type('[data-key="sbb.1.x"]', Keys.SHIFT, Keys.ARROW_UP, Keys.NULL, Keys.ENTER)
        thigh = next(joint for joint in self.studio.project["actors"][0]["joints"] if joint["name"] == "left-thigh")
        changed = numbers(self.commit("model set left-thigh"), "--sbb")
        self.assertAlmostEqual(changed[3], thigh["sbb"][1][0] + 0.2)
        self.assertEqual(changed[:3], thigh["sbb"][0])

    def test_numbers_are_expressions_and_changes_of_what_was_there(self):
        self.select("left-thigh")
        for text, value in (("-16.67-10", -26.67), ("+40", 40), ("2*(0,5+1)/3", 1), ("+=0.5", 1.5), ("*=2-4", -3)):
            with self.subTest(text):
                self.studio.forget()
                self.type('[data-key="place.y"]', Keys.CONTROL, "a", Keys.NULL, text, Keys.ENTER)
                self.assertEqual(numbers(self.commit("model set left-thigh"), "--place")[1], value)

    def test_what_is_no_number_is_not_taken_and_the_reason_is_said(self):
        self.select("left-thigh")
        field = '[data-key="place.y"]'
        before = self.find(field).get_attribute("value")
        self.type(field, Keys.CONTROL, "a", Keys.NULL, "12*", Keys.ENTER)
        self.assertEqual(self.js("const {value, validationMessage} = document.activeElement; return [value, validationMessage.slice(0, 37)]"),
                         ["12*", "Write a number or an expression, such"])
        self.assertEqual(self.heard("commit"), [])
        self.press(Keys.ESCAPE)
        self.studio.wait_for("cancel")
        self.assertEqual([self.find(field).get_attribute("value"), self.heard("commit")], [before, []])

    def test_numbers_written_before_the_answer_to_those_before_are_kept(self):
        self.select("left-thigh")  # the stand-in answers with the project as it was: the studio's slowest
        self.js("performance.now = () => 0")  # nothing that was written waits for too long
        for key, text in (("sbb.0.x", "-0.7"), ("sbb.0.y", "-0.8"), ("sbb.1.x", "0.9"), ("place.x", "0.3"), ("place.y", "0.4")):
            self.type(f'[data-key="{key}"]', Keys.CONTROL, "a", Keys.NULL, text, Keys.TAB)
        steps = [each["step"]["commands"][0] for each in self.heard("commit")]
        self.assertEqual(len(steps), 5)
        box = numbers(steps[2], "--sbb")
        self.assertEqual([box[:2], box[3]], [[-0.7, -0.8], 0.9])
        self.assertEqual(numbers(steps[4], "--place")[:2], [0.3, 0.4])

    def test_first_steps_are_of_what_there_is(self):
        shown = lambda: self.js("return document.querySelector('.nothing dl').innerText")  # noqa: E731
        self.assertIn("a limb in a view", shown())
        body = {**self.studio.project["actors"][0]["joints"][0], "shape": None, "sbb": None, "name": "body"}
        actors = [{**self.studio.project["actors"][0], "joints": [body]}]
        self.studio.tell({"is": "project", **self.studio.project, "actors": actors})
        self.until(lambda: "a limb in a view" in shown(), False)
        for words in ("a joint in the tree", "Shift+A\nadds a joint", "Bodies\nbegins with a whole figure"):
            self.assertIn(words, shown())
        self.studio.tell({"is": "project", **projects.film(), "actors": []})
        self.until(lambda: "Scene\nadds actors" in shown())

    def test_a_double_click_in_the_tree_renames(self):
        self.click('[data-key$="/left-thigh"] > .row > .name', clicks=2)
        self.until(lambda: self.js("return document.activeElement.dataset.key + ' ' + document.activeElement.value"), "name left-thigh")

    def test_limits_shapes_materials_and_bodies(self):
        self.select("left-shin")
        self.click('[data-key="free.x"]')
        shin = next(joint for joint in self.studio.project["actors"][0]["joints"] if joint["name"] == "left-shin")
        lower, upper = (f"{angle:g}" for angle in shin["limits"][1])
        self.commit(f"model set left-shin --fixed --limits x -180 180 --limits y {lower} {upper}")
        self.type('[data-key="shape"]', "cap")
        self.commit("model set left-shin --shape capsule")
        self.type('[data-key="material"]', "rub")
        self.commit("model set left-shin --material rubber")
        self.click("[role=tab]:nth-child(2)")
        self.assertEqual(self.find('[role="option"][aria-selected="true"]').text, "trousers")
        self.type('[data-key="material.diffuse"]', Keys.ARROW_RIGHT)
        self.commit("model set --material trousers --diffuse 0.8")
        self.type('[data-key="material.diffuse.number"]', Keys.CONTROL, "a", Keys.NULL, "5", Keys.ENTER)  # the slider ends at 2
        self.commit("model set --material trousers --diffuse 5")
        self.click('input[type=checkbox][data-key="material.casts"]')
        self.commit("model set --material trousers --casts false")
        self.js("""const color = document.querySelector('[data-key="material.color"]');
                   color.value = "#ff0080";
                   color.dispatchEvent(new Event("change", {bubbles: true}));""")
        self.commit("model set --material trousers --color 1 0 0.502")
        self.type("[role=tab]:nth-child(2)", Keys.ARROW_RIGHT)

    def test_a_body_takes_the_models_place_only_where_somebody_agrees(self):
        self.click("[role=tab]:nth-child(3)")
        body = lambda name: self.click(f'[data-key="model.{name}"]')  # noqa: E731
        body("child")
        self.assertIn(f"Its {len(self.studio.project['actors'][0]['joints'])} joints go", self.find(".popover").text)
        self.press(Keys.ESCAPE)
        self.until(lambda: self.find_all(".popover"), [])
        body("tall")
        self.click('[data-key="ask.yes"]')
        self.commit("model new --figure tall --replace")
        self.assertEqual(len(self.heard("commit")), 1)
        self.studio.forget()
        new = {**self.studio.project["actors"][0], "joints": self.studio.project["actors"][0]["joints"][:1]}
        self.studio.tell({"is": "project", **self.studio.project, "actors": [new], "undo": None})
        self.until(lambda: self.find("#tree .count").text, "1")
        body("child")
        self.commit("model new --figure child --replace")

    def test_joints_are_added_renamed_mirrored_and_removed_by_keys(self):
        self.select("left-hand")
        self.press(Keys.INSERT)
        self.commit("model add joint-1 --parent left-hand --place ")
        self.press(Keys.F2)
        self.assertEqual(self.js("return document.activeElement.dataset.key"), "name")
        self.press(Keys.CONTROL, "a", Keys.NULL, "left-paw", Keys.ENTER)
        self.commit("model set left-hand --name left-paw")
        self.click(".actions button", "Left to right")
        self.commit("model mirror left left-hand")
        self.js("document.querySelector('#tree [role=tree]').focus()")
        self.press(Keys.DELETE)
        self.commit("model remove left-hand --branch")
        self.studio.wait_for("select", joint="left-forearm")

    def test_menu_of_a_view_by_keyboard(self):
        self.type(".title", Keys.ENTER)
        self.assertEqual(self.js("return document.activeElement.textContent"), "Front")
        self.press("p")
        self.assertEqual(self.js("return document.activeElement.textContent"), "Prisms")
        self.press(Keys.ENTER)
        self.studio.wait_for("view", view=0, **{"as": "prisms"})
        self.assertEqual(self.find(".title").text.split(), ["Front", "Prisms"])
        self.click(picture(1))
        for key, change in (("g", {"ground": False}), ("h", {"hidden": False}), ("s", {"as": "vertices"}), ("a", {"orbit": None})):
            self.press(key)
            self.studio.wait_for("view", view=1, **change)
        self.press("z")
        self.studio.wait_for("orbit", view=1, how="selected", moving=False)
        self.press("r")
        self.studio.wait_for("view", view=2, handles="box")

    def test_a_view_is_maximised_and_comes_back(self):
        before = self.studio.views[2]
        self.click(".title[data-view='2']", clicks=2)
        self.studio.wait_for("unview", view=0)
        self.until(lambda: self.studio.views.get(2, before)["width"] > 1.9 * before["width"])
        self.press("f")
        self.until(lambda: sorted(self.studio.views), [0, 1, 2, 3])
        self.press("4")
        self.assertEqual(self.js("return document.activeElement === document.querySelectorAll('.picture')[3]"), True)

    def test_history_and_its_words(self):
        self.studio.tell({"is": "project", **self.studio.project, "undo": "pose of head", "redo": "place of neck"})
        self.until(lambda: self.find('[aria-label="Undo: pose of head"]').is_enabled())
        self.assertTrue(self.find('[aria-label="Redo: place of neck"]').is_enabled())
        self.chord(Keys.CONTROL, "z")
        self.studio.wait_for("undo")
        self.chord(Keys.CONTROL, Keys.SHIFT, "z")
        self.studio.wait_for("redo")

    def test_theme_follows_the_system_until_it_is_switched(self):
        theme = lambda: self.js("return document.documentElement.dataset.theme")  # noqa: E731
        self.until(theme, "dark")
        self.scheme("light")
        self.until(theme, "light")
        self.js("document.body.focus()")
        self.chord("l")
        self.until(theme, "dark")
        self.driver.refresh()
        self.until(theme, "dark")

    def test_what_rings_turn_about_is_kept(self):
        axes = '[data-key="axes"]'
        self.assertEqual(self.find(axes).get_attribute("aria-pressed"), "false")
        self.click(axes)
        self.click(".menu .text", "The joint's own axes, as they stand")
        self.studio.wait_for("view", view=3, axes="joint")
        self.js("document.body.focus()")
        self.chord("x")
        self.studio.wait_for("view", view=3, axes="parent")
        self.driver.refresh()
        self.studio.wait_for("view", view=0, axes="parent")
        self.assertEqual(self.find(axes).get_attribute("aria-pressed"), "true")

    def test_a_reload_brings_back_what_views_show_and_what_is_selected(self):
        orbit = {"center": [1, 2, 3], "turn": -20, "height": 10, "distance": 4}
        self.studio.tell({"is": "orbit", "view": 3, "from": "free", **orbit})
        self.click(picture(0))
        self.press("s")
        self.select("left-shin")
        self.studio.forget()
        self.driver.refresh()
        self.studio.wait_for("view", view=3, orbit=orbit)
        self.studio.wait_for("select", actor="model", joint="left-shin")
        self.assertEqual(self.find('[data-key="name"]').get_attribute("value"), "left-shin")
        self.assertEqual([each for each in self.heard("view") if each["view"] == 0 and each["as"] != "vertices"], [])
        self.studio.project |= {"file": "examples/another.json"}
        self.studio.forget()
        self.driver.refresh()
        self.studio.wait_for("view", view=0, **{"as": "surface"})
        self.studio.wait_for("view", view=3, orbit=None)
        self.assertEqual(self.heard("select"), [])

    def test_what_is_gone_is_not_selected_when_it_comes_back(self):
        self.select("left-shin")
        model = self.studio.project["actors"][0]
        joints = model["joints"]
        self.studio.project["actors"][0] = {**model, "joints": [each for each in joints if each["name"] != "left-shin"]}
        self.studio.forget()
        self.driver.refresh()
        self.studio.wait_for("view", view=3)
        self.browser.settle()
        self.studio.project["actors"][0] = model
        self.studio.tell({"is": "project", **self.studio.project})
        self.assertEqual(self.heard("select"), [])

    def test_what_views_show_is_kept_when_the_eye_rests(self):
        self.js("window.kept = []; Storage.prototype.setItem = (name) => { window.kept.push(name); }")
        for turn in range(30):
            eye = {"center": [1, 2, 3], "turn": turn, "height": 10, "distance": 4}
            self.studio.tell({"is": "orbit", "view": 3, "from": "free", **eye})
        kept = lambda: self.js("return window.kept.filter((name) => name.startsWith('kept ')).length")  # noqa: E731
        self.until(lambda: kept() > 0)
        self.assertLess(kept(), 10)

    def test_what_the_browser_keeps_may_be_damaged_or_forbidden(self):
        name = "kept " + self.studio.project["file"]
        for damaged in ["{", "7", '{"views": [{"from": "nowhere"}]}', '{"views": [], "selected": 7}']:
            self.js("localStorage.setItem(...arguments)", name, damaged)
            self.studio.forget()
            self.driver.refresh()
            self.studio.wait_for("view", view=0, **{"from": "front", "as": "surface"})
        forbid = "for (const each of ['localStorage', 'sessionStorage']) Object.defineProperty(window, each, {get() { throw new Error(each); }})"
        script = self.browser.command("Page.addScriptToEvaluateOnNewDocument", source=forbid)
        self.studio.forget()
        self.driver.get(self.studio.link)
        self.studio.wait_for("view", view=3)
        self.select("left-shin")
        self.browser.command("Page.removeScriptToEvaluateOnNewDocument", **script)
        self.driver.get(self.studio.link)

    def test_a_field_without_a_number_may_be_emptied(self):
        """The preview of what was written before is given up."""
        found = self.js("""
            return import("/fields.js").then(({numberField}) => {
              const said = [];
              const field = numberField({name: "none", preview: (number) => said.push(number), cancel: () => said.push("cancel")});
              const write = (text) => {
                field.input.value = text;
                field.input.dispatchEvent(new Event("input"));
                return field.input.validity.valid;
              };
              field.set(null);
              return [["12", "", "x", " "].map(write), said];
            });""")
        self.assertEqual(found, [[True, True, False, True], [12, "cancel"]])

    def test_help_lists_every_shortcut(self):
        self.chord("?")
        self.until(lambda: self.js("return document.querySelector('dialog.help')?.open ?? false"))
        table = self.js("return import('/shortcuts.js').then(({kShortcuts, kHands}) => [...kShortcuts, ...kHands])")
        shown = self.js("return [...document.querySelectorAll('dialog.help dd')].map((each) => each.textContent)")
        self.assertEqual(shown, [each["text"] for group in dict.fromkeys(each["group"] for each in table)
                                 for each in table if each["group"] == group and not each.get("film")])
        self.press(Keys.ESCAPE)
        self.until(lambda: self.js("return document.querySelector('dialog.help').open"), False)
        commands = set(re.findall(r"^  (\w+): ", (PAGE / "main.js").read_text().split("new Keys({")[1], re.M))
        self.assertEqual({each["name"] for each in table if "name" in each}, commands)

    def test_every_control_has_a_name_and_the_page_does_not_scroll(self):
        self.select("left-upper-arm")
        for tab in range(3):
            self.click(f"[role=tab]:nth-child({tab + 1})")
            self.browser.settle()
            nodes = self.browser.command("Accessibility.getFullAXTree")["nodes"]
            roles = {"button", "slider", "spinbutton", "checkbox", "radio", "combobox", "textbox", "tab", "treeitem", "option",
                     "application", "tree", "ColorWell"}
            controls = [node for node in nodes if node.get("role", {}).get("value") in roles and not node["ignored"]]
            self.assertGreater(len(controls), 50)
            self.assertEqual([node["role"]["value"] for node in controls if not node.get("name", {}).get("value")], [])
        self.assertEqual(self.js("""const {scrollWidth, scrollHeight} = document.documentElement;
                                    return [scrollWidth, scrollHeight];"""), [1280, 720])


class Trouble(Page):
    def test_the_page_connects_again_and_asks_for_its_views(self):
        self.allowed = "/ws?token"  # the page also asks why it is refused
        self.select("left-hand")
        self.click(picture(0))
        self.press("s")
        self.studio.wait_for("view", view=0, **{"as": "vertices"})
        self.select("left-hand")
        self.studio.stop()
        self.until(lambda: "does not answer" in self.find("#banners").text)
        self.studio = MockStudio(self.studio.project).start()
        self.studio.wait_for("view", view=0, **{"as": "vertices"})
        for view in range(4):
            self.studio.wait_for("painted", view=view)
        self.studio.wait_for("select", joint="left-hand")
        self.until(lambda: self.find("#banners").text, "")
        self.assertEqual(self.find('[data-key="name"]').get_attribute("value"), "left-hand")

    def test_the_token_leaves_the_address(self):
        self.assertNotIn("token", self.driver.current_url)

    def test_troubles_are_said(self):
        self.studio.tell({"is": "project", **self.studio.project, "problem": {"text": "joints[3] is no object", "line": 17}})
        self.until(lambda: "joints[3] is no object" in self.find("#banners .error").text)
        self.assertIn("line 17", self.find("#banners .error").text)
        self.studio.tell({"is": "state", "renderer": "The renderer ended.", "nodes": 0, "machines": 0})
        self.until(lambda: "The renderer ended." in self.find("#banners").text)
        self.studio.tell({"is": "refused", "do": "commit", "text": "is no joint"})
        self.until(lambda: "is no joint" in self.find("#messages").text)
        self.studio.tell({"is": "project", **self.studio.project, "problem": None})
        self.studio.tell({"is": "state", "renderer": "", "nodes": 2, "machines": 1})
        self.until(lambda: self.find("#banners").text, "")

    def test_messages_cover_nothing_and_stay_to_be_read(self):
        for number in range(3):
            self.studio.tell({"is": "remark", "text": f"Message {number} " + "of many words " * 30})
        self.until(lambda: "Message 2" in self.find("#messages").text)
        covers = """const at = document.querySelector("#messages .message").getBoundingClientRect();
                    return ["views", "panels", "tree"].filter((id) => {
                      const other = document.getElementById(id).getBoundingClientRect();
                      return at.left < other.right && at.right > other.left && at.top < other.bottom && at.bottom > other.top;
                    });"""
        self.assertEqual(self.js(covers), [])
        self.assertEqual(self.js("return document.documentElement.scrollWidth"), 1280)
        self.click("#messages .message")
        self.assertEqual([line.text[:9] for line in self.find_all(".message-lines li")],
                         ["Message 0", "Message 1", "Message 2"])

    def test_a_message_goes_when_something_else_is_done(self):
        self.select("left-shin")
        steps = {"a step": lambda: self.type('[data-key="pose.y"]', Keys.ARROW_RIGHT),
                 "undo": lambda: self.chord(Keys.CONTROL, "z"), "redo": lambda: self.chord(Keys.CONTROL, Keys.SHIFT, "z"),
                 "another screen": lambda: self.chord(Keys.F9)}
        for name, act in steps.items():
            with self.subTest(name):
                self.studio.tell({"is": "remark", "text": f"before {name}"})
                self.until(lambda: self.find("#messages").text, f"before {name}")
                act()
                self.until(lambda: self.find("#messages").text, "")
        self.click("#messages .message")
        self.assertEqual([line.text for line in self.find_all(".message-lines li")],
                         [f"before {name}" for name in steps])

    def test_a_page_of_a_studio_that_was_started_again_says_what_to_do(self):
        self.allowed = "/ws?token"
        self.studio.stop()
        self.until(lambda: "does not answer" in self.find("#banners").text)
        self.studio = MockStudio(self.studio.project, token="another").start()
        self.until(lambda: "Open the link that it has printed" in self.find("#banners").text)

    def test_what_is_no_picture_is_left_alone(self):
        self.studio.tell(b"nonsense")
        self.studio.show(0, [(0, 0, 1, 1)], b"\1\2\3\xff")
        self.until(lambda: self.pixels(0, 0, 0, 1, 1), [1, 2, 3, 255])


class Films(Page):
    kind = projects.film

    def of_menu(self, text):
        self.click(".title")
        self.click(".menu .text", text)

    def test_a_reload_brings_back_the_cameras_view_and_a_light(self):
        self.of_menu("Film's camera")
        self.click("[role=tab]", "Scene")
        self.click('[data-key="light/2"]')
        self.studio.wait_for("select", thing="light/2")
        self.studio.forget()
        self.driver.refresh()
        self.studio.wait_for("view", view=0, **{"from": "camera"})
        self.studio.wait_for("select", thing="light/2")

    def test_the_cameras_view_has_the_films_shape_and_a_free_one_places_the_camera(self):
        shape = self.studio.project["size"]
        self.of_menu("Film's camera")
        asked = self.studio.wait_for("view", view=0, **{"from": "camera"})
        self.assertAlmostEqual(asked["width"] / asked["height"], shape[0] / shape[1], delta=0.01)
        seen = self.find(".picture").rect
        self.assertTrue(asked["width"] <= seen["width"] + 1 and asked["height"] <= seen["height"] + 1)
        self.studio.tell({"is": "project", **self.studio.project, "size": [500, 500]})
        side = min(round(seen["width"]), round(seen["height"]))
        self.studio.wait_for("view", view=0, width=side, height=side)
        self.of_menu("Free")
        self.studio.wait_for("view", view=0, **{"from": "free"})
        self.of_menu("Put the film's camera here")
        self.assertEqual(self.studio.wait_for("put_camera")["view"], 0)

    def test_a_crowd_is_built_as_far_as_it_is_in_sight(self):
        actor = self.studio.project["actors"][0]
        crowd = [{**actor, "name": f"walker-{number}"} for number in range(300)]
        self.studio.project["actors"] = crowd
        self.driver.refresh()
        self.until(lambda: self.js("return document.querySelector('#tree .count')?.textContent"), "300")
        self.assertLess(self.js("return document.querySelectorAll('*').length"), 2000)
        self.js("const tree = document.querySelector('#tree [role=tree]'); tree.scrollTop = tree.scrollHeight")
        self.until(lambda: self.js("return document.querySelector('[data-key=walker-299]') !== null"))
        self.click("[data-key=walker-299] .twist")
        self.click("[data-key=walker-299] > .row")
        self.studio.wait_for("select", actor="walker-299")
        self.assertLess(self.js("return document.querySelectorAll('*').length"), 2000)

    def test_titles_leave_the_middle_of_narrow_views_free(self):
        """1440 x 900 at 150 percent."""
        self.addCleanup(self.browser.resize, *SIZE)
        self.browser.resize(960, 600, scale=1.5)
        self.of_menu("Film's camera")
        ends = lambda: self.js("""return [...document.querySelectorAll(".view")].map((view) => {  // noqa: E731
            const [all, title] = [view, view.querySelector(".title")].map((each) => each.getBoundingClientRect());
            return title.width > 40 && title.right < all.x + 0.44 * all.width;
        });""")
        self.until(ends, [True, True, True, True])
        self.assertEqual(self.find(".title strong").text, "Film's camera")

    def test_frames_are_scrubbed_and_played(self):
        self.type(".ruler", Keys.ARROW_RIGHT)
        self.studio.wait_for("frame", frame=25)
        self.js("document.activeElement.blur()")
        self.chord(".")
        self.studio.wait_for("frame", frame=26)
        for name, frame in (("Last frame", 119), ("First frame", 0), ("Next frame", 1)):
            self.click(f'[aria-label="{name}"]')
            self.studio.wait_for("frame", frame=frame)
        self.chord(Keys.SPACE)
        self.studio.wait_for("frame", count=5)  # it plays by the clock, whatever is left out
        self.chord(Keys.SPACE)

    def test_after_a_number_keys_are_the_views_again(self):
        for end, frames in ((Keys.ENTER, [7, 8]), (Keys.ESCAPE, [9])):
            with self.subTest(frames=frames):
                self.studio.forget()
                self.type('[data-key="frame"]', Keys.CONTROL, "a", Keys.NULL, "7", end)
                self.press(Keys.ARROW_LEFT)
                self.studio.wait_for("orbit", view=0, how="turn", moving=True)
                self.studio.wait_for("orbit", moving=False)  # soon after the last key
                self.press("s")
                self.studio.wait_for("view", view=0)
                self.press(".")
                self.assertEqual([each["frame"] for each in self.heard("frame")], frames)
        self.chord(Keys.F9)
        self.studio.forget()
        self.js("document.activeElement.blur()")
        self.press(Keys.ARROW_LEFT)
        self.assertEqual(self.heard("orbit"), [])  # no view shows

    def test_steps_name_their_actor_and_keys_show(self):
        self.click("[data-key=watcher] .twist")
        self.click('[data-key="watcher/head"] > .row')
        self.studio.wait_for("select", actor="watcher", joint="head")
        self.assertEqual(self.find(".keyed-state.on").text, "Key at this frame")
        self.type('[data-key="pose.z"]', Keys.ARROW_RIGHT)
        self.commit("animate pose watcher head=0,0,1 --frame 24 --clamp")
        self.click('[aria-label="Blend poses into the frames around"]')
        self.click(".menu .text", "8 frames to both sides")
        blend = self.find("#header .loud")
        self.assertEqual([blend.text, blend.accessible_name[:11]], ["Blend \u00b18 frames", "Blend is on"])
        self.type('[data-key="pose.z"]', Keys.ARROW_RIGHT)
        self.commit("animate pose watcher head=0,0,1 --falloff 8 --frame 24 --clamp")
        self.click(picture())
        self.studio.wait_for("grab", falloff=8)
        self.studio.wait_for("select", actor=None)
        self.click("[data-key=walker] > .row")
        self.until(lambda: self.find('[role="tab"][aria-selected="true"]').text, "Scene")
        self.type('[data-key="actor.place.x"]', Keys.ARROW_UP, Keys.ENTER)
        self.commit("animate pose walker place=0.1,0,0 --falloff 8 --frame 24")
        self.type('[data-key="camera.fov"]', Keys.ARROW_UP, Keys.ENTER)
        self.commit("animate pose camera fov=41 --falloff 8 --frame 24")

    def test_a_new_actor_is_placed_beside_others_and_selected(self):
        self.click("[data-key=walker] > .row")
        self.type('[data-key="cast.model"]', "ball")
        self.click('[data-key="cast.add"]')
        self.commit("film add ball --model ball --beside 24")
        ball = {**self.studio.project["actors"][0], "name": "ball", "joints": []}
        self.studio.tell({"is": "project", **self.studio.project, "actors": [*self.studio.project["actors"], ball]})
        self.studio.wait_for("select", actor="ball", joint=None)
        self.assertEqual(self.find('[data-key="actor.name"]').get_attribute("value"), "ball")

    def test_models_have_pictures_once_somebody_sees_them(self):
        names = ["man", "dog", "soldier.json", "cut.json", *(f"{number}.json" for number in range(20))]
        models = [{"name": name, "what": f"a {name}" if "." not in name else "", "kind": "file", "version": "1"} for name in names]
        self.studio.tell({"is": "models", "models": models})
        self.click("[data-key=walker] > .row")
        card = lambda name: self.find(f'[data-key="model.{name}"]')  # noqa: E731
        self.js("arguments[0].scrollIntoView()", card("man"))
        for name in names[:4]:
            self.studio.wait_for("thumbnail", model=name)
        self.assertNotIn("19.json", [each["model"] for each in self.heard("thumbnail")])  # it is out of sight
        state = lambda name: card(name).find_element(By.CLASS_NAME, "thumbnail").get_attribute("data-state")  # noqa: E731
        self.assertEqual([state("man"), card("man").accessible_name], ["awaited", "man"])
        self.studio.tell({"is": "thumbnail", "model": "man", "version": "1", "png": base64.b64encode(figure_picture()).decode()})
        self.studio.tell({"is": "thumbnail", "model": "cut.json", "version": "1", "problem": "cut.json:3: is no list (close it)"})
        self.until(lambda: [state(name) for name in names[:4]], ["there", "awaited", "awaited", "problem"])
        self.assertEqual(card("man").accessible_name, "man")
        self.assertEqual(self.js("""
            const canvas = arguments[0].querySelector("canvas"), {width, height} = canvas;
            const at = (x, y) => [...canvas.getContext("2d", {willReadFrequently: true}).getImageData(x * width, y * height, 1, 1).data][0] > 100;
            return [at(0.02, 0.5), at(0.5, 0.5), at(0.5, 0.12), at(0.5, 0.02)];""", card("man")), [False, True, True, False])  # it fills the place
        self.assertIn("cut.json:3: is no list", card("cut.json").text)
        self.click('[data-key="model.man"]')
        self.press(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.assertEqual(self.js("return document.activeElement.dataset.key"), "model.soldier.json")
        self.press(Keys.ENTER)
        self.assertEqual(self.find('[data-key="cast.model"]').get_attribute("value"), "soldier.json")
        self.assertEqual([card(name).get_attribute("aria-pressed") for name in names[:3]], ["false", "false", "true"])
        self.click('[data-key="cast.add"]')
        self.commit("film add soldier --model soldier.json --beside 24")
        self.studio.forget()
        self.studio.tell({"is": "models", "models": [{**each, "version": "2"} if each["name"] == "cut.json" else each for each in models]})
        self.studio.wait_for("thumbnail", model="cut.json")
        self.assertEqual([each["model"] for each in self.heard("thumbnail")], ["cut.json"])

    def test_the_camera_is_cut_at_the_frame(self):
        self.click("[data-key=walker] > .row")
        self.click('[data-key="camera.cut"]')
        self.commit("animate cut camera --frame 24")

    def test_check_boxes_have_the_size_of_check_boxes(self):
        self.click("[role=tab]", "Scripts")
        self.assertEqual(self.find('[data-key="script.lengthen"]').size, {"width": 15, "height": 15})

    def test_a_motion_lengthens_the_film_where_it_may(self):
        walk = {"name": "walk", "purpose": "Walk", "group": "figure", "needs": "hips", "parameters": []}
        self.studio.tell({"is": "actions", "actions": [walk]})
        self.click("[data-key=walker] > .row")
        self.click("[role=tab]", "Motions")
        self.click("[data-motion=walk]")
        self.assertTrue(self.find('[data-key="motion.lengthen"]').is_selected())
        self.click('[data-key="motion.apply"]')
        self.assertEqual(self.commit("animate walk walker")[-1], "--lengthen")
        self.studio.forget()
        self.click('[data-key="motion.lengthen"]')
        self.click('[data-key="motion.apply"]')
        self.assertNotIn("--lengthen", self.commit("animate walk walker"))

    def motions(self):
        """The tab, with a walker who is selected and may walk, jump or throw."""
        self.studio.tell({"is": "actions", "actions": [
            {"name": "walk", "purpose": "Walk", "group": "figure", "needs": "hips", "parameters": [
                {"name": "pace", "value": "N", "meaning": "steps a second; default: 2", "example": "1.5", "count": 1},
                {"name": "to", "value": "X Y", "meaning": "a place on the floor", "example": "2 -1", "count": 2},
                {"name": "step-length", "value": "D", "meaning": "default: 0.62 of the leg; on four legs less", "example": "0.7", "count": 1}]},
            {"name": "nod", "purpose": "Nod with head and neck", "group": "figure", "needs": "head", "parameters": [
                {"name": "first", "value": "SIDE", "meaning": "left or right; default: right", "example": "left", "count": 1},
                {"name": "seconds", "value": "S", "meaning": "default: 1", "example": "2", "count": 1}]},
            {"name": "throw", "purpose": "Fly with a velocity", "group": "kinematic", "needs": "", "parameters": [
                {"name": "to", "value": "X Y Z", "meaning": "where it comes down", "example": "1 2 0", "count": 3}]}]})
        self.click("[data-key=walker] > .row")
        self.click("[role=tab]", "Motions")

    def test_a_preview_of_a_motion_stays_while_frames_are_looked_at(self):
        self.motions()
        self.click("[data-motion=walk]")
        self.choose("motion.start", "frame")
        self.click('[data-key="motion.preview"]')
        self.until(lambda: self.find(".motion-end [role=status]").text, "Preview is on: play or scrub to see it.")
        walk = ["animate", "walk", "walker", "--at", "24", "--lengthen"]
        self.studio.wait_for("preview", step={"commands": [walk]})
        self.type(".ruler", Keys.ARROW_RIGHT)
        self.studio.wait_for("preview", count=2, step={"commands": [walk]})
        self.browser.settle()
        self.assertEqual([each["do"] for each in self.studio.heard if each["do"] in ("frame", "preview")], ["preview", "frame", "preview"])
        self.studio.tell({"is": "refused", "do": "preview", "text": "no room to walk"})
        self.until(lambda: self.find(".motion-end [role=status]").text, "no room to walk")
        self.click('[data-key="motion.apply"]')
        self.commit("animate walk walker --at 24")
        self.assertEqual(self.find('[data-key="motion.preview"]').get_attribute("aria-pressed"), "false")

    def test_another_step_ends_a_preview_of_a_motion(self):
        self.motions()
        self.click("[data-motion=walk]")
        self.click('[data-key="motion.preview"]')
        self.studio.wait_for("preview")
        self.chord(Keys.CONTROL, "z")
        self.until(lambda: self.find('[data-key="motion.preview"]').get_attribute("aria-pressed"), "false")
        self.assertEqual(self.find(".motion-end [role=status]").text, "")

    def test_a_motion_with_part_of_a_vector_is_not_sent(self):
        self.motions()
        self.click("[data-motion=throw]")
        for key in ("motion.to", "motion.to1"):
            self.type(f'[data-key="{key}"]', "2")
        for button in ("motion.apply", "motion.preview"):
            self.click(f'[data-key="{button}"]')
            self.until(lambda: self.find(".motion-problem").text, "To: give x, y and z")
        self.assertEqual(self.heard("commit") + self.heard("preview"), [])
        self.type('[data-key="motion.to2"]', "0")
        self.studio.wait_for("preview")
        self.click('[data-key="motion.apply"]')
        self.commit("animate throw walker --to 2 2 0")

    def test_numbers_of_a_motion_have_their_unit_and_may_be_expressions(self):
        self.motions()
        self.click("[data-motion=walk]")
        field = '[data-key="motion.step-length"]'
        self.assertEqual(self.find(field).get_attribute("placeholder"), "0.62 of the leg")
        self.assertEqual(self.js("return document.querySelector(arguments[0]).nextSibling.textContent", field), "units")
        self.type(field, "0,35*")
        self.click('[data-key="motion.apply"]')
        self.until(lambda: self.find(".motion-problem").text, "Step length: write a number, or an expression such as 1.5*2")
        self.type(field, "2")
        self.click('[data-key="motion.apply"]')
        self.commit("animate walk walker --step-length 0.7")

    def test_what_was_typed_for_a_motion_is_there_again(self):
        self.motions()
        self.click("[data-motion=walk]")
        self.type('[data-key="motion.pace"]', "1.5")
        self.choose("motion.start", "frame")
        self.click("[data-motion=nod]")
        self.choose("motion.first", "left")
        values = lambda *keys: [self.find(f'[data-key="motion.{key}"]').get_attribute("value") for key in keys]  # noqa: E731
        self.assertEqual(values("first", "seconds", "start"), ["left", "", "last"])
        self.click("[data-motion=walk]")
        self.assertEqual(values("pace", "to", "start"), ["1.5", "", "frame"])
        self.click("[data-motion=nod]")
        self.click('[data-key="motion.apply"]')
        self.commit("animate nod walker --first left --lengthen")

    def test_motions_and_their_parameters_say_what_they_mean(self):
        self.motions()
        self.assertEqual(self.find("[data-motion=throw]").get_attribute("title"), "Fly with a velocity.")
        self.click("[data-motion=nod]")
        for key, title in (("first", "Left or right; default: right."), ("seconds", "Default: 1. In seconds.")):
            with self.subTest(key):
                field = f'[data-key="motion.{key}"]'
                self.assertEqual(self.find(field).get_attribute("title"), title)
                self.assertEqual(self.find(f".line:has({field})").get_attribute("title"), title)
        self.click("[data-motion=walk]")
        self.assertEqual(self.find('[data-key="motion.to1"]').get_attribute("title"), "A place on the floor. In units of length.")
        self.assertEqual(self.find('[data-key="motion.pace"]').get_attribute("title"), "Steps a second; default: 2.")

    def test_an_actor_that_is_selected_is_named_in_the_joint_panel(self):
        self.click("[data-key=walker] > .row")
        self.click("[role=tab]", "Joint")
        self.until(lambda: "walker is selected as a whole" in self.find("#panels .panel:not([hidden]) .nothing").text)

    def test_the_tab_is_the_same_after_a_rendering_was_looked_at(self):
        self.click("[role=tab]", "Scene")
        shown = lambda: self.find('#panels [role="tab"][aria-selected="true"]').text  # noqa: E731
        self.click('[data-value="rendering"]')
        self.until(shown, "Rendering")
        self.click('[data-value="scene"]')
        self.until(shown, "Scene")

    def test_views_show_a_first_figure_that_was_added_to_a_floor(self):
        self.of_menu("Film's camera")
        self.studio.wait_for("view", view=0, **{"from": "camera"})
        one, other = self.studio.project["actors"]
        floor, man, ball = ({**one, "name": name, "joints": []} for name in ("floor", "man", "ball"))
        self.studio.tell({"is": "project", **self.studio.project, "actors": [floor]})
        self.until(lambda: self.find("#tree .count").text, "1")
        self.click("[data-key=floor] > .row")
        for actor, actors, shown in ((man, [floor, man], [1, 2, 3]), (ball, [floor, man, ball], [])):
            self.studio.forget()
            self.type('[data-key="cast.model"]', actor["name"])
            self.click('[data-key="cast.add"]')
            self.commit(f"film add {actor['name']}")
            self.studio.project["actors"] = actors
            self.studio.tell({"is": "project", **self.studio.project})
            self.studio.wait_for("select", actor=actor["name"])
            self.browser.settle()
            after = self.studio.heard[[each["do"] for each in self.studio.heard].index("select"):]
            self.assertEqual([each["view"] for each in after if each["do"] == "orbit" and each["how"] == "selected"], shown)

    def scene(self):
        """The tab, with all that is shut at first."""
        self.click("[role=tab]:nth-child(3)")
        self.js("for (const each of document.querySelectorAll('.more')) each.open = true")

    def write(self, key, text):
        self.type(f'[data-key="{key}"]', Keys.CONTROL, "a", Keys.NULL, text, Keys.ENTER)

    def choose(self, key, value):
        self.js("""const field = document.querySelector(arguments[0]);
                   field.value = arguments[1];
                   field.dispatchEvent(new Event("change"));""", f'[data-key="{key}"]', value)

    def keys_shown(self, of):
        return self.js(f"return [...document.querySelectorAll('[data-key^=\"{of}.\"]')].map((each) => each.dataset.key.split('.')[1])")

    def test_a_light_has_a_field_for_each_of_its_keys(self):
        self.scene()
        self.click('[data-key="light/2"]')
        keys = projects.keys()["light"]
        fields = lambda: list(dict.fromkeys(name for name in self.keys_shown("light") if name in keys))  # noqa: E731
        self.until(fields, [name for name, key in keys.items() if "spot" in key.get("of", ["spot"])])
        reach = self.find('[data-key="light.reach"]')
        self.assertEqual([reach.get_attribute("value"), reach.get_attribute("placeholder")], ["", "the same at all distances"])
        for key, text, words in (("reach", "5", "animate pose light/2 reach=5 --frame 24"),
                                 ("cone.inner", "20", "film light set 2 cone=20,40"), ("at.z", "2", "film light set 2 at=0,0,2"),
                                 ("softness", "0.75", "film light set 2 softness=0.75")):
            self.write(f"light.{key}", text)
            self.commit(words)  # at the frame only what has keys
        self.click('[data-key="light/1"]')
        self.until(fields, ["direction", "color", "intensity", "shadow", "size"])
        self.click('[data-key="light.add.spot"]')
        self.commit("film light add place=0,-4,5 at=0,0,1")

    def test_a_light_casts_where_its_box_is_ticked(self):
        self.scene()
        self.click('[data-key="light/1"]')
        shadow = self.find('input[type=checkbox][data-key="light.shadow"]')
        self.assertFalse(shadow.is_selected())
        self.click('input[type=checkbox][data-key="light.shadow"]')
        self.commit("film light set 1 shadow=true")
        size = self.find('[data-key="light.size"]')
        self.assertEqual([size.get_attribute("aria-valuemax"), self.js("return arguments[0].nextSibling.textContent", size)], ["90", "°"])
        self.write("light.size", "0.53")
        self.commit("film light set 1 size=0.53")
        self.click('[data-key="light/2"]')
        self.until(lambda: self.find('[data-key="light.size"]').get_attribute("aria-valuemax"), "1000000000")

    def test_what_is_typed_leaves_the_other_numbers_of_a_vector(self):
        self.scene()
        self.click('[data-key="light/1"]')
        self.type('[data-key="light.direction.x"]', Keys.CONTROL, "a", Keys.NULL, "1")
        lights = [dict(each) for each in self.studio.project["lights"]]
        lights[0]["direction"] = [0.6, 0, 0.8]  # the studio shows a direction at its length, 1
        self.studio.tell({"is": "poses", "frame": 24, "actors": [], "camera": self.studio.project["camera"], "lights": lights})
        self.type('[data-key="light.direction.x"]', Keys.ENTER)
        self.commit("film light set 1 direction=1,0,1")

    def test_camera_and_film_have_fields_for_their_keys(self):
        self.scene()
        keys = projects.keys()
        self.assertLessEqual(set(keys["camera"]), set(self.keys_shown("camera")))
        self.assertLessEqual(set(keys["film"]), set(self.keys_shown("film")))
        for key, text, words in (("camera.exposure", "1.5", "animate pose camera exposure=1.5 --frame 24"),
                                 ("camera.up.y", "1", "film camera up=0,1,1"),
                                 ("camera.near", "0.5", "film camera near=0.5"),
                                 ("film.rate", "23.976", "film set rate=23.976"),
                                 ("film.size.height", "600", "film set size=960,600"),
                                 ("film.dice", "8", "film set dice=8"),
                                 ("film.grain", "0.25", "film set grain=0.25")):
            self.write(key, text)
            self.commit(words)
        self.choose("film.samples", "16")
        self.commit("film set samples=16")
        self.choose("film.curve", "none")
        self.commit("film set curve=none")
        self.assertIn("frames per second", self.find(".line:has([data-key='film.rate'])").get_attribute("title").lower())

    def test_what_is_seldom_needed_is_shut_at_first(self):
        self.click("[role=tab]:nth-child(3)")
        self.assertEqual(self.js("""const near = document.querySelector('[data-key="camera.near"]');
                                    return near.closest('details:not([open])').querySelector('summary').dataset.key;"""), "more Camera")
        self.click('[data-key="more Camera"]')
        self.write("camera.near", "0.5")
        self.commit("film camera near=0.5")

    def test_a_rendering_is_started_shown_and_stopped(self):
        self.chord(Keys.F9)
        self.until(lambda: self.find("#rendering").is_displayed())
        self.type('[data-key="render.nodes"]', "3")
        self.click(".primary")
        self.assertEqual(self.studio.wait_for("render")["options"], {"folder": "out", "nodes": 3})
        self.click("button", "Make video")
        self.assertEqual(self.studio.wait_for("render", count=2)["options"], {"folder": "out", "nodes": 3, "video": "out.mp4"})
        self.studio.tell({"is": "rendering", "state": "running", "text": "", "done": 4, "of": 12, "fps": 2.5, "folder": "out",
                          "nodes": [{"name": "node 0", "machine": "here", "slow": False}, {"name": "node 1", "machine": "there", "slow": True}]})
        self.until(lambda: "4 of 12 frames, 2.5 a second" in self.find(".progress-words").text)
        self.studio.show(255, [(0, 0, 32, 32)], bytes((10, 20, 30, 255)) * 1024, size=(32, 32))
        self.studio.tell({"is": "drawn", "frame": 4, "kind": "inbetween", "interval": 1, "seconds": 0.5,
                          "nodes": [{"node": 0, "lines": [[0, 15]], "seconds": {"raster": 0.4}}, {"node": 1, "lines": [[16, 31]], "seconds": {"wait": 0.1}}],
                          "ebc": [1, 2], "flagged": bits([True, False, False, True]), "moving": bits([True, False, False, False]),
                          "still": bits([True, True, False, False]), "whole": True, "block": 16})
        self.until(lambda: "Frame 4" in self.find(".caption").text)
        shown = "return [...document.querySelector(arguments[0]).getContext('2d').getImageData(...arguments[1]).data]"
        self.until(lambda: self.js(shown, ".sheet canvas", [31, 31, 1, 1]), [10, 20, 30, 255])
        self.click('[data-overlay="moving"]')
        blocks = [self.js(shown, ".overlay", [x, y, 1, 1]) for x, y in ((8, 8), (24, 8), (8, 24), (24, 24))]
        self.assertGreater(blocks[0][0], 200)  # moves: tinted
        self.assertEqual([block[3] > 0 for block in blocks], [True, True, False, False])
        self.js("""const slider = document.querySelector('.scrub input');
                   slider.value = 2;
                   slider.dispatchEvent(new Event("input"));""")
        self.studio.wait_for("scrub", frame=2)
        self.click(".actions button", "Stop")
        self.studio.wait_for("stop")


class Sources(unittest.TestCase):
    def test_the_page_has_no_inline_script_or_style_and_no_far_files(self):
        html = (PAGE / "index.html").read_text()
        self.assertNotRegex(html, r"<style|style=|\son\w+=|<script(?! type=\"module\" src=)")
        for file in PAGE.rglob("*"):
            if file.suffix in (".js", ".css", ".html"):
                self.assertNotRegex(file.read_text().replace("http://www.w3.org/2000/svg", ""), r"https?://", file.name)

    def test_every_file_is_used(self):
        texts = {file: file.read_text() for file in PAGE.rglob("*") if file.is_file()}
        for file in texts:
            if file.name != "index.html":
                self.assertTrue(any(file.name in text for other, text in texts.items() if other != file), file.name)


if __name__ == "__main__":
    main()
