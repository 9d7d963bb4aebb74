#!/usr/bin/env python3
"""Writes stones.json, a film of polygon meshes, and its models: a low-poly landscape, rocks flat and smooth, a stellated
dodecahedron, and a house of faces with many corners.

With an argument: into that folder instead of its own.
"""
import math
import pathlib
import sys

from human import glazed
from make_scenes import HERE, text_of


def noise(*numbers):
    """The same number from 0 to 1 for the same arguments, without order."""
    x = math.sin(sum(n * f for n, f in zip(numbers, (12.9898, 78.233, 37.719)))) * 43758.5453
    return x - math.floor(x)


def smooth_noise(x, y):
    """Noise between whole numbers, without steps or kinks."""
    (i, u), (j, v) = ((math.floor(t), t - math.floor(t)) for t in (x, y))
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    near, far = (noise(i, j + k, 1) * (1 - u) + noise(i + 1, j + k, 1) * u for k in (0, 1))
    return near * (1 - v) + far * v


def matt(*color):
    return {"color": color, "ambient": 0.35, "diffuse": 0.8, "specular": 0}


MATERIALS = {
    "grass": matt(0.42, 0.58, 0.30), "stone": matt(0.60, 0.58, 0.56), "plaster": matt(0.92, 0.86, 0.74),
    "tile": matt(0.70, 0.30, 0.22), "pebble": glazed([0.46, 0.52, 0.60], 0.35),
    "gold": {"color": [1.0, 0.80, 0.34], "reflection": "metallic-roughness", "ambient": 0.7, "roughness": 0.4, "metallic": 1}}


def mesh_model(name, vertices, faces, material, crease):
    """A model of one joint that shows the mesh as large as its vertices say."""
    low, high = ([f(v[axis] for v in vertices) for axis in range(3)] for f in (min, max))
    unit = [[round((v[axis] - low[axis]) / (high[axis] - low[axis]), 5) for axis in range(3)] for v in vertices]
    sbb = [[round(x, 4) for x in corner] for corner in (low, high)]
    return {"materials": {material: MATERIALS[material]},
            "shapes": {name: {"mesh": {"vertices": unit, "faces": faces, "crease": crease}}},
            "joints": [{"name": name, "segment": {"shape": name, "sbb": sbb, "material": material}}]}


def landscape(cells=32, size=26):
    """A grid of triangles, hilly away from the middle, but not before the eye."""
    def height(x, y):
        hills = sum(smooth_noise(x * f + 7, y * f + 3) / f for f in (0.25, 0.6, 1.4))
        return hills * (0.8 if y > 0 else 0.8 / (1 + y * y)) * min(1, max(0, math.hypot(x, y) - 3.2) / 5) ** 1.5
    vertices = []
    for j in range(cells + 1):
        for i in range(cells + 1):
            x, y = ((k / cells - 0.5) * size + 0.3 * (noise(i, j, axis) - 0.5) for axis, k in enumerate((i, j)))
            vertices.append((x, y, height(x, y)))
    faces = []
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            b, c, d = a + 1, a + cells + 2, a + cells + 1
            faces += [[a, b, c], [a, c, d]] if (i + j) % 2 else [[a, b, d], [b, c, d]]
    return mesh_model("landscape", vertices, faces, "grass", 0)


GOLDEN = (1 + math.sqrt(5)) / 2
ICOSAHEDRON = [(s * a, t * b, 0) for s, t in ((1, 1), (-1, 1), (1, -1), (-1, -1)) for a, b in ((1, GOLDEN),)]
ICOSAHEDRON = ICOSAHEDRON + [(0, x, y) for x, y, _ in ICOSAHEDRON] + [(y, 0, x) for x, y, _ in ICOSAHEDRON]


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


def neighbours(vertices, edge):
    return lambda a, b: a != b and abs(math.dist(vertices[a], vertices[b]) - edge) < 1e-9


def icosahedron():
    near = neighbours(ICOSAHEDRON, 2)
    faces = []
    for a in range(12):
        for b in range(12):
            for c in range(12):
                outward = dot(cross(minus(ICOSAHEDRON[b], ICOSAHEDRON[a]), minus(ICOSAHEDRON[c], ICOSAHEDRON[a])),
                              ICOSAHEDRON[a]) > 0
                if a < b and a < c and near(a, b) and near(b, c) and near(c, a) and outward:
                    faces.append([a, b, c])
    return [unit(v) for v in ICOSAHEDRON], faces


def divided(vertices, faces):
    """Four triangles of each, on the unit sphere."""
    vertices, middles, out = list(vertices), {}, []

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in middles:
            middles[key] = len(vertices)
            vertices.append(unit(tuple(x + y for x, y in zip(vertices[a], vertices[b]))))
        return middles[key]
    for a, b, c in faces:
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        out += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    return vertices, out


def rock(name, seed, steps, roughness, material, crease):
    vertices, faces = icosahedron()
    for _ in range(steps):
        vertices, faces = divided(vertices, faces)

    def radius(v):
        lumps = sum(math.sin(dot(v, [noise(seed, k, axis) * 6 - 3 for axis in range(3)]) * 1.7 + seed + k) / (k + 2)
                    for k in range(5))
        return 1 + roughness * (lumps + 0.5 * noise(*(round(x * 40) + seed for x in v)))
    vertices = [tuple(x * radius(v) * stretch for x, stretch in zip(v, (1.15, 0.95, 0.75))) for v in vertices]
    return mesh_model(name, vertices, faces, material, crease)


