"""Layers of EXR files: against what doubles say of boxes, Cryptomatte against its specification, the same bits whoever
draws them."""

import math
import shutil
import struct

from cryptomatte import Matte, id_of, murmur3_32
from exr_reader import Exr
from harness import ENVIRONMENT, ProgramTest, main

SIZE = (48, 36)
FOV = 40
EYES = {0: (0.5, -7, 2), 2: (0, -6, 1.5)}  # of the camera, by frames; it stands still from then on
PLACES = {0: (-1, -1, 0.5), 4: (0.6, -1.4, 0.8)}  # of the box that moves
BOX = (-0.5, 0.5)
WALL = ((-2, 0.8, -1), (2, 1.2, 1.4))
FAR = 1e10


def film(samples=1, shadow=False, **more):
    keys = lambda of, name: [{"frame": frame, name: list(value), "ease": "linear"} for frame, value in of.items()]
    box = lambda low, high, material: {"joints": [{"name": "body", "segment": {
        "shape": "box", "sbb": [list(low), list(high)], "material": material}}], "materials": {material: {"color": [0.8, 0.5, 0.2]}}}
    return {"frames": 6, "size": list(SIZE), "samples": samples, "background": [0.1, 0.2, 0.3], "color": "linear",
            "camera": {"at": [0, 0, 0.2], "fov": FOV, "keys": keys(EYES, "eye")},
            "lights": [{"direction": [-0.4, -1, 0.8], "shadow": shadow}, {"direction": [0.5, -0.6, 0.3], "intensity": 0.3}],
            "models": {"box": box([BOX[0]] * 3, [BOX[1]] * 3, "wood"), "wall": box(*WALL, "stone")},
            "actors": [{"name": "wall", "model": "wall"},
                       {"name": "box", "model": "box", "keys": keys(PLACES, "place")}], **more}


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def plus(a, b, times=1):
    return [x + times * y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [x / math.sqrt(dot(a, a)) for x in a]


def between(keys, frame):
    first, last = sorted(keys)
    part = min(max((frame - first) / (last - first), 0), 1)
    return plus(keys[first], minus(keys[last], keys[first]), part)


class Camera:
    """The film's at a frame, in doubles."""

    def __init__(self, frame):
        self.eye = between(EYES, frame)
        self.ahead = unit(minus((0, 0, 0.2), self.eye))
        self.right = unit(cross(self.ahead, (0, 0, 1)))
        self.up = cross(self.right, self.ahead)
        self.scale = SIZE[1] / 2 / math.tan(math.radians(FOV / 2))

    def ray(self, x, y):
        """Through the middle of a pixel, one unit deep."""
        right, up = (x + 0.5 - SIZE[0] / 2) / self.scale, (SIZE[1] / 2 - y - 0.5) / self.scale
        return plus(plus(self.ahead, self.right, right), self.up, up)

    def pixel(self, point):
        away = minus(point, self.eye)
        deep = dot(away, self.ahead)
        return [SIZE[0] / 2 + self.scale * dot(away, self.right) / deep, SIZE[1] / 2 - self.scale * dot(away, self.up) / deep]


def hit(eye, ray, low, high):
    """(depth, normal) of the near side of a box; None where the ray misses it. Says how near the edge is, too."""
    enters, leaves, axis = -math.inf, math.inf, None
    for k in range(3):
        near, far = sorted(((low[k] - eye[k]) / ray[k], (high[k] - eye[k]) / ray[k]))
        if near > enters:
            enters, axis = near, k
        leaves = min(leaves, far)
    if enters >= leaves:
        return None
    return enters, [(-1 if ray[k] > 0 else 1) if k == axis else 0 for k in range(3)]


def seen(frame, x, y):
    """(depth, normal, motion, actor) of a pixel's middle; depth FAR where there is nothing."""
    camera = Camera(frame)
    ray, place = camera.ray(x, y), between(PLACES, frame)
    boxes = {"wall": WALL, "box": (plus(place, [BOX[0]] * 3), plus(place, [BOX[1]] * 3))}
    hits = [(*found, name) for name, (low, high) in boxes.items() if (found := hit(camera.eye, ray, low, high))]
    if not hits:
        return FAR, [0, 0, 0], [0, 0], None
    depth, normal, name = min(hits)
    point = plus(camera.eye, ray, depth)
    if frame == 0:
        return depth, normal, [0, 0], name
    before = plus(point, minus(between(PLACES, frame - 1), place)) if name == "box" else point
    there = Camera(frame - 1).pixel(before)
    return depth, normal, [there[0] - x - 0.5, y + 0.5 - there[1]], name


class Layers(ProgramTest):
    def render(self, film, out, *words, **more):
        path = self.write("film.json", film)
        self.succeed("mars", "render", path, "-o", out, "--format", "exr", "--compression", "none", "--backend", "threads",
                     "--quiet", *words, **more)
        return [Exr(file) for file in sorted((self.folder / out).glob("*.exr"))]

    def test_what_doubles_say_of_boxes(self):
        frames = self.render(film(), "out", "--layers", "all", "--nodes", 2)
        checked = {None: 0, "wall": 0, "box": 0}
        moved = {frame: 0.0 for frame in range(6)}
        for frame, exr in enumerate(frames):
            matte = Matte(exr, "CryptoActor")
            for y in range(SIZE[1]):
                for x in range(SIZE[0]):
                    depth, normal, motion, name = seen(frame, x, y)
                    # Whoever is within a hundredth of a pixel of an edge may be on either side of it.
                    near = [seen(frame, x + dx, y + dy) for dx in (-0.01, 0.01) for dy in (-0.01, 0.01)]
                    if any(other[3] != name or other[1] != normal for other in near):
                        continue
                    checked[name] += 1
                    where = f"frame {frame}, pixel {x}, {y}, {name}"
                    self.assertEqual(matte.shares(x, y), {name: 1} if name else {}, where)
                    # Corners are snapped to 1/256 pixel.
                    slack = 1e-6 * depth + max(abs(other[0] - depth) for other in near)
                    self.assertAlmostEqual(exr.channels["Z"][y][x], depth, delta=slack, msg=where)
                    for ours, theirs in zip(exr.pixel("N.", "XYZ", x, y), normal):
                        self.assertAlmostEqual(ours, theirs, delta=1e-3, msg=where)
                    for k, (ours, theirs) in enumerate(zip(exr.pixel("backward.", "uv", x, y), motion)):
                        slack = 2e-4 + max(abs(other[2][k] - theirs) for other in near)
                        self.assertAlmostEqual(ours, theirs, delta=slack, msg=where)
                    if name == "wall":
                        moved[frame] = max(moved[frame], math.hypot(*motion))
        self.assertGreater(min(checked.values()), 250)
        # The wall moves over the picture until the camera stands still, also in the first frame of the interval then.
        self.assertEqual([moved[frame] > 0.5 for frame in range(6)], [False, True, True, False, False, False])

    def test_mattes_are_as_the_specification_says(self):
        self.assertEqual(murmur3_32(b"hello"), 0x248bfa47)  # known from elsewhere
        exr, *_ = self.render(film(samples=4), "out", "--layers", "ids", "--frames", "3", "--alpha")
        mattes = {layer: Matte(exr, layer) for layer in ("CryptoActor", "CryptoJoint", "CryptoMaterial")}
        self.assertEqual([sorted(matte.names) for matte in mattes.values()],
                         [["box", "wall"], ["box/body", "wall/body"], ["stone", "wood"]])
        for matte in mattes.values():
            self.assertEqual(len(matte.layers), 3)
            for name, digits in matte.names.items():
                self.assertEqual(int(digits, 16), int.from_bytes(struct.pack(">f", id_of(name)), "big"))
        parts = 0
        for y in range(SIZE[1]):
            for x in range(SIZE[0]):
                actors, joints, materials = (matte.shares(x, y) for matte in mattes.values())
                self.assertEqual({name.split("/")[0]: share for name, share in joints.items()}, actors)
                self.assertEqual({{"wood": "box", "stone": "wall"}[name]: share for name, share in materials.items()}, actors)
                self.assertEqual(sum(actors.values()), exr.channels["A"][y][x])
                parts += len(actors) == 2
        self.assertGreater(parts, 10)

    def files(self, out):
        return [file.read_bytes() for file in sorted((self.folder / out).glob("*.exr"))]

    def assertSameBits(self, made, ways):
        """Of ways to draw: options, and more of the environment."""
        one = self.render(made, "one", "--layers", "all", "--nodes", 1)
        for way, (words, more) in ways.items():
            self.render(made, way, "--layers", "all", *words, env={**ENVIRONMENT, **more})
            self.assertEqual(self.files(way), self.files("one"), way)
        for layered, plain in zip(one, self.render(made, "bare", "--nodes", 2)):
            for channel in "RGB":
                self.assertEqual(layered.channels[channel], plain.channels[channel])
        for out in self.folder.iterdir():
            if out.is_dir():
                shutil.rmtree(out)

    def test_the_same_bits_whoever_draws_them(self):
        ways = {"from scratch": (("--nodes", 2, "--no-coherence"), {}),
                "three nodes": (("--nodes", 3, "--mapping", "greedy"), {}),
                "their files": (("--nodes", 3, "--write", "nodes"), {}),
                "teams": (("--nodes", 4, "--groups", 1, "--sharers", 2), {"MARS_SIMD": "sse4"})}
        for samples, shadow in ((1, False), (4, False), (1, True), (4, True)):
            with self.subTest(samples=samples, shadow=shadow):
                # Still lines for which there is no memory are drawn again; shadows need 10 MiB.
                ways["little memory"] = (("--nodes", 2), {"MARS_MEMORY": "22" if shadow else "1"})
                self.assertSameBits(film(samples=samples, shadow=shadow), ways)

    def test_light_without_shadow_is_that_of_a_film_without(self):
        shadowed = self.render(film(samples=4, shadow=True), "shadowed", "--layers", "unshadowed", "--nodes", 2)
        bright = self.render(film(samples=4), "bright", "--nodes", 2)
        darker = 0
        for exr, plain in zip(shadowed, bright):
            for name in "RGB":
                for ours, theirs, shown in zip(exr.channels["unshadowed." + name], plain.channels[name], exr.channels[name]):
                    for a, b, c in zip(ours, theirs, shown):
                        self.assertAlmostEqual(a, b, delta=2e-3 * max(b, 0.1))
                        darker += c < a - 0.01
        self.assertGreater(darker, 100)

    def test_folders_know_their_layers(self):
        path = self.write("film.json", film(samples=4))
        render = ["mars", "render", path, "-o", "out", "--format", "exr", "--backend", "threads", "--quiet"]
        self.succeed(*render, "--layers", "depth,ids")
        before = {file: file.read_bytes() for file in (self.folder / "out").glob("*.exr")}
        self.verified_hash("out")
        self.assertIn('"layers":"depth,ids"', (self.folder / "out/frames.json").read_text().replace(" ", ""))
        (self.folder / "out/frame-0002.exr").unlink()
        self.succeed(*render, "--layers", "depth,ids")
        self.assertEqual({file: file.read_bytes() for file in before}, before)
        self.fail_clearly(1, *render[1:-1], "--layers", "depth", says="have the layers depth,ids, not the layers depth")
        self.fail_clearly(1, *render[1:-1], says="have the layers depth,ids, not no layers")
        (self.folder / "out/frames.json").unlink()
        self.assertIn("frames.json", self.mars("verify", "out", "--repair").stdout + self.mars("verify", "out").stdout)
        self.succeed("mars", "play", "out", "-o", "shown.png", "--frames", "1")

    def test_words_that_make_no_sense(self):
        path = self.write("film.json", film())
        render = ["render", path, "-o", "out", "--backend", "threads"]
        for words, says in ((["--layers", "depth"], "PNG files have no layers"),
                            (["--layers", "deep", "--format", "exr"], "there is no layer 'deep'"),
                            (["--layers", "depth,", "--format", "exr"], "a comma with no layer behind it"),
                            (["--layers", "ids,ids", "--format", "exr"], "comes twice"),
                            (["--layers", "all", "--format", "exr", "--compression", "pxr24"], "pxr24 changes")):
            with self.subTest(words=words):
                self.assertClear(self.mars(*render, *words).stderr, says)
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    main()
