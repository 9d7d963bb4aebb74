"""A hand turns a limb in mars studio: pictures follow it, and the film's file has the new pose once the hand lets go.
No browser: the test sends the page's messages itself."""

import json
import signal
import struct
import subprocess

from harness import ENVIRONMENT, EXAMPLES, PROGRAMS, SECONDS, ProgramTest, complaints, main
from studio_page import Page, request

SIZE = (160, 120)
FILM = {
    "frames": 2, "size": SIZE, "camera": {"eye": [5, -2, 1.6], "at": [0, 0, 0.9], "fov": 30},
    "models": {"human": str(EXAMPLES / "models" / "human.json")}, "actors": [{"name": "tom", "model": "human"}],
}
VIEW = {"do": "view", "edit": 1, "view": 0, "width": SIZE[0], "height": SIZE[1], "from": "front", "orbit": None, "as": "surface",
        "hidden": True, "ground": False, "handles": "none", "ghosts": None, "marks": False}
WAY = (12, 18)  # pixels of the view that the hand goes in each step


class HandTest(ProgramTest):
    def start(self, film):
        """The studio's process and the link that it prints."""
        # At a free port: at the usual one, pages of other tests might look for their studios.
        words = ["studio", film.name, "--no-browser", "--nodes", "1", "--port", "0"]
        studio = subprocess.Popen([PROGRAMS / "mars", *words], cwd=self.folder, env=ENVIRONMENT, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(self.end, studio)
        return studio, next(line.split()[1] for line in studio.stdout if line.startswith("Open "))

    def picture_of(self, page, edit):
        """The first picture that shows this edit or a later one."""
        while True:
            picture = page.hear("picture")
            _, view, number, shown = struct.unpack_from("<IIIQ", picture)
            page.say(do="painted", view=view, picture=number)
            if shown >= edit:
                return picture[32:]

    def a_limb(self, page, names):
        """Where a limb of that name is in the view: x, y and its name."""
        for y in range(2, SIZE[1], 4):
            for x in range(2, SIZE[0], 4):
                page.say(do="hover", view=0, x=x, y=y)
                if (joint := page.hear("hovered")["joint"]) in names:
                    return x, y, joint
        self.fail(f"the view shows none of {names}")

    def poses(self, film):
        return [key["pose"] for key in json.loads(film.read_text())["actors"][0].get("keys", [])]

    def test_a_limb_is_dragged(self):
        film = self.write("film.json", FILM)
        studio, link = self.start(film)
        status, _, body = request(link)
        self.assertEqual((status, b"main.js" in body), (200, True))
        with Page(link) as page:
            page.hear("project")
            page.say(**VIEW)
            seen = [self.picture_of(page, 1)]
            x, y, joint = self.a_limb(page, ["left-upper-arm", "right-upper-arm", "left-thigh", "right-thigh"])
            page.say(do="grab", edit=2, view=0, x=x, y=y, button=0, keys=[], falloff=0)
            self.assertEqual(page.hear("grabbed")["joint"], joint)
            for edit in (3, 4):
                x, y = x + WAY[0], y + WAY[1]
                page.say(do="drag", edit=edit, x=x, y=y, keys=[])
                seen.append(self.picture_of(page, edit))
            self.assertEqual(len(set(seen)), 3)
            self.assertEqual(self.poses(film), [])  # until the hand lets go
            page.say(do="drop", edit=5)
            [command] = page.hear("done")["commands"]
            self.assertEqual(command[:3], ["animate", "pose", "tom"])
            self.assertEqual([list(pose) for pose in self.poses(film)], [[joint]])
        studio.send_signal(signal.SIGTERM)
        said = studio.communicate(timeout=SECONDS)[1]
        self.assertEqual((complaints(said), studio.returncode), ("", 0))


if __name__ == "__main__":
    main()
