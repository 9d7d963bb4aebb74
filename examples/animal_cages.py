"""Bodies of four-legged animals, for animals.py: in metres, each one surface from tail to nose with four legs.

A trunk's rows go from the tail to the nose: x, z, half a width, up, down, pitch of the trunk's line there in degrees.
Legs' rows go down: x, y, z of the left leg's middle, half a width, half a depth.
"""
import math

from cages import Cage, along, mixed, outline

ROUND = 8                     # points of a row of the trunk, from its left upwards
UPPER, LOWER = (7, 4), (6, 5)  # of those, on the left and on the right, between which a leg begins
ROOT, BESIDE = 0.36, 0.12     # how much a leg moves where it begins, and next to that


class Animal:
    """`chain`: bones of the trunk, taking over between rows (cages.along). `legs`: "hind" or "fore" to the trunk's
    first row of the leg, the leg's rows, and its bones, which take over at heights, negated. `seam`: the last row of a
    leg that belongs to the body's surface."""
    def __init__(self, trunk, chain, legs, seam):
        self.trunk, self.chain, self.legs, self.seam = trunk, chain, legs, seam

    def body(self):
        cage = Cage()
        rows = [cage.ring(trunk_row(*row), along(self.chain, number)) for number, row in enumerate(self.trunk)]
        for which, (first, leg, _) in self.legs.items():
            self.loosen(cage, rows, which, first)
        holes = {(first + k, side) for first, _, _ in self.legs.values() for k in (0, 1) for side in (6, 4)}
        for number, (low, high) in enumerate(zip(rows, rows[1:])):
            for i in range(ROUND):
                if (number, i) not in holes:
                    j = (i + 1) % ROUND
                    cage.face(low[i], low[j], high[j], high[i])
        cage.cap(rows[0][::-1])
        cage.cap(rows[-1])
        for which in self.legs:
            for sign in 1, -1:
                self.add_leg(cage, rows, which, sign)
        loose = {rows[first + k][point] for first, _, _ in self.legs.values() for k in (0, 1, 2)
                 for point in (*UPPER, *LOWER)}
        return cage.fit(3, loose)

    def loosen(self, cage, rows, which, first):
        """What is near a leg goes a little with it."""
        for side, upper, lower, above in ("left", UPPER[0], LOWER[0], 0), ("right", UPPER[1], LOWER[1], 3):
            bone = {f"{side}-{which}-{self.legs[which][2][0][0]}": 1.0}
            near = {(row, point): ROOT for row in (0, 1, 2) for point in (upper, lower)}
            near |= {(row, above): BESIDE for row in (0, 1, 2)}
            near |= {(row, point): BESIDE for row in (-1, 3) for point in (upper, lower)}
            for (row, point), share in near.items():
                at = rows[first + row][point]
                cage.weights[at] = mixed((cage.weights[at], 1 - share), (bone, share))

    def add_leg(self, cage, rows, which, sign):
        first, leg, _ = self.legs[which]
        side = 0 if sign > 0 else 1
        upper, lower = ([rows[first + k][ends[side]] for k in (2, 1, 0)] for ends in (UPPER, LOWER))
        root = [*upper, *lower[::-1]] if sign > 0 else [*lower, *upper[::-1]]
        above = leg[:self.seam + 1]
        rings = [root] + [self.leg_ring(cage, which, leg, number, sign) for number in range(len(above))]
        rings.append(self.leg_ring(cage, which, leg, self.seam, sign, narrower=0.75))
        cage.tube(rings[::-1])

    def leg_ring(self, cage, which, leg, number, sign, narrower=1.0):
        points = leg_row(leg, number, sign, narrower)
        side = "left" if sign > 0 else "right"
        (top, *_), *lower = self.legs[which][2]
        names = [f"{side}-{which}-{top}"] + [(f"{side}-{which}-{bone}", start, end) for bone, start, end in lower]
        weights = along(names, -leg[number][2])
        if number == 0:
            first = self.legs[which][0]
            weights = mixed((weights, 0.82), (along(self.chain, first + 1), 0.18))
        return cage.ring(points, weights)

    def sock(self, which):
        """What is below the seam of the left leg; it begins within the body's surface."""
        cage, (_, leg, _) = Cage(), self.legs[which]
        rings = [self.leg_ring(cage, which, leg, self.seam - 1, 1, narrower=0.7),
                 *(self.leg_ring(cage, which, leg, number, 1, narrower=0.985 if number == self.seam else 1)
                   for number in range(self.seam, len(leg)))]
        cage.tube(rings[::-1])
        return cage.fit(3)


