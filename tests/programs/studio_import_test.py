"""Files of other programs come into mars studio in a headless Chromium: by the button and by a drop. Their actors are in
the film, a panel says what came, undo takes them out, and a broken file says what is wrong and leaves nothing."""

from harness import *
from studio_browser import CTRL
from studio_browser_test import StudioInBrowser

ROCK = """mtllib rock.mtl
usemtl red
v 0 0 0\nv 1 0 0\nv 0 1.5 0\nv 0 0 1
f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4
"""
RED = "newmtl red\nKd 0.8 0.1 0.1\n"
NOD = """HIERARCHY
ROOT hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT neck
  {
    OFFSET 0 1 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 0.4 0
    }
  }
}
MOTION
Frames: 48
Frame Time: 0.0416667
""" + "".join(f"0 1 {frame / 24} 0 0 0 0 {frame % 24} 0\n" for frame in range(48))
ASF = """:version 1.10
:name walker
:units
  mass 1.0
  length 1.0
  angle deg
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name thigh
     direction 0 -1 0
     length 2
     axis 0 0 0 XYZ
     dof rx ry rz
     limits (-120 40)
            (-30 30)
            (-30 30)
  end
:hierarchy
  begin
    root thigh
  end
"""
AMC = ":FULLY-SPECIFIED\n:DEGREES\n" + "".join(f"{frame}\nroot 0 2 0 0 0 0\nthigh {-frame % 90} 0 0\n" for frame in range(1, 61))
CORNERS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
TRIANGLE = json.dumps({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "sail"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": len(CORNERS)}],
    "buffers": [{"uri": "data/corners.bin", "byteLength": len(CORNERS)}]})
# As a person's drop, whose files the page reads.
DROP = """
const data = new DataTransfer();
for (const [name, content] of arguments[0]) data.items.add(new File([typeof content === "string" ? content : new Uint8Array(content)], name));
for (const kind of ["dragover", "drop"])
  document.querySelector("#views").dispatchEvent(new DragEvent(kind, {dataTransfer: data, bubbles: true, cancelable: true}));
"""


