"""A horse and a dog, for make_figures.py: in metres, until the film's unit scales them.

They stand along z and look along x; y is to their left. Each part is a smooth surface through rings about a line.
"""
import math

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

    def joint(self, name, parent, place, limits, shape, sbb, material, axes=None, **options):
        """`place` is in the world, at rest."""
        self.places[name] = place
        origin = self.places[parent] if parent else (0, 0, 0)
        self.joints.append({"name": name} | ({"parent": parent} if parent else {}) |
                           {"place": self.scaled([a - b for a, b in zip(place, origin)])} | (axes or {}) |
                           {"limits": {axis: list(limit) for axis, limit in limits.items()},
                            "segment": {"shape": shape, **options, "sbb": [self.scaled(corner) for corner in sbb],
                                        "material": material}})

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

    def leg(self, which, parent, names, points, forms, limits, foot, materials):
        """Joints of both sides: `points` (x, y, z) of the left one; `foot` makes what stands."""
        for side, sign in ("left", 1), ("right", -1):
            before = parent
            for name, (x, y, z), form, limit, material in zip(names, points, forms, limits, materials):
                own = f"{side}-{which}-{name}"
                self.part(own, before, (x, sign * y, z),
                          {a: v if a == "y" or sign == 1 else (-v[1], -v[0]) for a, v in limit.items()}, form, material,
                          f"{which}-{name}")
                before = own
            foot(f"{side}-{which}", before, points[-1], sign)

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


def xz(point):
    return point[0], point[2]


