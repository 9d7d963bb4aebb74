"""The timeline of a film in a headless Chromium: what hands do to keys leaves as the commands that a person would
type. Takes what page_test.py takes."""

import time

from selenium.webdriver.common.keys import Keys

import projects
from channels import channels, key
from page_test import Page, main

SHIFT, ALT = 8, 1


class Timeline(Page):
    kind = projects.film

    def setUp(self):
        super().setUp()
        self.studio.channels = channels()
        self.studio.tell({"is": "channels", "things": self.studio.channels})
        self.click("[data-row=walker] .twist")
        self.until(lambda: len(self.find_all(".key-row")), 6)

    # Where a key is, in pixels of the page: rows and the ruler's numbers are known to hands, too.

    def x(self, frame):
        self.browser.settle()
        left, width = self.js("const at = document.querySelector('.ruler').getBoundingClientRect(); return [at.x, at.width]")
        return left + 18 + frame * (width - 36) / (self.studio.project["frames"] - 1)

    def y(self, row):
        self.browser.settle()
        return self.js("const at = document.querySelector(arguments[0]).getBoundingClientRect(); return at.y + at.height / 2", f'[data-row="{row}"]')

    def click_at(self, row, frame, keys=0):
        self.browser.click(self.x(frame), self.y(row), keys=keys)

    def pull(self, begin, end, keys=0, drop=True):
        self.browser.drag(begin, end, steps=5, keys=keys, drop=drop)

    def drag(self, row, frame, to, keys=0, drop=True):
        y = self.y(row)
        self.pull((self.x(frame), y), (self.x(to), y), keys, drop)

    def commands(self, count=1):
        """The commands of the last step, when there were `count` steps."""
        self.studio.wait_for("commit", count=count)
        return [" ".join(words) for words in self.studio.wait_for("commit", count=count)["step"]["commands"]]

    def test_a_key_is_dragged_previewed_and_shown_as_a_command(self):
        self.drag("walker left-shin", 20, 24)
        self.assertEqual(self.commands(), ["animate move walker left-shin --frame 20 --to 24"])
        self.studio.wait_for("preview", step={"commands": [["animate", "move", "walker", "left-shin", "--frame", "20", "--to", "24"]]})
        self.until(lambda: self.find(".commands").text,
                   "mars animate examples/demo.json move walker left-shin --frame 20 --to 24")

    def test_escape_gives_a_drag_up(self):
        self.drag("walker left-shin", 20, 24, drop=False)
        self.press(Keys.ESCAPE)
        self.studio.wait_for("cancel")
        self.browser.release(self.x(24), self.y("walker left-shin"))
        self.assertEqual(self.heard("commit"), [])

    def test_keys_of_a_frame_move_with_alt_as_copies(self):
        self.drag("walker", 20, 30, keys=ALT)
        self.assertEqual(self.commands(), ["animate copy walker --frame 20 --to 30"])
        self.studio.forget()
        self.drag("", 0, 10)  # the row of all keys
        self.assertEqual(self.commands(), ["animate move --all --frame 0 --to 10"])

    def test_runs_that_pass_over_others_go_in_their_order(self):
        self.click_at("walker left-shin", 0)
        self.click_at("walker left-shin", 40, keys=SHIFT)
        self.drag("walker left-shin", 40, 70)
        self.assertEqual(self.commands(), ["animate move walker left-shin --frame 40 --to 70",
                                           "animate move walker left-shin --frame 0 --to 30"])
        self.studio.forget()
        self.click_at("walker left-shin", 20)
        self.click_at("walker left-shin", 60, keys=SHIFT)
        self.drag("walker left-shin", 60, 50)
        self.assertEqual(self.commands(), ["animate move walker left-shin --frame 20 --to 10",
                                           "animate move walker left-shin --frame 60 --to 50"])

    def test_a_drag_goes_on_where_the_studio_never_answers_the_one_before(self):
        self.drag("walker left-shin", 40, 70)
        self.studio.wait_for("commit")
        self.drag("walker left-shin", 20, 30, drop=False)
        time.sleep(1.6)  # as long as the page waits for an answer
        self.browser.release(self.x(30), self.y("walker left-shin"))
        self.assertEqual(self.commands(2), ["animate move walker left-shin --frame 20 --to 30"])

    def test_a_box_is_eased_by_the_menu_and_deleted(self):
        self.pull((self.x(15), self.y("walker left-shin") - 8), (self.x(45), self.y("walker head") + 8))
        self.press("e")
        self.until(lambda: self.js("return document.activeElement.role"), "menuitemradio")
        self.click(".menu .text", "Begin and end slowly")
        self.assertEqual(self.commands(), ["animate time walker left-shin head --frame 20-40 --ease both"])
        self.studio.forget()
        self.click(".drawing")
        self.press(Keys.CONTROL, "a")
        self.press(Keys.DELETE)
        self.assertEqual(self.commands(), ["animate delete --all --frame 0-60"])

    def test_between_dense_keys_a_box_begins(self):
        dense = {"name": "left-shin", "axes": ["y"], "keys": [key(frame, 40) for frame in range(120)]}
        self.studio.channels = [{"thing": "walker", "kind": "actor", "parts": [dense]}]
        self.studio.tell({"is": "channels", "things": self.studio.channels})
        self.until(lambda: self.find_all('[data-row="walker head"]'), [])
        x, y = self.x(20), self.y("walker left-shin")
        self.pull((x + 4, y - 10), (self.x(21) + 4, y + 10))
        self.assertEqual(self.heard("preview") + self.heard("commit"), [])
        self.press(Keys.DELETE)
        self.assertEqual(self.commands(), ["animate delete walker --frame 21"])
        self.studio.forget()
        self.pull((x + 3, y - 5), (self.x(24) + 3, y - 5))
        self.assertEqual(self.commands(), ["animate move walker --frame 20 --to 24"])

    def listed(self):
        self.click(".commands")
        lines = self.js("return [...document.querySelectorAll('.command-lines li')].map((line) => line.textContent)")
        self.js("document.querySelector('.popover').hidePopover()")
        self.until(lambda: self.js("return document.querySelector('.popover')"), None)
        return [" ".join(line.split()[3:]) for line in lines]

    def history(self, undo, redo):
        """The studio's answer to an undo or a redo."""
        self.studio.project |= {"undo": undo, "redo": redo}
        self.studio.tell({"is": "project", **self.studio.project})

    def shown(self):
        return " ".join(self.find(".commands").text.split()[3:])

    def test_undone_commands_leave_the_list_until_they_are_redone(self):
        self.studio.project["undo"] = "walk tom"  # another page's
        self.drag("walker left-shin", 20, 24)
        self.until(self.shown, "move walker left-shin --frame 20 --to 24")
        self.drag("walker left-shin", 40, 44)
        self.until(self.shown, "move walker left-shin --frame 40 --to 44")
        both, name = self.listed(), self.studio.project["undo"]
        self.chord(Keys.CONTROL, "z")
        self.studio.wait_for("undo")
        self.history(name, name)  # both steps have the same name
        self.until(self.shown, both[0])
        self.assertEqual(self.listed(), both[:1])
        self.chord(Keys.CONTROL, "z")
        self.studio.wait_for("undo", count=2)
        self.history("walk tom", name)
        self.until(self.shown, "")
        self.assertEqual(self.listed(), [])
        self.chord(Keys.CONTROL, "z")
        self.history(None, "walk tom")
        for undo, redo, lines in (("walk tom", name, []), (name, name, both[:1]), (name, None, both)):
            self.chord(Keys.CONTROL, Keys.SHIFT, "z")
            self.history(undo, redo)
            self.until(self.listed, lines)

    def test_what_another_page_did_and_undid_leaves_the_list_alone(self):
        self.drag("walker left-shin", 20, 24)
        self.until(self.shown, "move walker left-shin --frame 20 --to 24")
        own, name = self.listed(), self.studio.project["undo"]
        self.history("add ball", None)
        self.chord(Keys.CONTROL, "z")
        self.studio.wait_for("undo")
        self.history(name, "add ball")
        self.assertEqual(self.listed(), own)
        self.history(None, name)  # another page undoes it
        self.until(self.listed, [])
        self.history("add lamp", None)
        self.assertEqual(self.listed(), [])
        self.drag("walker left-shin", 20, 24)
        self.until(self.listed, own)

    def choose(self, text):
        self.until(lambda: self.js("return document.activeElement.role ?? ''").startswith("menuitem"))
        self.click(".menu .text", text)

    def test_keys_hold_and_many_are_reduced_to_few(self):
        self.click_at("walker left-shin", 20)
        self.press("e")
        self.choose("Hold, then jump")
        self.assertEqual(self.commands(), ["animate time walker left-shin --frame 20 --ease hold"])
        self.studio.forget()
        self.pull((self.x(-1), self.y("walker left-shin") - 8), (self.x(45), self.y("walker head") + 8))
        self.press("t")
        self.choose("Reduce\u2026")
        self.press(Keys.CONTROL, "a", Keys.NULL, "0.5", Keys.ENTER)
        self.assertEqual(self.commands(), ["animate reduce walker left-shin head --error 0.5 --frame 0-40"])
        self.studio.forget()
        self.click(".drawing")
        self.press(Keys.CONTROL, "a")
        self.press("t")
        self.choose("Reduce\u2026")
        self.press(Keys.ENTER)
        self.assertEqual(self.commands(), ["animate reduce camera --error 1 --frame 0-60", "animate reduce walker --error 1 --frame 0-60"])

    def test_copies_are_put_at_the_frame_and_keys_inserted(self):
        self.click_at("walker head", 20)
        self.press(Keys.CONTROL, "c")
        self.press(Keys.CONTROL, "v")
        self.assertEqual(self.commands(), ["animate copy walker head --frame 20 --to 24"])
        self.studio.forget()
        self.press("i")
        self.assertEqual(self.commands(), ["animate key walker head --frame 24"])

    def curves(self, row):
        self.click(f'[data-row="{row}"]')
        self.press("k")
        self.studio.wait_for("curves", thing="walker", parts=[row.split()[1]])
        self.until(lambda: self.find(".drawing .nothing").is_displayed(), False)

    # Values of curves as a page shows them: from the least to the greatest, 26 pixels above and below.
    def curve_y(self, value, least, most):
        top, height = self.js("const at = document.querySelector('[data-shown=curves] .panel:not([hidden]) .drawing').getBoundingClientRect(); return [at.y, at.height]")
        return top + height - 26 - (value - least) * (height - 52) / (most - least)

    def test_points_and_slopes_of_curves_are_pulled(self):
        self.click("[data-row=walker]")
        self.curves("walker left-shin")
        spot = lambda frame, value: (self.x(frame), self.curve_y(value, 0, 50))  # noqa: E731
        self.browser.click(*spot(20, 50))
        # The key's own slope is half a degree a frame, from the key before to the one after.
        self.pull(spot(20 + 20 / 3, 50 + 20 / 3 * 0.5), spot(30, 50))
        [command] = self.commands()
        self.assertRegex(command, r"^animate tangent walker left-shin.y --frame 20 --out -?0(\.0\d+)?$")
        self.studio.forget()
        self.pull(spot(60, 0), spot(60, 25))
        [command] = self.commands()
        self.assertRegex(command, r"^animate pose walker left-shin.y=2[45](\.\d+)? --frame 60 --clamp$")

    def test_a_curve_is_seen_between_dense_keys(self):
        frames = 1400
        dense = {"name": "left-shin", "axes": ["y"], "keys": [key(frame, 40) for frame in range(frames)]}
        self.studio.channels = [{"thing": "walker", "kind": "actor", "parts": [dense]}]
        self.studio.project["frames"] = frames
        self.studio.tell({"is": "project", **self.studio.project})
        self.studio.tell({"is": "channels", "things": self.studio.channels})
        drawn = """
            const canvas = document.querySelector("[data-shown=curves] .panel:not([hidden]) .drawing canvas"), {width, height} = canvas;
            const {data} = canvas.getContext("2d").getImageData(0, 0, width, height), columns = [];
            for (let x = 40; x < width - 40; ++x) {
              let colored = 0;
              for (let y = 0; y < height; ++y) {
                const at = 4 * (y * width + x), part = [data[at], data[at + 1], data[at + 2]];
                colored += Math.max(...part) - Math.min(...part) > 60;
              }
              columns.push(colored);
            }
            return [columns.filter((each) => each > 0 && each < 4).length / columns.length, columns.filter((each) => each > 0).length];"""
        for picked in (True, False):
            with self.subTest(picked=picked):
                self.curves("walker left-shin") if picked else self.press(Keys.ESCAPE)
                self.until(lambda: self.js(drawn)[1] > 100)
                self.assertGreater(self.js(drawn)[0], 0.4)

    def test_the_selected_keys_numbers_are_typed(self):
        self.click_at("walker left-shin", 40)
        self.click('[data-key="key.y"]')
        self.press("12.5", Keys.ENTER)  # over what the click has selected
        self.assertEqual(self.commands(), ["animate pose walker left-shin.y=12.5 --frame 40 --clamp"])
        self.click('[data-key="key.flat"]')
        self.assertEqual(self.commands(2), ["animate tangent walker left-shin --frame 40 --flat"])

    def test_thousands_of_keys_are_drawn_and_selected(self):
        parts = [{"name": f"joint-{i}", "axes": ["x"], "keys": [key(frame, i) for frame in range(120)]} for i in range(200)]
        self.studio.tell({"is": "channels", "things": [{"thing": "walker", "kind": "actor", "parts": parts}]})
        self.until(lambda: self.js("return document.querySelectorAll('.key-row').length < 20 && document.querySelector('[data-row=\"walker joint-3\"]') !== null"))
        begin = self.browser.worked()
        self.click(".drawing")
        self.press(Keys.CONTROL, "a")
        self.until(lambda: self.find(".key-values").text, "24000 keys selected, at 120 frames")
        self.assertLess(self.browser.worked() - begin, 4)
        self.press(Keys.DELETE)
        self.assertEqual(self.commands(), ["animate delete walker --frame 0-119"])


if __name__ == "__main__":
    main()
