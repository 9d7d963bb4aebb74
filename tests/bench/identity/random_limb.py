"""A limb with a skin for random films: a bent tube of any kind of surface, whose points follow up to four joints."""

import math


def limb(choose):
    """A model of three to five joints in a row, and how many these are."""
    joints = choose.randint(3, 5)
    rows = choose.randint(joints + 1, 3 * joints)
    around = choose.randint(4, 7)
    kind = choose.choice(["bspline", "subdivision", "mesh"])
    blend = choose.choice(["linear", "dual-quaternions"])
    ring = [(0.5 + 0.5 * math.cos(2 * math.pi * k / around), 0.5 + 0.5 * math.sin(2 * math.pi * k / around))
            for k in range(around)]
    points = [[[round(x, 4), round(y, 4), round(row / (rows - 1), 4)] for x, y in ring] for row in range(rows)]
    bones = [[follows(choose, joints * row / (rows - 1), joints) for _ in ring] for row in range(rows)]
    names = [f"j{number}" for number in range(joints)]
    skin = {"shape": "limb", "sbb": [[-0.2, -0.2, 0], [0.2, 0.2, 0.6 * joints]],
            "skin": {"joints": names, "blend": blend}}
    model = {"shapes": {"limb": surface(kind, points, bones, choose)},
             "joints": [{"name": name, **({"parent": names[number - 1], "place": [0, 0, 0.6]} if number else {})}
                        for number, name in enumerate(names)] + [{"name": "surface", "segment": skin}]}
    return model, names


def follows(choose, at, joints):
    """Bones near the place, each with a weight."""
    pairs = []
    for joint in range(joints):
        near = 1.3 - abs(at - joint - 0.5)
        if near > 0 and len(pairs) < 8:
            pairs += [joint, round(near * choose.uniform(0.5, 1), 3)]
    return pairs


def surface(kind, points, bones, choose):
    around, rows = len(points[0]), len(points)
    if kind == "bspline":
        return {"bspline": {"points": points, "bones": bones, "u": {"ends": "periodic"}}}
    faces = [[row * around + k, row * around + (k + 1) % around, (row + 1) * around + (k + 1) % around,
              (row + 1) * around + k] for row in range(rows - 1) for k in range(around)]
    flat = [point for row in points for point in row], [follow for row in bones for follow in row]
    if kind == "mesh":
        return {"mesh": {"vertices": flat[0], "faces": faces, "crease": choose.choice([0, 30, 180]), "bones": flat[1]}}
    faces += [list(range(around))[::-1], list(range(around * (rows - 1), around * rows))]
    return {"subdivision": {"points": flat[0], "faces": faces, "level": choose.choice([1, 1, 2]), "bones": flat[1]}}