def horse(unit):
    coat, dark = "coat", "mane"
    beast = Beast(unit, {coat: soft([0.48, 0.25, 0.12], 0.12, 24), dark: soft([0.13, 0.09, 0.07], 0.08, 16),
                         "sock": soft([0.24, 0.13, 0.08], 0.1, 20), "hoof": glazed([0.20, 0.17, 0.15], 0.35),
                         "eye": glazed([0.05, 0.04, 0.04], 0.1)})
    beast.part("pelvis", None, (-0.46, 0, 1.24), TRUNK, ((-0.88, 1.245), (0.28, 1.20), [
        (0.00, 0.05, 0.07, -0.02), (0.04, 0.15, 0.17, -0.01), (0.14, 0.235, 0.245, 0.01), (0.30, 0.272, 0.28, 0.01),
        (0.48, 0.28, 0.278, 0), (0.66, 0.284, 0.284, -0.005), (0.80, 0.28, 0.285, -0.01), (0.93, 0.24, 0.25, 0),
        (1, 0.15, 0.16, 0)]), coat)
    beast.part("chest", "pelvis", (-0.02, 0, 1.25), TRUNK, ((-0.42, 1.222), (0.74, 1.19), [
        (0.00, 0.15, 0.15, 0), (0.06, 0.253, 0.252, 0), (0.14, 0.28, 0.279, 0), (0.27, 0.287, 0.29, -0.005),
        (0.42, 0.288, 0.305, -0.005), (0.60, 0.272, 0.33, 0.015), (0.74, 0.25, 0.345, 0.035), (0.87, 0.215, 0.29, 0.02),
        (0.97, 0.15, 0.19, 0), (1, 0.085, 0.11, 0)]), coat)
    beast.part("neck", "chest", (0.58, 0, 1.30), NECK, ((0.46, 1.20), (1.12, 1.84), [
        (0.02, 0.10, 0.19, 0), (0.12, 0.16, 0.27, 0), (0.32, 0.135, 0.235, -0.005), (0.55, 0.10, 0.185, 0),
        (0.78, 0.082, 0.145, 0.01), (0.93, 0.078, 0.125, 0.005), (1.0, 0.055, 0.08, 0)]), coat)
    beast.part("mane", "neck", (0.58, 0, 1.30), {}, ((0.52, 1.56), (1.06, 2.0), [
        (-0.08, 0.014, 0.03, -0.05), (0.1, 0.03, 0.075, -0.035), (0.4, 0.034, 0.09, -0.03), (0.7, 0.034, 0.09, -0.045),
        (0.95, 0.03, 0.07, -0.07), (1.04, 0.015, 0.03, -0.09)]), dark)
    beast.part("head", "neck", (1.08, 0, 1.82), {"x": (-20, 20), "y": (-45, 40), "z": (-40, 40)},
               ((1.03, 1.90), (1.42, 1.40), [
                   (0.00, 0.05, 0.05, -0.01), (0.07, 0.085, 0.105, -0.015), (0.24, 0.10, 0.145, -0.02),
                   (0.42, 0.086, 0.122, 0), (0.62, 0.06, 0.086, 0.012), (0.82, 0.058, 0.074, 0.01),
                   (0.95, 0.056, 0.066, 0), (1.0, 0.032, 0.04, 0)]), coat)
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
    low = lambda p: (p[0] + 0.06, 0.075)
    beast.leg("hind", "pelvis", NAMES["hind"], hind, [
        ((-0.56, 1.36), (-0.37, 0.82), [(0.0, 0.03, 0.10, 0.05), (0.16, 0.09, 0.20, 0.04), (0.42, 0.115, 0.24, 0.04),
                                        (0.66, 0.115, 0.21, 0.03), (0.86, 0.09, 0.14, 0.01), (1, 0.045, 0.06, 0)]),
        (xz(hind[1]), xz(hind[2]), [(-0.10, 0.05, 0.06, 0), (0.0, 0.082, 0.115, 0), (0.25, 0.08, 0.115, -0.005),
                                    (0.55, 0.056, 0.075, 0), (0.82, 0.042, 0.05, 0), (1, 0.045, 0.055, 0),
                                    (1.10, 0.03, 0.035, 0)]),
        (xz(hind[2]), xz(hind[3]), [(-0.16, 0.02, 0.03, -0.02), (-0.05, 0.044, 0.06, -0.008), (0.12, 0.043, 0.056, 0),
                                    (0.35, 0.032, 0.038, 0), (0.75, 0.030, 0.036, 0), (0.97, 0.04, 0.048, -0.004),
                                    (1.12, 0.02, 0.025, 0)]),
        (xz(hind[3]), low(hind[3]), [(-0.25, 0.022, 0.025, 0), (0.0, 0.04, 0.046, 0), (0.5, 0.036, 0.040, 0),
                                     (1, 0.046, 0.05, 0), (1.2, 0.04, 0.04, 0)])],
        LIMITS["hind"], hoof, (coat, coat, "sock", "sock"))
    beast.leg("fore", "chest", NAMES["fore"], fore, [
        ((0.50, 1.42), (0.40, 0.84), [(0.0, 0.03, 0.07, 0), (0.15, 0.075, 0.14, 0), (0.42, 0.10, 0.185, 0.01),
                                      (0.7, 0.10, 0.155, 0), (0.9, 0.08, 0.105, 0), (1.02, 0.04, 0.05, 0)]),
        (xz(fore[1]), xz(fore[2]), [(-0.14, 0.04, 0.05, 0), (0.0, 0.076, 0.095, 0), (0.25, 0.072, 0.086, 0),
                                    (0.6, 0.05, 0.056, 0), (0.88, 0.042, 0.047, 0), (1, 0.045, 0.05, 0),
                                    (1.10, 0.03, 0.03, 0)]),
        (xz(fore[2]), xz(fore[3]), [(-0.14, 0.025, 0.03, 0), (-0.04, 0.045, 0.052, 0.004), (0.14, 0.042, 0.048, 0),
                                    (0.38, 0.030, 0.034, 0), (0.75, 0.029, 0.034, 0), (0.97, 0.038, 0.046, -0.004),
                                    (1.12, 0.02, 0.025, 0)]),
        (xz(fore[3]), low(fore[3]), [(-0.25, 0.022, 0.025, 0), (0.0, 0.038, 0.045, 0), (0.5, 0.035, 0.039, 0),
                                     (1, 0.045, 0.05, 0), (1.2, 0.04, 0.04, 0)])],
        LIMITS["fore"], hoof, (coat, coat, "sock", "sock"))
    return beast.model({"pelvis": "pelvis", "chest": "chest", "neck": "neck", "head": "head"})


