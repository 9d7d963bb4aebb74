"""A horse and a dog, for make_figures.py: in metres, until the film's unit scales them.

They stand along z and look along x; y is to their left. animal_cages.py makes their bodies; what is rigid on them is a
smooth surface through rings about a line.
"""
import math

import animal_cages
from cages import clothe
from human import glazed, soft

ROUND = 8                                               # control points of a ring
SWELL = 3 / (2 + math.cos(2 * math.pi / ROUND))         # a periodic cubic lies within its control points


def loft(start, end, rings):
    """A surface about the line from `start` to `end` (x, z): rings are (share of the line, half a width along y, half a
    depth, the middle's shift along the depth). Returns the shape and its sbb."""
    (x0, z0), (x1, z1) = start, end
    length = math.hypot(x1 - x0, z1 - z0)
    d = ((x1 - x0) / length, (z1 - z0) / length)
    across = (-d[1], d[0])  # in the plane of x and z: the line's direction is y cross this
    rows = []
    for at, wide, deep, shift in [(rings[0][0], 0, 0, rings[0][3]), *rings, (rings[-1][0], 0, 0, rings[-1][3])]:
        row = []
        for i in range(ROUND):
            angle = 2 * math.pi * i / ROUND
            off = shift + SWELL * deep * math.sin(angle)
            row.append((x0 + at * (x1 - x0) + off * across[0], SWELL * wide * math.cos(angle),
                        z0 + at * (z1 - z0) + off * across[1]))
        rows.append(row)
    low, high = ([f(p[axis] for row in rows for p in row) for axis in range(3)] for f in (min, max))
    points = [[[round((p[axis] - low[axis]) / (high[axis] - low[axis]), 3) + 0.0 for axis in range(3)] for p in row]
              for row in rows]
    return {"bspline": {"points": points, "u": {"ends": "periodic"}}}, [low, high]


class Beast:
    def __init__(self, unit, materials):
        self.unit, self.materials, self.shapes, self.joints, self.places = unit, materials, {}, [], {}

    def scaled(self, vector):
        return [round(x * self.unit, 4) + 0.0 for x in vector]

    def joint(self, name, parent, place, limits, shape=None, sbb=None, material=None, axes=None, **options):
        """`place` is in the world, at rest."""
        self.places[name] = place
        origin = self.places[parent] if parent else (0, 0, 0)
        self.joints.append({"name": name} | ({"parent": parent} if parent else {}) |
                           {"place": self.scaled([a - b for a, b in zip(place, origin)])} | (axes or {}) |
                           {"limits": {axis: list(limit) for axis, limit in limits.items()}})
        if shape:
            self.joints[-1]["segment"] = {"shape": shape, **options, "sbb": [self.scaled(corner) for corner in sbb],
                                          "material": material}

    def part(self, name, parent, place, limits, form, material, shape=None):
        """A joint with a loft whose line is in the world; the shape is made once for both sides."""
        start, end, rings = form
        shape = f"{shape or name}-form"
        made, (low, high) = loft(start, end, rings)
        self.shapes[shape] = made
        sbb = [[low[0] - place[0], low[1], low[2] - place[2]], [high[0] - place[0], high[1], high[2] - place[2]]]
        self.joint(name, parent, place, limits, shape, sbb, material)

    def ball(self, name, parent, place, radii, material):
        self.joint(name, parent, place, {}, "ellipsoid", [[-r for r in radii], list(radii)], material)

    def leg(self, which, parent, points, foot):
        """Joints of both sides: `points` (x, y, z) of the left one; `foot` makes what stands."""
        for side, sign in ("left", 1), ("right", -1):
            before = parent
            for name, (x, y, z), limits in zip(NAMES[which], points, LIMITS[which]):
                own = f"{side}-{which}-{name}"
                self.joint(own, before, (x, sign * y, z),
                           {a: v if a == "y" or sign == 1 else (-v[1], -v[0]) for a, v in limits.items()})
                before = own
            foot(f"{side}-{which}", before, points[-1], sign)

    def clothe(self, animal, coat, sock):
        """The body, and what is below the legs' seams on their lower parts."""
        self.joint("body", "pelvis", self.places["pelvis"], {})
        self.shapes["body"] = clothe(self.joints, "body", "body", animal.body(), coat, self.unit)
        for which in animal.legs:
            left = animal.sock(which)
            for side, cage in ("left", left), ("right", left.mirrored()):
                shape = f"{side}-{which}-sock"
                cannon = f"{side}-{which}-cannon"
                self.joint(shape, cannon, self.places[cannon], {})
                self.shapes[shape] = clothe(self.joints, shape, shape, cage, sock, self.unit, 0)

    def model(self, limbs):
        for side in "left", "right":
            limbs[side] = {limb: f"{side}-{joint}" for limb, joint in LIMBS.items()}
        return {"materials": self.materials, "limbs": limbs, "shapes": self.shapes, "joints": self.joints}


