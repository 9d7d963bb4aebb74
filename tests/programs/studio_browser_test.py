"""mars studio in a headless Chromium, with mouse and keyboard alone: the tutorial's figure is made, a limb is dragged
to its limit, pictures are the film's own frames, and what dies comes back."""

import base64
import functools
import json
import re
import signal
import urllib.parse

from selenium.webdriver.support.ui import Select

from harness import *
from studio_browser import CTRL, PATIENCE, SHIFT, Browser, Proxy, Studio, tree_of

# Counts what the studio says and what the page paints, and keeps which banners came; a person sees all of them.
PROBE = """
window.seen = {projects: 0, painted: 0, exact: null, banners: []};
new MutationObserver((changes) => {
  for (const {addedNodes} of changes)
    for (const node of addedNodes) if (node.matches?.(".banner")) window.seen.banners.push(node.dataset.about);
}).observe(document, {childList: true, subtree: true});
{
  const Plain = window.WebSocket, send = Plain.prototype.send;
  window.WebSocket = class extends Plain {
    constructor(...all) {
      super(...all);
      this.addEventListener("message", ({data}) => {
        if (typeof data !== "string") {
          const head = new DataView(data), view = head.getUint32(4, true), flags = head.getUint16(26, true);
          window.seen.exact = (flags & 3) === 3 ? view : null;
          return;
        }
        const message = JSON.parse(data);
        // After the page's own listeners.
        if (message.is === "project") queueMicrotask(() => { ++window.seen.projects; window.seen.project = message; });
      });
    }
  };
  Plain.prototype.send = function (text) {
    if (JSON.parse(text).do === "painted") ++window.seen.painted;
    return send.call(this, text);
  };
}
"""
NO_STUDIO = ["WebSocket connection", "net::ERR_CONNECTION_REFUSED"]  # Chromium's words, one line or the other
JOINTS = "window.seen.project.actors[0].joints"
FILM = {
    "frames": 1, "size": [640, 360], "background": [0.65, 0.76, 0.86],
    "camera": {"eye": [5, -2, 1.6], "at": [0, 0, 0.9], "fov": 30},
    "lights": [{"direction": [0.5, -0.8, 0.9], "intensity": 1.4}],
    "models": {"human": "human.json"},
    "actors": [{"name": "human", "model": "human"}],
}
SAME_PIXELS = """
const [canvas, encoded, done] = arguments;
(async () => {
  const bytes = Uint8Array.from(atob(encoded), (letter) => letter.charCodeAt(0));
  const frame = await createImageBitmap(new Blob([bytes], {type: "image/png"}), {colorSpaceConversion: "none"});
  const other = new OffscreenCanvas(frame.width, frame.height).getContext("2d", {willReadFrequently: true});
  other.drawImage(frame, 0, 0);
  const pixels = (context) => context.getImageData(0, 0, canvas.width, canvas.height).data;
  const [shown, wanted] = [pixels(canvas.getContext("2d")), pixels(other)];
  let different = canvas.width === frame.width && canvas.height === frame.height ? 0 : -1;
  if (different === 0) for (let i = 0; i < shown.length; ++i) different += shown[i] !== wanted[i];
  done(different);
})();
"""


@functools.cache
def one_browser():
    browser = Browser(script=PROBE, patience=300 if SANITIZED else PATIENCE)
    unittest.addModuleCleanup(browser.driver.quit)
    return browser