def dog(unit):
    fur, light = "fur", "belly"
    beast = Beast(unit, {fur: soft([0.62, 0.40, 0.20], 0.08, 16), light: soft([0.88, 0.76, 0.58], 0.06, 14),
                         "black": glazed([0.06, 0.05, 0.05], 0.2), "ear": soft([0.36, 0.21, 0.11], 0.06, 14)})
    beast.part("pelvis", None, (-0.24, 0, 0.50), TRUNK, ((-0.36, 0.495), (0.12, 0.482), [
        (0.00, 0.03, 0.04, 0), (0.05, 0.062, 0.072, 0), (0.18, 0.088, 0.096, 0), (0.38, 0.089, 0.097, 0.008),
        (0.60, 0.092, 0.101, 0.004), (0.80, 0.094, 0.106, 0), (0.92, 0.08, 0.09, 0), (1, 0.05, 0.05, 0)]), fur)
    beast.part("chest", "pelvis", (-0.05, 0, 0.51), TRUNK, ((-0.20, 0.493), (0.36, 0.465), [
        (0.00, 0.05, 0.055, 0), (0.06, 0.08, 0.088, 0.005), (0.16, 0.0915, 0.0995, 0.004), (0.32, 0.097, 0.108, 0),
        (0.50, 0.106, 0.128, -0.006), (0.68, 0.107, 0.137, -0.005), (0.84, 0.094, 0.122, 0.005), (0.95, 0.068, 0.088, 0.01),
        (1, 0.035, 0.045, 0.01)]), fur)
    beast.part("neck", "chest", (0.27, 0, 0.53), NECK, ((0.22, 0.49), (0.45, 0.72), [
        (0.0, 0.05, 0.07, 0), (0.15, 0.08, 0.10, 0), (0.45, 0.072, 0.086, 0), (0.75, 0.066, 0.076, 0),
        (0.95, 0.056, 0.062, 0), (1.02, 0.03, 0.03, 0)]), fur)
    beast.part("head", "neck", (0.42, 0, 0.70), {"x": (-25, 25), "y": (-45, 45), "z": (-55, 55)},
               ((0.365, 0.735), (0.56, 0.715), [
                   (0.0, 0.03, 0.035, 0), (0.1, 0.068, 0.07, 0), (0.35, 0.085, 0.082, 0.005), (0.62, 0.076, 0.072, 0.005),
                   (0.86, 0.052, 0.05, -0.005), (1, 0.03, 0.03, -0.01)]), fur)
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
    low = lambda p: (p[0] + 0.03, 0.03)
    beast.leg("hind", "pelvis", NAMES["hind"], hind, [
        ((-0.275, 0.545), (-0.185, 0.31), [(0.0, 0.02, 0.04, 0.01), (0.15, 0.045, 0.075, 0.01), (0.45, 0.054, 0.086, 0.01),
                                           (0.75, 0.047, 0.066, 0), (0.95, 0.034, 0.042, 0), (1.03, 0.015, 0.02, 0)]),
        (xz(hind[1]), xz(hind[2]), [(-0.14, 0.018, 0.02, 0), (0.0, 0.036, 0.044, 0), (0.3, 0.034, 0.042, 0),
                                    (0.65, 0.024, 0.027, 0), (1, 0.022, 0.026, 0), (1.1, 0.012, 0.015, 0)]),
        (xz(hind[2]), xz(hind[3]), [(-0.2, 0.01, 0.012, 0), (0.0, 0.022, 0.027, 0), (0.3, 0.019, 0.022, 0),
                                    (0.75, 0.020, 0.022, 0), (1, 0.024, 0.026, 0), (1.15, 0.012, 0.012, 0)]),
        (xz(hind[3]), low(hind[3]), [(-0.4, 0.012, 0.014, 0), (0.0, 0.025, 0.026, 0), (0.6, 0.028, 0.026, 0),
                                     (1.2, 0.02, 0.018, 0)])],
        LIMITS["hind"], paw, (fur, fur, light, light))
    beast.leg("fore", "chest", NAMES["fore"], fore, [
        ((0.255, 0.545), (0.188, 0.29), [(0.0, 0.015, 0.03, 0), (0.18, 0.036, 0.058, 0), (0.5, 0.046, 0.068, 0),
                                         (0.8, 0.04, 0.05, 0), (0.97, 0.03, 0.034, 0), (1.05, 0.014, 0.016, 0)]),
        (xz(fore[1]), xz(fore[2]), [(-0.16, 0.016, 0.02, 0), (0.0, 0.034, 0.038, 0), (0.35, 0.031, 0.034, 0),
                                    (0.75, 0.025, 0.026, 0), (1, 0.024, 0.025, 0), (1.12, 0.012, 0.014, 0)]),
        (xz(fore[2]), xz(fore[3]), [(-0.2, 0.012, 0.012, 0), (0.0, 0.024, 0.025, 0), (0.5, 0.022, 0.023, 0),
                                    (1, 0.025, 0.026, 0), (1.2, 0.012, 0.012, 0)]),
        (xz(fore[3]), low(fore[3]), [(-0.5, 0.012, 0.014, 0), (0.0, 0.025, 0.026, 0), (0.6, 0.028, 0.026, 0),
                                     (1.2, 0.02, 0.018, 0)])],
        LIMITS["fore"], paw, (fur, fur, light, light))
    return beast.model({"pelvis": "pelvis", "chest": "chest", "neck": "neck", "head": "head"})