LIMBS = {"hip": "hind-thigh", "knee": "hind-shin", "ankle": "hind-cannon", "toes": "hind-pastern",
         "shoulder": "fore-shoulder", "elbow": "fore-arm", "wrist": "fore-cannon", "fingers": "fore-pastern"}
NAMES = {"hind": ("thigh", "shin", "cannon", "pastern"), "fore": ("shoulder", "arm", "cannon", "pastern")}
LIMITS = {"hind": ({"x": (-20, 25), "y": (-80, 70), "z": (-15, 15)}, {"y": (-70, 95)},
                   {"x": (-15, 15), "y": (-110, 80), "z": (-15, 15)}, {"y": (-90, 120)}),
          "fore": ({"x": (-20, 25), "y": (-80, 70), "z": (-15, 15)}, {"y": (-120, 60)},
                   {"x": (-15, 15), "y": (-70, 140), "z": (-15, 15)}, {"y": (-90, 120)})}
TRUNK = {"x": (-25, 25), "y": (-40, 40), "z": (-40, 40)}
NECK = {"x": (-20, 20), "y": (-40, 50), "z": (-45, 45)}


def horse(unit):
    coat, dark = "coat", "mane"
    beast = Beast(unit, {coat: soft([0.48, 0.25, 0.12], 0.12, 24), dark: soft([0.13, 0.09, 0.07], 0.08, 16),
                         "sock": soft([0.24, 0.13, 0.08], 0.1, 20), "hoof": glazed([0.20, 0.17, 0.15], 0.35),
                         "eye": glazed([0.05, 0.04, 0.04], 0.1)})
    beast.joint("pelvis", None, (-0.46, 0, 1.24), TRUNK)
    beast.joint("chest", "pelvis", (-0.02, 0, 1.25), TRUNK)
    beast.joint("neck", "chest", (0.58, 0, 1.30), NECK)
    beast.joint("mane", "neck", (0.58, 0, 1.30), {})
    beast.joint("head", "neck", (1.08, 0, 1.82), {"x": (-20, 20), "y": (-45, 40), "z": (-40, 40)})
    for side, sign in ("left", 1), ("right", -1):
        beast.ball(f"{side}-eye", "head", (1.165, sign * 0.083, 1.775), (0.028, 0.02, 0.028), "eye")
        beast.ball(f"{side}-nostril", "head", (1.415, sign * 0.042, 1.455), (0.016, 0.012, 0.02), "eye")
        beast.joint(f"{side}-ear", "head", (1.055, sign * 0.055, 1.90), {"y": (-30, 30)}, "cone",
                    [[-0.03, -0.022, -0.03], [0.03, 0.022, 0.15]], coat, top=0.15)
    beast.part("forelock", "head", (1.08, 0, 1.90), {}, ((1.05, 1.97), (1.22, 1.80), [
        (0, 0.03, 0.03, 0), (0.4, 0.045, 0.03, 0), (1, 0.012, 0.01, 0)]), dark)
    beast.part("tail", "pelvis", (-0.87, 0, 1.37), {"x": (-30, 30), "y": (-20, 80), "z": (-30, 30)},
               ((-0.86, 1.40), (-1.02, 0.62), [
                   (0.00, 0.03, 0.03, 0.01), (0.08, 0.045, 0.05, -0.03), (0.25, 0.065, 0.075, -0.05),
                   (0.55, 0.075, 0.085, -0.03), (0.85, 0.055, 0.06, 0), (1, 0.015, 0.015, 0.02)]), dark)

    def hoof(prefix, parent, fetlock, sign):
        x, y, _ = fetlock
        beast.joint(f"{prefix}-hoof", parent, (round(x + 0.055, 4), sign * y, 0.085), {}, "cone",
                    [[-0.068, -0.062, -0.085], [0.072, 0.062, 0.0]], "hoof", top=0.78)

    hind = [(-0.52, 0.15, 1.18), (-0.36, 0.16, 0.93), (-0.64, 0.14, 0.55), (-0.62, 0.14, 0.19)]
    fore = [(0.50, 0.15, 1.24), (0.40, 0.155, 0.90), (0.45, 0.14, 0.50), (0.46, 0.14, 0.18)]
    beast.leg("hind", "pelvis", hind, hoof)
    beast.leg("fore", "chest", fore, hoof)
    beast.clothe(animal_cages.HORSE, coat, "sock")
    beast.shapes["mane"] = clothe(beast.joints, "mane", "mane", animal_cages.mane(), dark, unit, 1)
    return beast.model({"pelvis": "pelvis", "chest": "chest", "neck": "neck", "head": "head"})