class StudioInBrowser(ProgramTest):
    def setUp(self):
        super().setUp()
        self.browser = one_browser()

    def start(self, file, *arguments):
        studio = self.enterContext(Studio(PROGRAMS, file, *arguments))
        self.addCleanup(self.browser.open, "about:blank")  # or the page goes on looking for its studio
        self.show(studio.link)
        return studio

    def show(self, link):
        self.browser.console()
        self.browser.logged.clear()
        self.browser.open(link)
        self.until("the project", "window.seen.projects > 0")

    def until(self, what, condition):
        return self.browser.until(what, condition)

    def pictures_in_all_views(self):
        self.until("pictures", "document.querySelectorAll('.view .waiting[hidden]').length === 4")

    def no_complaint(self, *expected):
        """A page of the test before may still look for its studio, which has another port."""
        own = urllib.parse.urlsplit(self.browser.driver.current_url).netloc
        about_others = re.compile(rf"//127\.0\.0\.1:(?!{own.rpartition(':')[2]}/)\d+/ws")
        others = [line for line in self.browser.console()
                  if not any(each in line for each in expected) and not about_others.search(line)]
        self.assertEqual(others, [])

    def banner(self, about, text):
        self.until(f"the banner {text}", lambda: text in self.browser.run(
            "return document.querySelector(`.banner[data-about=${arguments[0]}]`)?.textContent ?? ''", about))

    def no_banner(self, about):
        self.until(f"no banner {about}", f"document.querySelector('.banner[data-about={about}]') === null")

    def project(self):
        return self.browser.run("return window.seen.project")

    # ---- hands

    def changed_by(self, act):
        """Until the studio has said what came of it."""
        self.browser.settle()
        before = self.browser.run("return window.seen.projects")
        act()
        self.until("the project's change", f"window.seen.projects > {before}")

    def click(self, selector, text=None, keys=0):
        self.browser.click_on(selector, text, keys=keys)

    def keys(self, name, shown="", modifiers=0):
        with self.browser.still():
            self.browser.key(name, shown, modifiers)

    def enter(self):
        self.keys("Enter", "\r")

    def type(self, selector, text, enter=False):
        """In place of what the field has."""
        with self.browser.on(selector) as (field, place):
            self.browser.click(*place)
            self.browser.run("arguments[0].select()", field)
            self.browser.command("Input.insertText", text=text)
            if enter:
                self.browser.key("Enter", "\r")

    def write(self, key, text):
        """Into a field of the panel, if it is not there yet."""
        field = f'[data-key="{key}"]'
        shown = self.of(field, "value")
        if shown == text or (isinstance(text, float) and number(shown) == text):
            return
        self.changed_by(lambda: self.type(field, f"{text:g}" if isinstance(text, float) else text, enter=True))

    def of(self, field, member):
        """What a field of the settled page has."""
        with self.browser.on(field) as (element, _):
            return self.browser.run("return arguments[0][arguments[1]]", element, member)

    def choose(self, key, value):
        field = f'[data-key="{key}"]'
        if self.of(field, "value") != value:
            self.changed_by(lambda: self.pick(field, value))

    def pick(self, field, value):
        with self.browser.on(field) as (element, _):
            Select(element).select_by_value(value)

    def toggle(self, key, on):
        field = f'[data-key="{key}"]'
        if self.of(field, "checked") != on:
            self.changed_by(lambda: self.click(field))

    def select(self, joint):
        self.click(f'[role=treeitem][aria-label="{joint}"] > .row')
        self.until(f"{joint} selected", lambda: self.browser.run(
            "return document.querySelector('[data-key=name]')?.value === arguments[0]", joint))

    def press(self, text):
        """A button of the panels with this text."""
        self.changed_by(lambda: self.click("#panels button", text))

    def tab(self, text):
        self.click("[role=tab]", text)

    def choose_entry(self, text):
        self.click(".menu .text", text)

    def menu(self, view, text):
        """An entry of a view's menu."""
        self.click(f".title[data-view='{view}']")
        self.choose_entry(text)