def star():
    """The small stellated dodecahedron: a spike of five triangles on each of a dodecahedron's faces."""
    tips, triangles = icosahedron()
    near = neighbours(ICOSAHEDRON, 2)
    vertices, faces = [tuple(1.25 * x for x in tip) for tip in tips], []
    inner = {}
    for triangle in triangles:  # the dodecahedron's corners
        inner[tuple(sorted(triangle))] = len(vertices)
        vertices.append(tuple(0.52 * x for x in unit(tuple(sum(tips[t][axis] for t in triangle) for axis in range(3)))))
    for tip in range(12):
        around = [other for other in range(12) if near(tip, other)]
        for a in around:
            for b in around:
                if near(a, b) and dot(cross(minus(tips[a], tips[tip]), minus(tips[b], tips[tip])), tips[tip]) > 0:
                    c = next(o for o in around if near(b, o) and o != a)
                    faces.append([tip, inner[tuple(sorted((tip, a, b)))], inner[tuple(sorted((tip, b, c)))]])
    return mesh_model("star", vertices, faces, "gold", 0)


def house():
    """A prism over the outline of an L: its floor and ceiling are concave faces of six corners; and a gable roof."""
    outline = [(-1.4, -0.9), (1.4, -0.9), (1.4, 0.3), (0.2, 0.3), (0.2, 1.3), (-1.4, 1.3)]
    count = len(outline)
    vertices = [(x, y, z) for z in (0, 1) for x, y in outline]
    faces = [list(range(count))[::-1], list(range(count, 2 * count))]
    faces += [[i, (i + 1) % count, (i + 1) % count + count, i + count] for i in range(count)]
    walls = mesh_model("walls", vertices, faces, "plaster", 30)
    gable = [(-1.55, -1.05, 0), (-0.05, -1.05, 0), (-0.8, -1.05, 0.75), (-1.55, 1.45, 0), (-0.05, 1.45, 0), (-0.8, 1.45, 0.75)]
    roof = mesh_model("roof", gable, [[0, 1, 2], [4, 3, 5], [1, 4, 5, 2], [3, 0, 2, 5], [0, 3, 4, 1]], "tile", 30)
    roof["joints"][0].update(parent="walls", place=[0, 0, 1])
    return {"materials": walls["materials"] | roof["materials"], "shapes": walls["shapes"] | roof["shapes"],
            "joints": walls["joints"] + roof["joints"]}


def film():
    def still(name, place, turn=0, model=None):
        return {"name": name, "model": model or name, "place": place, "turn": [0, 0, turn]}
    return {
        "frames": 48, "rate": 24, "size": [960, 540], "background": [0.70, 0.80, 0.90],
        "camera": {"eye": [0.5, -11, 4.4], "at": [0, 0.6, 0.9], "fov": 36},
        "ambient": {"sky": [0.78, 0.88, 1.0], "ground": [0.62, 0.65, 0.50]},
        "lights": [{"direction": [0.6, -0.6, 0.7], "color": [1, 0.95, 0.86], "intensity": 1.6, "shadow": True},
                   {"direction": [-0.8, -0.3, 0.4], "color": [0.75, 0.85, 1.0], "intensity": 0.45},
                   {"direction": [-0.4, 0.6, 0.8], "color": [1, 0.95, 0.88], "intensity": 0.25}],
        "materials": {"ball": glazed([0.72, 0.28, 0.32])},
        "models": {name: f"models/{name}.json" for name in ("landscape", "rock", "pebble", "star", "house")} | {
            "ball": {"joints": [{"name": "ball", "segment": {"shape": "sphere", "sbb": [[-0.55, -0.55, 0], [0.55, 0.55, 1.1]],
                                                            "material": "ball"}}]}},
        "actors": [still("landscape", [0, 2, -0.35]), still("house", [-1.9, 3.2, -0.1], -20),
                   still("rock", [2.6, 0.3, 0.45]), still("boulder", [4.6, 3.4, 0.5], 130, "rock"),
                   still("pebble", [-2.6, -1.2, 0.4]), still("ball", [1.5, -2.6, -0.1]),
                   {"name": "star", "model": "star", "keys": [
                       {"frame": 0, "place": [-0.1, -0.6, 1.5], "turn": [20, 0, 0]},
                       {"frame": 24, "place": [-0.1, -0.6, 1.9], "turn": [20, 0, 72], "ease": "both"},
                       {"frame": 48, "place": [-0.1, -0.6, 1.5], "turn": [20, 0, 144], "ease": "both"}]}]}


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    written = {"models/landscape": landscape(), "models/rock": rock("rock", 3, 2, 0.22, "stone", 0),
               "models/pebble": rock("pebble", 8, 3, 0.16, "pebble", 180), "models/star": star(),
               "models/house": house(), "stones": film()}
    (folder / "models").mkdir(exist_ok=True)
    for name, content in written.items():
        (folder / (name + ".json")).write_text(text_of(content))


if __name__ == "__main__":
    main()
