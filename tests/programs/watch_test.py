"""--watch SOCKET: a watcher that puts flagged blocks together has the frames' own pixels, however slow it is; it may
come late and go early; nobody waits for it."""

import json
import time

from harness import EXAMPLES, PROGRAMS, ProgramTest, main, wait_until
from watcher import MOVING, NOTHING, STILL, Watcher, pixels_of_png

ARM = EXAMPLES / "robot-arm.json"
SIZE = ["--size", "160x90"]


class Watched(ProgramTest):
    def watch(self, words, **more):
        """The watcher of a rendering that has ended, with the pictures (frame, whole, kind, lines, colors, marks)."""
        seen = []

        def keep(w):
            seen.append((w.frame, w.whole, w.kind, w.lines, w.colors(), w.marks(), w.rects))

        watcher = Watcher(self.folder / "socket", keep, **more)
        self.mars_ends(*words)
        watcher.end()
        return watcher, seen

    def mars_ends(self, *words):
        self.succeed("mars", "render", *words, "-o", "out", "--watch", self.folder / "socket")

    def frame(self, number):
        return pixels_of_png(self.folder / "out" / f"frame-{number:04}.png")

    def assertShown(self, seen):
        """Whole pictures are their files; parts of keyframes have lines of theirs and lines of the picture before."""
        before = None
        for frame, whole, _, lines, colors, _, _ in seen:
            file = self.frame(frame)
            if whole:
                self.assertEqual(colors, file, f"frame {frame}")
            else:
                for y, (node, _) in enumerate(lines):
                    if node >= 0:
                        self.assertEqual(colors[y], file[y], f"line {y} of keyframe {frame}")
                    elif before:
                        self.assertIn(colors[y], (before[y], bytes(len(file[y]))))
            before = colors

    def test_has_the_frames_pixels(self):
        for backend in self.backends():
            for nodes, groups in [(1, 1), (3, 1), (2, 2)]:
                with self.subTest(backend=backend, nodes=nodes, groups=groups):
                    watcher, seen = self.watch([ARM, *SIZE, "--frames", "0-39", "--nodes", nodes, "--groups", groups,
                                                "--backend", backend, "--overwrite"])
                    print(backend, nodes, groups, len(seen), [(s[0], s[1]) for s in seen][:20])
                    self.assertShown(seen)
                    (self.folder / "socket").unlink()


if __name__ == "__main__":
    main()