class TutorialTest(StudioInBrowser):
    """docs/tutorial.md, "A figure"."""

    def wanted(self):
        commands = re.findall(r"```sh\n(.*?)```", (SOURCES / "docs" / "tutorial.md").read_text(), re.S)[:2]
        folder = self.folder / "commands"
        folder.mkdir()
        lines = "\n".join(commands).partition("mars preview")[0]
        made = subprocess.run(["sh", "-c", lines], cwd=folder, capture_output=True, text=True, timeout=SECONDS,
                              env=dict(ENVIRONMENT, PATH=f"{PROGRAMS}:{os.environ['PATH']}"))
        self.assertEqual(made.returncode, 0, made.stderr)
        return json.loads((folder / "pip.json").read_text())

    def make_material(self, name, color):
        self.press("Add")
        self.write("material.name", name)
        self.changed_by(lambda: self.browser.run("""
            const field = document.querySelector('[data-key="material.color"]');
            field.value = arguments[0];
            for (const what of ["input", "change"]) field.dispatchEvent(new Event(what, {bubbles: true}));""",
            "#" + "".join(f"{round(part * 255):02x}" for part in color)))

    def make_joint(self, joint, limb):
        if "parent" in joint:
            self.select(joint["parent"])
            self.changed_by(lambda: self.keys("A", modifiers=SHIFT))
            self.until("the new joint", "document.querySelector('[data-key=name]')?.value.startsWith('joint-')")
        else:
            self.select("body")  # that a new model begins with
        self.write("name", joint["name"])
        self.until("its name", f"document.querySelector('[data-key=name]').value === '{joint['name']}'")
        segment = joint["segment"]
        self.choose("shape", segment["shape"])
        for corner in (0, 1):
            for axis, part in zip("xyz", segment["sbb"][corner]):
                self.write(f"sbb.{corner}.{axis}", float(part))
        if "edge" in segment:
            edges = segment["edge"] if isinstance(segment["edge"], list) else 3 * [segment["edge"]]
            for axis, part in zip("xyz", edges):
                self.write(f"option.edge.{axis}", float(part))
        self.choose("material", segment["material"])
        for axis, part in zip("xyz", joint.get("place", [0, 0, 0])):
            self.write(f"place.{axis}", float(part))
        if limb:
            self.choose("limb", limb)
        limits = joint.get("limits", {axis: None for axis in "xyz"} if "parent" not in joint else {})
        for axis in "xyz":
            self.toggle(f"free.{axis}", axis in limits)
            for at, angle in enumerate(limits.get(axis) or []):
                self.write(f"limit.{axis}.{at}", float(angle))

    def test_figure(self):
        wanted = self.wanted()
        file = self.folder / "figure.json"
        studio = self.start(self.folder)
        limbs = {joint: limb for limb, joint in flat(wanted["limbs"])}
        self.tab("Materials")
        for name, material in wanted["materials"].items():
            self.make_material(name, material["color"])
        self.tab("Joint")
        for joint in wanted["joints"]:
            if not joint["name"].startswith("right"):
                self.make_joint(joint, limbs.get(joint["name"]))
        self.select("pelvis")
        self.press("Left to right")
        self.maxDiff = None
        self.assertEqual(comparable(json.loads(file.read_text())), comparable(wanted))
        self.all_views_show_it()
        self.undo_and_redo(file)
        self.change_outside(file)
        self.drag_to_limit(file)
        self.no_complaint("willReadFrequently")
        self.assertEqual(studio.end(), (0, ""))

    def all_views_show_it(self):
        blue = """return [...document.querySelectorAll(".view canvas")].map((canvas) => {
            const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            let blue = 0;
            for (let i = 0; i < data.length; i += 4) blue += data[i + 2] > data[i] + 60;
            return blue;
        })"""
        for view in range(4):
            self.click(f"[data-key=view-{view}]")
            self.keys("a")
        self.until("the figure's blue in all views", lambda: all(count > 40 for count in self.browser.run(blue)))

    def undo_and_redo(self, file):
        made = file.read_text()
        self.changed_by(lambda: self.keys("z", modifiers=CTRL))
        self.assertNotIn("right-arm", file.read_text())
        self.changed_by(lambda: self.keys("Z", modifiers=CTRL | SHIFT))
        self.assertEqual(file.read_text(), made)

    def change_outside(self, file):
        made = file.read_text()
        self.changed_by(lambda: file.write_text(made.replace('"left-arm"', '"port-arm"')))
        self.assertIn("port-arm", [joint["name"] for joint in self.project()["actors"][0]["joints"]])
        before = made.partition('"materials": {')[0]
        file.write_text(made.replace('"materials": {', '"materials": {,'))
        self.banner("file", f"{file.name}:{before.count(chr(10)) + 1}:")
        file.write_text(made)
        self.no_banner("file")
        self.until("the file as it was", f"{JOINTS}.some(({{name}}) => name === 'left-arm')")

    def drag_to_limit(self, file):
        """A pose of a model is shown, in no file."""
        made = file.read_text()
        view = self.browser.run("return document.querySelector('[data-key=view-1]')")
        at = self.browser.find(view, "head y")
        self.browser.drag(at, (at[0] + 150, at[1] + 100))
        self.until("the head's limit", f"{JOINTS}.find(({{name}}) => name === 'head').pose[1] === 35")
        self.assertEqual(file.read_text(), made)


