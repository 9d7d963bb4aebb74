"""Figures of 1992's size: models whose segments are limbs of a wanted number of polygons, or of patches."""
import math

import limbs

PHONG = {"ambient": 0.10, "diffuse": 0.65, "specular": 0.45, "exponent": 32}
MATERIALS = {"skin": {"color": [0.85, 0.62, 0.48], **PHONG}, "cloth": {"color": [0.35, 0.50, 0.80], **PHONG},
             "wool": {"color": [0.75, 0.40, 0.30], **PHONG}, "wood": {"color": [0.60, 0.50, 0.40], **PHONG}}

# Joint, parent, place, sbb, material; children before parents, so that the first k can move and the others stand still.
ARM = [
    ("hand", "forearm", [0, 0, -0.92], [[-0.17, -0.10, -0.62], [0.17, 0.10, 0.08]], "skin"),
    ("forearm", "upper-arm", [0, 0, -1.02], [[-0.17, -0.17, -1.00], [0.17, 0.17, 0.14]], "skin"),
    ("upper-arm", None, [0, 0, 0], [[-0.24, -0.24, -1.16], [0.24, 0.24, 0.18]], "cloth")]
MAN = [
    ("left-arm", "trunk", [0.30, 0, 0.66], [[-0.09, -0.09, -0.84], [0.09, 0.09, 0.09]], "skin"),
    ("right-arm", "trunk", [-0.30, 0, 0.66], [[-0.09, -0.09, -0.84], [0.09, 0.09, 0.09]], "skin"),
    ("head", "trunk", [0, 0, 0.82], [[-0.15, -0.17, -0.08], [0.15, 0.17, 0.36]], "skin"),
    ("left-shin", "left-thigh", [0, 0, -0.50], [[-0.10, -0.10, -0.60], [0.10, 0.10, 0.09]], "wool"),
    ("left-thigh", "trunk", [0.14, 0, 0.02], [[-0.14, -0.14, -0.58], [0.14, 0.14, 0.13]], "wool"),
    ("right-shin", "right-thigh", [0, 0, -0.50], [[-0.10, -0.10, -0.60], [0.10, 0.10, 0.09]], "wool"),
    ("right-thigh", "trunk", [-0.14, 0, 0.02], [[-0.14, -0.14, -0.58], [0.14, 0.14, 0.13]], "wool"),
    ("trunk", None, [0, 0, 0], [[-0.30, -0.19, -0.14], [0.30, 0.19, 0.84]], "cloth")]

CHILD = 0.62  # of a man's height


def scaled(parts, factor):
    """The same figure, larger or smaller."""
    def times(numbers):
        return [round(factor * x, 6) for x in numbers]
    return [(name, parent, times(place), [times(corner) for corner in box], material)
            for name, parent, place, box, material in parts]


def stage(width, depth):
    """A flat thing that lies below its origin."""
    return [("stage", None, [0, 0, 0], [[-width / 2, -depth / 2, -0.1], [width / 2, depth / 2, 0]], "wood")]


# Of each joint in a figure at ease.
ARM_POSE = {"upper-arm": [0, 42, 0], "forearm": [0, -96, 0], "hand": [0, -14, 0]}
MAN_POSE = {"left-arm": [0, -26, 0], "right-arm": [0, 40, 0], "head": [0, 6, 0], "left-thigh": [0, -12, 0],
            "left-shin": [0, 8, 0], "right-thigh": [0, 14, 0], "right-shin": [0, -8, 0]}

# What a figure at ease and its motion fill, about its own origin.
ARM_BOX = [[-1.15, -0.3, -1.75], [0.55, 0.3, 0.3]]
MAN_BOX = [[-0.95, -0.3, -1.15], [0.95, 0.3, 1.2]]


def segment_size(box):
    return [high - low for low, high in zip(*box)]


def slender(box):
    """Rings to sides of a ring: length over girth, and more, as rings crowd at the ends; so triangles of all segments
    have about the same shape."""
    width, depth, height = segment_size(box)
    girth = 1.57 * (width + depth)
    return max(0.2, min(6.0, height / girth * 1.6))


def even_shares(total, count):
    """`total` in even numbers that differ by at most 2."""
    return [2 * (total // 2 * (k + 1) // count - total // 2 * k // count) for k in range(count)]


def joint(name, parent, place, box, material, shape):
    link = {"parent": parent} if parent else {}
    return {"name": name, **link, "place": place, "segment": {"shape": shape, "sbb": box, "material": material}}


def of_meshes(parts, polygons, shape_of=slender):
    """A model of `parts` with `polygons` triangles in all, evenly shared out. shape_of(box): rings to sides of a ring."""
    shares = even_shares(polygons, len(parts))
    shapes = {name + "-mesh": limbs.mesh(share, shape_of(box)) for share, (name, _, _, box, _) in zip(shares, parts)}
    return {"shapes": shapes, "joints": [joint(*part, part[0] + "-mesh") for part in parts]}


def of_patches(parts):
    """A model of `parts`, each of limbs.PATCHES patches."""
    return {"shapes": {"limb": limbs.patches()}, "joints": [joint(*part, "limb") for part in parts]}


def turned(point, angle):
    """About the y axis, by degrees."""
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    x, y, z = point
    return [cosine * x + sine * z, y, cosine * z - sine * x]


def standing_patches(parts, pose):
    """All patches of a figure of patches in `pose`, in the world, in its segments' order."""
    by_name = {part[0]: part for part in parts}

    def to_world(name, point):
        _, parent, place, _, _ = by_name[name]
        moved = [a + b for a, b in zip(place, turned(point, pose.get(name, [0, 0, 0])[1]))]
        return to_world(parent, moved) if parent else moved

    def in_box(box, point):
        return [low + x * size for low, x, size in zip(box[0], point, segment_size(box))]
    unit = limbs.patches()
    return [[to_world(name, in_box(box, point)) for point in patch] for name, _, _, box, _ in parts for patch in unit]


def as_one_segment(patches):
    """A model of one segment with these patches."""
    points = [point for patch in patches for point in patch]
    low, high = ([pick(p[axis] for p in points) for axis in range(3)] for pick in (min, max))

    def in_cube(point):
        return [round((x - a) / (b - a), 7) for x, a, b in zip(point, low, high)]
    return {"shapes": {"all": [[in_cube(point) for point in patch] for patch in patches]},
            "joints": [joint("all", None, [0, 0, 0], [low, high], "cloth", "all")]}