def dog(unit):
    fur, light = "fur", "belly"
    beast = Beast(unit, {fur: soft([0.62, 0.40, 0.20], 0.08, 16), light: soft([0.88, 0.76, 0.58], 0.06, 14),
                         "black": glazed([0.06, 0.05, 0.05], 0.2), "ear": soft([0.36, 0.21, 0.11], 0.06, 14)})
    beast.joint("pelvis", None, (-0.24, 0, 0.50), TRUNK)
    beast.joint("chest", "pelvis", (-0.05, 0, 0.51), TRUNK)
    beast.joint("neck", "chest", (0.27, 0, 0.53), NECK)
    beast.joint("head", "neck", (0.42, 0, 0.70), {"x": (-25, 25), "y": (-45, 45), "z": (-55, 55)})
    beast.part("snout", "head", (0.50, 0, 0.695), {}, ((0.48, 0.70), (0.66, 0.672), [
        (0.0, 0.045, 0.045, 0), (0.3, 0.05, 0.047, 0), (0.65, 0.042, 0.038, 0), (0.92, 0.036, 0.032, 0),
        (1, 0.018, 0.018, 0)]), light)
    beast.ball("nose", "snout", (0.653, 0, 0.69), (0.018, 0.02, 0.015), "black")
    for side, sign in ("left", 1), ("right", -1):
        beast.ball(f"{side}-eye", "head", (0.525, sign * 0.046, 0.752), (0.013, 0.014, 0.014), "black")
        beast.joint(f"{side}-ear", "head", (0.40, sign * 0.066, 0.785), {"x": (-30, 30), "y": (-20, 20)}, "ellipsoid",
                    [[-0.042, -0.016, -0.13], [0.046, 0.016, 0.016]], "ear")
    beast.part("tail", "pelvis", (-0.345, 0, 0.54), {"x": (-40, 40), "y": (-30, 60), "z": (-60, 60)},
               ((-0.34, 0.53), (-0.56, 0.72), [
                   (0.0, 0.024, 0.024, 0), (0.2, 0.03, 0.03, -0.012), (0.55, 0.028, 0.028, -0.02),
                   (0.85, 0.02, 0.02, -0.008), (1, 0.008, 0.008, 0)]), fur)

    def paw(prefix, parent, toe, sign):
        x, y, z = toe
        beast.joint(f"{prefix}-paw", parent, (x + 0.02, sign * y, 0.03), {}, "rounded_box",
                    [[-0.045, -0.034, -0.03], [0.055, 0.034, 0.022]], light, edge=[0.3, 0.35, 0.42])

    hind = [(-0.26, 0.075, 0.48), (-0.18, 0.082, 0.345), (-0.315, 0.075, 0.19), (-0.285, 0.075, 0.055)]
    fore = [(0.245, 0.078, 0.47), (0.185, 0.084, 0.315), (0.205, 0.075, 0.15), (0.215, 0.075, 0.05)]
    beast.leg("hind", "pelvis", hind, paw)
    beast.leg("fore", "chest", fore, paw)
    beast.clothe(animal_cages.DOG, fur, light)
    return beast.model({"pelvis": "pelvis", "chest": "chest", "neck": "neck", "head": "head"})