class FilmTest(StudioInBrowser):
    """A film of the tutorial's kind: what pictures show, and what dies."""

    def film(self):
        (self.folder / "films").mkdir()
        (self.folder / "films" / "film.json").write_text(json.dumps(FILM))
        shutil.copy(EXAMPLES / "models" / "human.json", self.folder / "films" / "human.json")
        return self.folder / "films" / "film.json"

    def show_limb(self):
        self.pictures_in_all_views()
        view = self.browser.run("return document.querySelector('[data-key=view-0]')")
        return self.browser.find(view, " y ")

    def wave(self, at, until):
        """The mouse moves on, until `until` is true."""
        step, last = 0, time.monotonic() + self.browser.patience
        while not until():
            step += 1
            self.browser.move(at[0] + 5 * (step % 8), at[1] + 10)
            self.browser.settle()
            self.assertLess(time.monotonic(), last)

    def host_of(self, studio):
        return [process for process, words in tree_of(studio.process.pid).items() if words[0].endswith("mars-threads")]

    def test_picture_is_the_films_frame(self):
        file = self.film()
        self.start(file)
        self.pictures_in_all_views()
        self.browser.run("document.querySelector('[data-key=view-3]').focus()")
        self.keys("f")
        size = self.until("the view's size", """(() => {
            const {width, height} = document.querySelector('[data-key=view-3] canvas');
            return width > 600 ? [width, height] : null; })()""")
        self.changed_by(lambda: file.write_text(json.dumps(dict(FILM, size=size))))
        self.menu(3, "Film's camera")
        self.until("the film's own pixels", "window.seen.exact === 3")
        rendered = self.mars("render", file, "-o", self.folder / "frames", "--frames", "0", "--quiet")
        self.assertEqual(rendered.returncode, 0, rendered.stderr)
        frame = base64.b64encode(next((self.folder / "frames").glob("*.png")).read_bytes()).decode()
        different = self.browser.driver.execute_async_script(
            SAME_PIXELS, self.browser.driver.find_element("css selector", "[data-key=view-3] canvas"), frame)
        self.assertEqual(different, 0)
        self.no_complaint("willReadFrequently")

    def test_fields_of_the_table_change_the_file(self):
        spot = {"place": [3, -4, 5], "at": [0, 0, 1]}
        file = self.film()
        file.write_text(json.dumps(dict(FILM, lights=FILM["lights"] + [spot])))
        studio = self.start(file)
        self.tab("Scene")
        self.click('[data-key="light/2"]')
        keys = self.project()["keys"]["light"]
        for name in (name for name, key in keys.items() if "spot" in key.get("of", ["spot"])):
            self.until(name, f"document.querySelector('[data-key^=\"light.{name}\"]') !== null")
        self.write("light.reach", 5.0)
        self.write("light.cone.outer", 60.0)
        self.write("camera.exposure", 0.5)
        self.click('[data-key="more Camera"]')
        self.write("camera.near", 0.25)
        self.write("film.rate", 25.0)
        self.choose("film.samples", "1")
        film = json.loads(file.read_text())
        self.assertEqual(film["lights"][1], spot | {"reach": 5, "cone": [32, 60]})
        self.assertEqual([film["camera"]["near"], film["camera"]["exposure"]], [0.25, 0.5])
        self.click('[data-key="light.key"]')
        self.write("light.reach", 7.0)
        self.until("a key", lambda: json.loads(file.read_text())["lights"][1]["keys"][0]["reach"] == 7)
        self.assertEqual([film["rate"], film["samples"]], [25, 1])
        self.no_complaint()
        self.assertEqual(studio.end(), (0, ""))

    def test_renderer_dies_in_a_drag(self):
        studio = self.start(self.film())
        at = self.show_limb()
        self.browser.press(*at)
        self.wave(at, lambda: self.browser.run("return window.seen.painted") > 12)
        for process in self.host_of(studio):
            os.kill(process, signal.SIGKILL)
        self.wave(at, lambda: self.browser.run("return window.seen.banners.includes('renderer')"))
        banner = "document.querySelector('.banner[data-about=renderer]')"
        self.wave(at, lambda: self.browser.run(f"return {banner} === null"))
        before = self.browser.run("return window.seen.painted")
        self.wave(at, lambda: self.browser.run("return window.seen.painted") > before + 4)
        self.changed_by(lambda: self.browser.release(*at))
        self.no_complaint()
        self.assertEqual(studio.end(), (0, ""))

    def test_studio_dies(self):
        file = self.film()
        studio = self.start(file)
        at = self.show_limb()
        self.changed_by(lambda: self.browser.drag(at, (at[0] + 40, at[1] + 20)))
        changed = file.read_text()
        hosts = self.host_of(studio)
        self.assertEqual(studio.end(signal.SIGKILL)[0], -signal.SIGKILL)
        self.banner("connection", "The studio does not answer")
        wait_until(lambda: not any(identity(host) for host in hosts), PATIENCE, "the renderer lives on")
        self.no_complaint(*NO_STUDIO)
        port = re.search(r":(\d+)/", studio.link)[1]
        again = self.enterContext(Studio(PROGRAMS, file, port=port))
        self.banner("connection", "Open the link that it has printed")
        self.show(again.link)
        self.pictures_in_all_views()
        self.assertEqual(file.read_text(), changed)
        self.changed_by(lambda: self.keys("z", modifiers=CTRL))
        self.assertEqual(json.loads(file.read_text()), FILM)
        # What the page has heard of the studio before, and of the new one, which does not know its token.
        self.no_complaint(*NO_STUDIO, "response code: 403")

    def test_network_is_cut(self):
        studio = self.enterContext(Studio(PROGRAMS, self.film()))
        proxy = Proxy(studio.link)
        self.addCleanup(proxy.cut)
        self.show(proxy.link)
        at = self.show_limb()
        proxy.cut()
        self.banner("connection", "The studio does not answer")
        painted = self.browser.run("return window.seen.painted")
        proxy.open(proxy.port)
        self.no_banner("connection")
        self.until("pictures of all views", f"window.seen.painted >= {painted + 4}")
        self.changed_by(lambda: self.browser.drag(at, (at[0] + 40, at[1] + 20)))
        self.until("the drag as a command", "document.querySelector('.commands code').textContent.startsWith("
                   "'mars animate film.json pose ')")
        self.no_complaint(*NO_STUDIO)
        self.assertEqual(studio.end(), (0, ""))


def number(text):
    try:
        return float(text.replace("\N{MINUS SIGN}", "-"))
    except ValueError:
        return None


def flat(limbs):
    """"hip" of "left" as "left.hip"."""
    for name, joint in limbs.items():
        if isinstance(joint, dict):
            yield from ((f"{name}.{part}", one) for part, one in joint.items())
        else:
            yield name, joint


def comparable(model):
    """What a model says, whatever the order: the page's colours have 8 bits, and it writes three edges."""
    def plain(value):
        if isinstance(value, list) and len(value) == 3 and len(set(map(str, value))) == 1:
            return plain(value[0])
        return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value
    model = dict(model, joints={joint["name"]: joint for joint in model["joints"]})
    for joint in model["joints"].values():
        joint["segment"] = {key: plain(value) for key, value in joint.get("segment", {}).items()}
    for material in model["materials"].values():
        material["color"] = [round(255 * part) for part in material["color"]]
    return model


if __name__ == "__main__":
    main()
