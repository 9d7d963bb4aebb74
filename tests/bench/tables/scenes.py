#!/usr/bin/env python3
"""Writes the films of 1992's tables: scenes.py FOLDER.

Data size is read as polygons: 1300 a segment, and in tables 4.3 and 4.4 the sizes that are printed. The films have
exactly these counts. The thesis does not say what its figures looked like, nor where they stood in the picture."""
import argparse
import json
import math
import os

import figures

SIZE = [512, 480]
EYE = [0, -40, 5]
SEGMENT = 1300        # polygons
DICE = 5              # 26 patches of 5 x 5 quads are as many
SWING = 8             # degrees that a moving joint turns in an interval
FILL = 0.94           # of the picture's height or width that the figures take

# The sizes of table 4.3 are 8 polygons and multiples of three numbers: 5192 a + 5176 b + 1728 c. They are films put
# together of the same few models, which we take for two men and a child on a stage.
STAGE, MEN, CHILD = 8, (5192, 5176), 1728
ROW = [1.7, 0.8, 1.8]  # from one to the next in a row, and from row to row
COMPANIES = {5200: (1, 0, 0), 10392: (2, 0, 0), 15568: (2, 1, 0), 17296: (2, 1, 1), 22488: (3, 1, 1), 27664: (3, 2, 1),
             32856: (4, 2, 1), 43224: (5, 3, 1), 55320: (6, 4, 2), 65704: (8, 4, 2), 70880: (8, 5, 2),
             82976: (9, 6, 3), 98536: (11, 7, 3), 110632: (12, 8, 4), 138288: (15, 10, 5), 165944: (18, 12, 6)}
ALIGNED_SIZE = 27664
CELL = 2.4  # side of what each has for itself in table 4.4
# Table 4.4: how far each of the six bodies is turned in the picture's plane, in degrees; 0 is upright.
ALIGNMENTS = {1: [45] * 6, 2: [0] * 6, 3: [0, 45, 90, 0, 45, 90], 4: [90] * 6, 5: [20, -20, 20, -20, 20, -20]}


class Cut:
    """How long a film is: `intervals` of a keyframe and `inbetweens`."""

    def __init__(self, intervals=4, inbetweens=32):
        self.intervals, self.length = intervals, inbetweens + 1
        self.frames = intervals * self.length


def swinging(pose, joints, cut):
    """Keys that swing `joints` away from their place in `pose` and back, so that each turns in every frame. The first
    frame is the same whatever moves."""
    def key(number):
        swing = SWING * (number % 2)
        turned = {name: swung(pose.get(name, [0, 0, 0]), swing) for name in joints}
        return {"frame": number * cut.length, "pose": turned}
    return {"pose": {name: angles for name, angles in pose.items() if name not in joints},
            "keys": [key(number) for number in range(cut.intervals + 1)]}


def swung(angles, swing):
    return [angles[0], angles[1] + swing, angles[2]]


def actor(name, model, pose, moving, cut, place=(0, 0, 0), roll=0):
    still = {"name": name, "model": model, "place": list(place), "turn": [0, roll, 0]}
    return {**still, **(swinging(pose, moving, cut) if moving else {"pose": pose})}


def corners(box, place):
    """Of a box about `place`."""
    return [[place[axis] + box[(k >> axis) & 1][axis] for axis in range(3)] for k in range(8)]


def camera(points, scale):
    """From EYE, far enough in or out that the points fill the picture; `scale` makes them as many times larger."""
    at = [(min(p[axis] for p in points) + max(p[axis] for p in points)) / 2 for axis in range(3)]
    view = [b - a for a, b in zip(EYE, at)]
    length = math.dist(EYE, at)
    forward = [x / length for x in view]
    side = math.hypot(forward[0], forward[1])
    right = [forward[1] / side, -forward[0] / side, 0]
    up = [right[1] * forward[2], -right[0] * forward[2], side]
    height = 0
    for point in points:
        ray = [b - a for a, b in zip(EYE, point)]
        x, y, depth = (sum(a * b for a, b in zip(ray, axis)) for axis in (right, up, forward))
        height = max(height, abs(y) / depth, abs(x) / depth * SIZE[1] / SIZE[0])
    return {"eye": EYE, "at": [round(x, 6) for x in at],
            "fov": round(2 * math.degrees(math.atan(height / FILL / scale)), 6)}


def film(cut, models, actors, points, scale):
    return {"frames": cut.frames, "rate": 24, "size": SIZE, "color": "coded", "samples": 1, "intervals": "keyframes",
            "background": [0.05, 0.06, 0.10], "dice": DICE, "camera": camera(points, scale),
            "lights": [{"direction": [-0.4, -0.7, 0.8]}], "materials": figures.MATERIALS, "models": models,
            "actors": actors}


def one_figure(parts, pose, box, polygons, moving, cut, scale):
    """A film of one figure, the first `moving` of whose segments move; of patches if there are no `polygons`."""
    model = figures.of_meshes(parts, polygons) if polygons else figures.of_patches(parts)
    names = [part[0] for part in parts[:moving]]
    return film(cut, {"figure": model}, [actor("figure", "figure", pose, names, cut)], corners(box, [0, 0, 0]), scale)