def trunk_row(x, z, wide, up, down, pitch):
    c, s = math.cos(math.radians(pitch)), math.sin(math.radians(pitch))
    points = []
    for i in range(ROUND):
        angle = math.radians(22.5 + 45 * i)
        rise = math.sin(angle) * (up if math.sin(angle) > 0 else down)
        points.append((x - s * rise, wide * math.cos(angle), z + c * rise))
    return points


def leg_row(leg, number, sign, narrower):
    """Six points, square to the leg's line."""
    x, y, z, wide, deep = leg[number]
    before, after = leg[number - 1] if number else (x, y, 2 * z - leg[2][2]), leg[min(number + 1, len(leg) - 1)]
    dx, dz = after[0] - before[0], after[2] - before[2]
    length = math.hypot(dx, dz)
    ahead = (-dz / length, dx / length)
    points = []
    for forward, aside in outline([30 + 60 * i for i in range(6)], narrower * deep, narrower * deep, narrower * wide):
        points.append((x + forward * ahead[0], sign * y + aside, z + forward * ahead[1]))
    return points


HORSE = Animal(
    [(-0.885, 1.25, 0.08, 0.10, 0.10, 0), (-0.815, 1.25, 0.19, 0.20, 0.20, 0), (-0.70, 1.245, 0.25, 0.255, 0.255, 0),
     (-0.50, 1.24, 0.275, 0.28, 0.275, 0), (-0.30, 1.235, 0.28, 0.28, 0.275, 0), (-0.05, 1.23, 0.284, 0.28, 0.285, 0),
     (0.18, 1.222, 0.287, 0.285, 0.305, 0), (0.31, 1.22, 0.283, 0.305, 0.32, 0), (0.46, 1.22, 0.265, 0.33, 0.335, 5),
     (0.60, 1.255, 0.215, 0.32, 0.315, 18), (0.70, 1.36, 0.155, 0.25, 0.265, 34),
     (0.81, 1.515, 0.112, 0.195, 0.205, 45),
     (0.93, 1.66, 0.088, 0.155, 0.155, 47), (1.025, 1.77, 0.078, 0.12, 0.112, 46),
     (1.105, 1.80, 0.083, 0.12, 0.113, 10),
     (1.175, 1.755, 0.096, 0.115, 0.125, -35), (1.225, 1.68, 0.084, 0.10, 0.108, -48),
     (1.285, 1.585, 0.063, 0.085, 0.083, -52),
     (1.352, 1.492, 0.058, 0.073, 0.072, -52), (1.396, 1.430, 0.054, 0.064, 0.062, -52),
     (1.413, 1.405, 0.036, 0.042, 0.042, -52)],
    ["pelvis", ("chest", 4.0, 7.2), ("neck", 9.0, 11.6), ("head", 13.0, 15.8)],
    {"hind": (2, [(-0.485, 0.152, 1.03, 0.112, 0.205), (-0.415, 0.156, 0.93, 0.100, 0.155),
                  (-0.445, 0.153, 0.815, 0.080, 0.115), (-0.52, 0.149, 0.705, 0.058, 0.076),
                  (-0.598, 0.143, 0.60, 0.044, 0.056),
                  (-0.642, 0.14, 0.535, 0.044, 0.060), (-0.638, 0.14, 0.465, 0.041, 0.050),
                  (-0.63, 0.14, 0.385, 0.0315, 0.038),
                  (-0.623, 0.14, 0.265, 0.0305, 0.036), (-0.620, 0.14, 0.190, 0.040, 0.047),
                  (-0.592, 0.14, 0.130, 0.036, 0.040),
                  (-0.567, 0.14, 0.088, 0.046, 0.050), (-0.560, 0.14, 0.062, 0.040, 0.040)],
              [("thigh",), ("shin", -1.02, -0.84), ("cannon", -0.625, -0.475), ("pastern", -0.235, -0.145)]),
     "fore": (7, [(0.45, 0.152, 1.03, 0.100, 0.165), (0.412, 0.156, 0.92, 0.083, 0.115),
                  (0.412, 0.153, 0.80, 0.071, 0.088),
                  (0.430, 0.147, 0.665, 0.051, 0.057), (0.444, 0.142, 0.565, 0.043, 0.048),
                  (0.452, 0.14, 0.50, 0.046, 0.053),
                  (0.452, 0.14, 0.44, 0.041, 0.047), (0.454, 0.14, 0.365, 0.031, 0.035),
                  (0.458, 0.14, 0.25, 0.0295, 0.034),
                  (0.460, 0.14, 0.182, 0.039, 0.046), (0.488, 0.14, 0.128, 0.036, 0.040),
                  (0.514, 0.14, 0.088, 0.045, 0.050),
                  (0.520, 0.14, 0.062, 0.040, 0.040)],
              [("shoulder",), ("arm", -0.98, -0.82), ("cannon", -0.565, -0.435), ("pastern", -0.225, -0.135)])},
    seam=6)

