"""--watch SOCKET: a watcher that puts flagged blocks together has the frames' own pixels, however slow it is; it may
come late and go early; nobody waits for it."""

import subprocess

from harness import ENVIRONMENT, EXAMPLES, PROGRAMS, SECONDS, ProgramTest, main, spinning_teapot
from png_reader import png_rows
from watcher import MOVING, Watcher

ARM = EXAMPLES / "robot-arm.json"
SMALL = [ARM, "--size", "96x54", "--frames", "0-29"]
KEYFRAME, INBETWEEN = 0, 1


class Watched(ProgramTest):
    def setUp(self):
        super().setUp()
        self.files = {}

    def watch(self, *words, rest=0.0, last=None):
        """The watcher of a rendering that has ended; its `seen`: a copy of what it had after each picture."""
        seen = []
        watcher = Watcher(self.folder / "socket", lambda w: seen.append(w.copy()), rest, last)
        self.succeed("mars", "render", *words, "-o", "out", "--overwrite", "--watch", self.folder / "socket")
        watcher.end()
        return watcher, seen

    def frame(self, number):
        if number not in self.files:
            self.files[number] = png_rows(self.folder / "out" / f"frame-{number:04}.png")
        return self.files[number]

    def assertShown(self, seen):
        """Whole pictures are their files. The others have lines of theirs, and the other lines of a picture before, which
        a slow watcher may not have seen."""
        self.assertTrue(seen)
        before, number = [bytes(len(row)) for row in self.frame(seen[0].frame)], 0  # its first picture may be late
        for each in seen:
            file = self.frame(each.frame)
            if each.whole:
                self.assertEqual(each.colors, file, f"frame {each.frame}")
            else:
                self.assertEqual(each.kind, KEYFRAME)
                pictures = [before, *map(self.frame, range(number, each.frame))]
                for y, (node, _) in enumerate(each.lines):
                    line = f"line {y} of {each.frame}"
                    if node >= 0:
                        self.assertEqual(each.colors[y], file[y], line)
                    else:
                        self.assertIn(each.colors[y], [picture[y] for picture in pictures], line)
            before, number = each.colors, each.frame

    def test_has_the_frames_pixels(self):
        for backend in self.backends():
            for nodes, groups in [(1, 1), (3, 1), (2, 2)]:
                with self.subTest(backend=backend, nodes=nodes, groups=groups):
                    watcher, seen = self.watch(*SMALL, "--nodes", nodes, "--groups", groups, "--backend", backend)
                    self.assertShown(seen)
                    self.assertEqual(watcher.begun, [(96, 54, 16, groups, 30, nodes)])
                    self.assertEqual(sorted(watcher.drawn), list(range(30)))

    def test_nodes_may_have_no_lines_of_a_keyframe(self):
        """As where the camera looks away: the first node has all lines of an empty picture."""
        film = self.write("away.json", spinning_teapot(2, [96, 54]) | {"camera": {"eye": [0, -20, 0], "at": [0, -40, 0]}})
        for nodes in [1, 2, 3]:
            with self.subTest(nodes=nodes):
                _, seen = self.watch(film, "--nodes", nodes, "--groups", 1, "--no-coherence", "--backend", "threads")
                self.assertShown(seen)

    def test_a_slow_watcher_has_the_last_frame(self):
        for rest in [0.05, 0.3]:
            with self.subTest(rest=rest):
                watcher, seen = self.watch(*SMALL, "--nodes", 2, "--backend", "threads", rest=rest)
                self.assertShown(seen)
                self.assertEqual((seen[-1].frame, seen[-1].whole), (list(watcher.drawn)[-1], 1))

    def test_keyframes_come_in_parts(self):
        """Lines of a large keyframe are there before it is whole: its strips are several, and the nodes take long."""
        _, seen = self.watch(EXAMPLES / "s2.json", "--size", "320x180", "--samples", 16, "--frames", "0", "--nodes", 2,
                             "--backend", "threads")
        self.assertShown(seen)
        self.assertTrue([each for each in seen if not each.whole], "only whole pictures came")

    def test_other_formats_are_shown(self):
        """As 8-bit PNG files show them, but for rounding."""
        few = [*SMALL[:-1], "0-3"]
        self.succeed("mars", "render", *few, "-o", "png", "--backend", "threads")
        for format in ["png16", "exr"]:
            _, seen = self.watch(*few, "--backend", "threads", "--format", format)
            for each in seen:
                if each.whole:
                    file = b"".join(png_rows(self.folder / "png" / f"frame-{each.frame:04}.png"))
                    shown = b"".join(each.colors)
                    self.assertLessEqual(max(abs(a - b) for a, b in zip(shown, file)), 1, f"{format} {each.frame}")

    def test_says_who_drew_what(self):
        watcher, seen = self.watch(*SMALL, "--nodes", 3, "--groups", 1, "--backend", "threads")
        for frame, (_, kind, _, parts) in watcher.drawn.items():
            homes = sorted(part[1:3] for part in parts if part[1] < part[2])
            self.assertEqual([first for first, _ in homes] + [54], [0] + [last for _, last in homes], f"frame {frame}")
            self.assertEqual(len(parts), 3 if kind == KEYFRAME else 1)
        for each in seen:
            if each.whole:
                homes = {node: (first, last) for node, first, last, *_ in watcher.drawn[each.frame][3]}
                for y, (node, _) in enumerate(each.lines):
                    self.assertTrue(homes[node][0] <= y < homes[node][1], f"line {y} of frame {each.frame}")
                self.assertEqual(sum(boxes for _, boxes in each.lines),
                                 sum(part[-2] for part in watcher.drawn[each.frame][3]))

    def test_edge_boxes_of_lines_do_not_depend_on_nodes(self):
        counts = []
        for nodes in [1, 3]:
            _, seen = self.watch(ARM, "--size", "96x54", "--frames", "0", "--nodes", nodes, "--backend", "threads")
            counts.append([boxes for _, boxes in seen[-1].lines])
        self.assertEqual(counts[0], counts[1])
        self.assertGreater(max(counts[0]), 0)

    def test_marks_what_moves(self):
        """Where two frames of an interval differ, one of them has a moving part."""
        _, seen = self.watch(ARM, "--size", "192x108", "--samples", 16, "--nodes", 1, "--backend", "threads")
        pairs = [(a, b) for a, b in zip(seen, seen[1:]) if a.whole and b.whole and a.interval == b.interval]
        self.assertTrue(pairs)
        for one, other in pairs:
            for y in range(108):
                for x in range(192):
                    if one.colors[y][3 * x:3 * x + 3] != other.colors[y][3 * x:3 * x + 3]:
                        self.assertIn(MOVING, (one.marks[y][x], other.marks[y][x]), f"{x}, {y}")

    def test_goes_on_without_the_watcher(self):
        self.succeed("mars", "render", *SMALL, "-o", "alone", "--backend", "threads")
        for backend in self.backends():
            with self.subTest(backend=backend):
                watcher, _ = self.watch(*SMALL, "--nodes", 2, "--backend", backend, last=1)
                self.assertEqual(watcher.pictures, 1)
                for file in (self.folder / "alone").glob("*.png"):
                    self.assertEqual(file.read_bytes(), (self.folder / "out" / file.name).read_bytes(), file.name)

    def test_the_watcher_may_come_late(self):
        words = [PROGRAMS / "mars", "render", ARM, "--size", "320x180", "--samples", 16, "--nodes", 2, "--frames", "0-89",
                 "--no-coherence", "-o", self.folder / "out", "--backend", "threads", "--watch", self.folder / "socket"]
        run = subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env=ENVIRONMENT)
        warning = run.stderr.readline()
        self.assertIn("nobody watches yet", warning)
        seen = []
        watcher = Watcher(self.folder / "socket", lambda w: seen.append(w.copy()))
        self.assertEqual(run.communicate(timeout=SECONDS)[1], "")
        self.assertEqual(run.returncode, 0)
        watcher.end()
        self.assertShown(seen[-1:])
        self.assertEqual((seen[-1].frame, seen[-1].whole), (list(watcher.drawn)[-1], 1))

    def test_refusals(self):
        self.fail_clearly(2, "render", ARM, "-o", "out", "--backend", "simulated", "--watch", "socket",
                          says="leave out --watch")
        self.fail_clearly(1, "render", ARM, "-o", "out", "--backend", "threads", "--watch", "s" * 200,
                          says="at most 107 characters")


if __name__ == "__main__":
    main()