def company(size, width, shape_of=figures.slender):
    """The models of a film of table 4.3, its stage `width` wide, and the model of each body."""
    men, others, children = COMPANIES[size]
    kinds = {"man": (figures.MAN, MEN[0]), "other": (figures.MAN, MEN[1]),
             "child": (figures.scaled(figures.MAN, figures.CHILD), CHILD)}
    bodies = ["man"] * men + ["other"] * others + ["child"] * children
    models = {name: figures.of_meshes(*kinds[name], shape_of) for name in dict.fromkeys(bodies)}
    return {"stage": figures.of_meshes(figures.stage(width, 2), STAGE), **models}, bodies


def in_rows(count):
    """Places of `count` bodies in rows, one behind and above the other; and the width of the front row, the first."""
    columns = math.ceil(math.sqrt(count))
    rows = math.ceil(count / columns)
    sizes = [count * (row + 1) // rows - count * row // rows for row in range(rows)]
    places = [[ROW[0] * (k - (size - 1) / 2), ROW[1] * row, ROW[2] * row]
              for row, size in enumerate(sizes) for k in range(size)]
    return places, ROW[0] * sizes[0]


def of_bodies(models, bodies, places, rolls, cut, box, scale):
    """A film of a stage and bodies, of which the first moves its arms. `box`: what each may fill about its place."""
    actors = [{"name": "stage", "model": "stage", "place": [0, 0, box[0][2]]}]
    for number, (model, place, roll) in enumerate(zip(bodies, places, rolls)):
        moving = [] if number else ["left-arm", "right-arm"]
        actors.append(actor(f"{model}-{number}", model, figures.MAN_POSE, moving, cut, place, roll))
    return film(cut, models, actors, [corner for place in places for corner in corners(box, place)], scale)


def table_43(size, cut, scale):
    places, width = in_rows(sum(COMPANIES[size]))
    models, bodies = company(size, width)
    return of_bodies(models, bodies, places, [0] * len(bodies), cut, figures.MAN_BOX, scale)


def table_44(number, cut, scale, shape_of=figures.slender):
    """Six bodies in two rows of the picture, each turned in its plane; all films have the same camera."""
    models, bodies = company(ALIGNED_SIZE, 3 * CELL, shape_of)
    places = [[CELL * column, 0, CELL * row] for row in (0, 1) for column in (-1, 0, 1)]
    half = CELL / 2
    return of_bodies(models, bodies, places, ALIGNMENTS[number], cut, [[-half, -0.3, -half], [half, 0.3, half]], scale)


def polygon_count(film):
    """Triangles of all actors' segments, as MARS will draw them."""
    def of(model):
        shapes = {name: len(shape["mesh"]["faces"]) if isinstance(shape, dict) else len(shape) * 2 * film["dice"] ** 2
                  for name, shape in model["shapes"].items()}
        return sum(shapes[joint["segment"]["shape"]] for joint in model["joints"])
    return sum(of(film["models"][actor["model"]]) for actor in film["actors"])


def all_films(cut=None, scale=1.0):
    """By name: the table and its row; those of patches end in -patches."""
    cut = cut or Cut()
    films = {}
    for table, parts, pose, box in (("4.1", figures.ARM, figures.ARM_POSE, figures.ARM_BOX),
                                    ("4.2", figures.MAN, figures.MAN_POSE, figures.MAN_BOX)):
        for moving in range(1, len(parts) + 1):
            for kind, polygons in (("", SEGMENT * len(parts)), ("-patches", None)):
                films[f"{table}-{SEGMENT * moving}{kind}"] = one_figure(parts, pose, box, polygons, moving, cut, scale)
    films |= {f"4.3-{size}": table_43(size, cut, scale) for size in COMPANIES}
    films |= {f"4.4-{number}": table_44(number, cut, scale) for number in ALIGNMENTS}
    return films


def size_of(name):
    """Polygons of the film of this name."""
    table, row = name.split("-")[:2]
    return {"4.1": 3 * SEGMENT, "4.2": 8 * SEGMENT, "4.3": int(row), "4.4": ALIGNED_SIZE}[table]


def write(films, folder):
    os.makedirs(folder, exist_ok=True)
    for name, scene in films.items():
        assert polygon_count(scene) == size_of(name), name
        with open(os.path.join(folder, name + ".json"), "w") as file:
            file.write(json.dumps(scene))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--intervals", type=int, default=4, help="of each film; default 4")
    parser.add_argument("--inbetweens", type=int, default=32, help="of each interval, multiples of 32; default 32")
    parser.add_argument("--scale", type=float, default=1.0, help="how much larger the figures are in the picture")
    wanted = parser.parse_args()
    write(all_films(Cut(wanted.intervals, wanted.inbetweens), wanted.scale), wanted.folder)


if __name__ == "__main__":
    main()