DOG = Animal(
    [(-0.362, 0.495, 0.030, 0.04, 0.04, 0), (-0.342, 0.495, 0.062, 0.072, 0.070, 0),
     (-0.310, 0.495, 0.080, 0.090, 0.086, 0),
     (-0.245, 0.496, 0.089, 0.099, 0.094, 0), (-0.170, 0.496, 0.089, 0.098, 0.094, 0),
     (-0.06, 0.49, 0.092, 0.099, 0.103, 0),
     (0.06, 0.485, 0.098, 0.101, 0.112, 0), (0.145, 0.48, 0.104, 0.110, 0.127, 0),
     (0.215, 0.478, 0.103, 0.118, 0.134, 4),
     (0.280, 0.490, 0.086, 0.110, 0.115, 18), (0.325, 0.56, 0.073, 0.090, 0.094, 36),
     (0.358, 0.625, 0.067, 0.076, 0.078, 45),
     (0.388, 0.676, 0.062, 0.066, 0.060, 42), (0.430, 0.732, 0.081, 0.082, 0.070, 4),
     (0.484, 0.725, 0.075, 0.072, 0.066, -5),
     (0.532, 0.717, 0.054, 0.050, 0.048, -6), (0.557, 0.713, 0.030, 0.028, 0.028, -6)],
    ["pelvis", ("chest", 3.9, 7.0), ("neck", 9.0, 11.4), ("head", 11.3, 13.6)],
    {"hind": (2, [(-0.232, 0.078, 0.415, 0.050, 0.074), (-0.195, 0.081, 0.352, 0.042, 0.056),
                  (-0.218, 0.080, 0.297, 0.034, 0.042),
                  (-0.266, 0.077, 0.245, 0.025, 0.029), (-0.303, 0.076, 0.205, 0.0215, 0.0255),
                  (-0.316, 0.075, 0.182, 0.022, 0.027),
                  (-0.310, 0.075, 0.152, 0.0195, 0.023), (-0.300, 0.075, 0.112, 0.0195, 0.0215),
                  (-0.287, 0.075, 0.068, 0.024, 0.025),
                  (-0.272, 0.075, 0.043, 0.027, 0.026), (-0.266, 0.075, 0.030, 0.020, 0.018)],
              [("thigh",), ("shin", -0.385, -0.305), ("cannon", -0.22, -0.16), ("pastern", -0.078, -0.036)]),
     "fore": (7, [(0.222, 0.080, 0.405, 0.045, 0.064), (0.192, 0.083, 0.325, 0.036, 0.042),
                  (0.189, 0.082, 0.270, 0.031, 0.035),
                  (0.196, 0.079, 0.215, 0.0265, 0.028), (0.203, 0.076, 0.170, 0.024, 0.025),
                  (0.206, 0.075, 0.148, 0.024, 0.0255),
                  (0.207, 0.075, 0.122, 0.023, 0.024), (0.210, 0.075, 0.090, 0.022, 0.023),
                  (0.217, 0.075, 0.054, 0.025, 0.026),
                  (0.234, 0.075, 0.037, 0.027, 0.026), (0.242, 0.075, 0.028, 0.020, 0.018)],
              [("shoulder",), ("arm", -0.36, -0.27), ("cannon", -0.18, -0.12), ("pastern", -0.072, -0.030)])},
    seam=6)

# The horse's mane about a line along its neck: part of the line, half a width, half a depth, the middle's shift.
MANE = ((0.52, 1.56), (1.06, 2.0))
MANE_ROWS = [(-0.08, 0.014, 0.03, -0.05), (0.1, 0.03, 0.075, -0.035), (0.4, 0.034, 0.09, -0.03),
             (0.7, 0.034, 0.09, -0.045),
             (0.95, 0.03, 0.07, -0.07), (1.04, 0.015, 0.03, -0.09)]


def mane():
    """It follows what the rows of the trunk below it follow."""
    (x0, z0), (x1, z1) = MANE
    length = math.hypot(x1 - x0, z1 - z0)
    ahead, rise = (x1 - x0) / length, (z1 - z0) / length
    cage, rings = Cage(), []
    for part, wide, deep, shift in MANE_ROWS:
        points = []
        for aside, off in outline([60 * i for i in range(6)], wide, wide, deep):
            x, z = x0 + part * (x1 - x0), z0 + part * (z1 - z0)
            points.append((x - rise * (shift + off), aside, z + ahead * (shift + off)))
        rings.append(cage.ring(points, along(HORSE.chain, 9.75 + 4.2 * part)))
    cage.tube(rings)
    cage.cap(rings[0][::-1])
    cage.cap(rings[-1])
    return cage.fit(3)