class ImportTest(StudioInBrowser):
    def setUp(self):
        super().setUp()
        self.home = self.folder / "home"  # where the person's files are
        self.home.mkdir()
        self.films = self.folder / "films"
        self.films.mkdir()
        self.file = self.films / "film.json"
        self.succeed("mars", "film", self.file, "new", "size=320,180")

    def put(self, name, text):
        (self.home / name).write_text(text)
        return str(self.home / name)

    def panel(self, state):
        self.until(f"the panel: {state}", f"document.querySelector('#import').dataset.state === '{state}'")
        return self.browser.run("return document.querySelector('#import').innerText")

    def picture(self):
        return self.browser.run("return document.querySelector('.view canvas').toDataURL()")

    def actors(self):
        return [actor["name"] for actor in json.loads(self.file.read_text())["actors"]]

    def left(self):
        return sorted(path.name for path in self.films.iterdir() if not path.name.endswith(".journal"))

    def choose(self, *files):
        self.browser.run("""
            window.asked = 0;
            document.querySelector('[data-key="import.files"]').addEventListener("click", (event) => {
              event.preventDefault();
              ++window.asked;
            }, {once: true});""")
        self.click('[data-key="import"]')
        self.assertEqual(self.browser.run("return window.asked"), 1)
        self.browser.driver.find_element("css selector", '[data-key="import.files"]').send_keys("\n".join(files))

    def by_button(self):
        before, picture = self.file.read_text(), self.picture()
        self.choose(self.put("rock.obj", ROCK), self.put("rock.mtl", RED))
        text = self.panel("done")
        for words in ("rock.json", "Model of one joint 'rock'", "4 faces", "1 colour", "Nothing: all of the file was read"):
            self.assertIn(words.lower(), text.lower())
        self.until("the actor", "document.querySelector('#tree [data-key=rock]')?.ariaSelected === 'true'")
        self.until("another picture", lambda: self.picture() != picture)
        self.assertEqual(self.actors(), ["rock"])
        self.assertIn("mars film film.json add rock --model rock.json --beside 0",
                      self.browser.run("return document.querySelector('[data-key=commands]').textContent"))
        self.keys("z", modifiers=CTRL)
        self.until("undo", "document.querySelector('#tree [data-key=rock]') === null")
        self.assertEqual(self.file.read_text(), before)
        self.panel("done")  # until somebody closes it
        self.click('[data-key="import.close"]')
        self.until("no panel", "document.querySelector('#import').hidden")

    def by_drop(self):
        self.browser.run(DROP, [["nod.bvh", NOD]])
        self.assertIn("film of 48 frames at 24 a second", self.panel("done").lower())
        self.until("the actor", "document.querySelector('#tree [data-key=nod]') !== null")
        film = json.loads(self.file.read_text())
        self.assertEqual(film["frames"], 48)
        self.assertGreater(len(film["actors"][-1]["keys"]), 1)

    # The figure is dropped first, and then what it needs, which belongs into a folder.
    def companions(self):
        self.browser.run(DROP, [["sail.gltf", TRIANGLE]])
        text = self.panel("waiting")
        for words in ("data/corners.bin of sail.gltf", "Drop them on the page, too", "Waits 1:5"):
            self.assertIn(words, text)
        self.assertEqual(self.browser.run("return document.querySelectorAll('[data-key=\"import.without\"]').length"), 0)
        self.browser.run(DROP, [["corners.bin", list(CORNERS)]])
        self.assertIn("3 vertices, 1 face", self.panel("done"))
        self.until("its picture", "document.querySelector('#import canvas')?.ariaLabel === 'sail.json'")
        self.browser.run(DROP, [["stride.amc", AMC]])
        self.assertIn("The skeleton (.asf) of stride.amc", self.panel("waiting"))
        self.browser.run(DROP, [["stride.amc", AMC], ["walker.asf", ASF]])
        self.assertIn("actor 'stride'", self.panel("done"))
        self.assertEqual(self.actors()[-2:], ["sail", "stride"])

    # Of a model beside the film, and of a file that cannot be read.
    def thumbnails(self):
        (self.films / "cut.json").write_text('{"joints": [{"name": "a"},')
        card = "document.querySelector('[data-key=\"model.{}\"] .thumbnail')"
        self.until("the card", f"{card.format('rock.json')} !== null")
        self.browser.run(f"{card.format('rock.json')}.scrollIntoView({{block: 'center'}})")
        self.until("a picture", f"{card.format('rock.json')}.dataset.state === 'there'")
        self.assertGreater(self.browser.run(f"""
            const canvas = {card.format('rock.json')}.querySelector("canvas");
            const {{data}} = canvas.getContext("2d", {{willReadFrequently: true}}).getImageData(0, 0, canvas.width, canvas.height);
            return data.filter((red, at) => at % 4 === 0 && red > 1.5 * data[at + 1] && red > 1.5 * data[at + 2]).length;"""), 500)  # it is red
        self.until("the broken file", f"({card.format('cut.json')}?.scrollIntoView({{block: 'center'}}), {card.format('cut.json')}?.dataset.state === 'problem')")
        self.assertIn("cut.json:1", self.browser.run(f"return {card.format('cut.json')}.innerText"))
        (self.films / "cut.json").unlink()

    def broken(self):
        before = self.file.read_text()
        self.browser.run(DROP, [["broken.obj", "v 0 0 0\nf 1 2 9\n"], ["broken.mtl", RED]])
        text = self.panel("failed")
        self.assertIn("broken.obj", text)
        self.assertNotIn("mars-import", text)
        self.assertTrue(self.browser.run("return document.querySelector('#import .remedy').textContent"))
        self.browser.run(DROP, [["figure.blend", "BLENDER"]])
        self.until("why", "document.querySelector('#import').innerText.includes('Blender')")
        self.assertEqual(self.file.read_text(), before)

    def test_import(self):
        studio = self.start(self.file)
        self.pictures_in_all_views()
        self.by_button()
        self.by_drop()
        self.companions()
        self.thumbnails()
        self.broken()
        self.assertEqual(self.left(), ["film.json", "nod.json", "rock.json", "sail.json", "stride.json"])
        self.no_complaint()
        self.assertEqual(studio.end(), (0, ""))


if __name__ == "__main__":
    main()
