"""The surfaces of the man of human.py, in metres from the ground below him as he stands, x forward, y to his left.

His shirt is made with his arms lifted aside by LIFTED degrees, where cloth that covers them lies smooth.
"""
import math

from cages import Cage, along, mixed, outline, smooth

SHOULDER = (-0.02, 0.175, 1.40)
LIFTED = 28
WRIST = 0.56                               # below the shoulder
LEG, ANKLE, BALL = 0.092, 0.09, 0.115      # aside of the middle; height; ahead of the ankle


# ---- Weights.

def trunk(z):
    return along(["pelvis", ("spine", 0.945, 1.085), ("chest", 1.12, 1.26)], z)


def at_hip(point, side, hem=0.0):
    """Of what covers a thigh's root: it folds in front, where it is short, and stretches over the buttock."""
    x, y, z = point
    front = smooth((x + 0.07) / 0.16)
    top, long = 0.965 + 0.04 * hem * front, 0.19 - 0.08 * front
    outside = smooth((side * y + 0.02) / 0.07)
    share = smooth((top - z) / long) * outside
    return mixed((trunk(z), 1 - share), ({f"{name_of(side)}-thigh": 1.0}, share))


def hips(hem=0.0):
    def weights(point):
        return at_hip(point, 1 if point[1] > 0 else -1, hem)
    return weights


def leg(side, point):
    x, y, z = point
    name = name_of(side)
    below = along([f"{name}-thigh", (f"{name}-shin", 0.0, 0.11)], 0.545 - z)
    if z < 0.70:
        return below
    return at_hip(point, side)


def name_of(side):
    return "left" if side > 0 else "right"


# ---- Trousers: height, front, back, width, middle, square.

HIPS = [(1.080, 0.090, 0.082, 0.132, 0.0, 0.1),
        (1.035, 0.098, 0.092, 0.146, 0.0, 0.1),
        (0.985, 0.105, 0.108, 0.160, 0.0, 0.1),
        (0.935, 0.106, 0.120, 0.167, 0.0, 0.1),
        (0.885, 0.102, 0.121, 0.170, 0.0, 0.1)]
LEGS = [(0.795, 0.0895, 0.096, 0.0845, 0.001),
        (0.725, 0.0830, 0.083, 0.0785, 0.002),
        (0.640, 0.0730, 0.073, 0.0690, 0.002),
        (0.545, 0.0635, 0.0615, 0.0605, 0.000),
        (0.510, 0.0615, 0.0605, 0.0590, 0.000),
        (0.475, 0.0590, 0.0620, 0.0580, -0.001),
        (0.435, 0.0560, 0.0660, 0.0570, -0.002),
        (0.340, 0.0520, 0.0695, 0.0550, -0.003),
        (0.200, 0.0515, 0.0595, 0.0515, -0.004),
        (0.128, 0.056, 0.060, 0.054, -0.002),
        (0.117, 0.056, 0.060, 0.054, -0.002),
        (0.119, 0.040, 0.044, 0.040, -0.002)]
CROTCH = 0.828


def trousers():
    cage = Cage()
    angles = [15 + 30 * i for i in range(12)]
    rings = []
    for row, (z, front, back, width, middle, square) in enumerate(HIPS):
        flat = [(middle + x, y) for x, y in outline(angles, front, back, width, square, square)]
        lowest = row == len(HIPS) - 1
        points = [(0.90 * x, y, z - 0.03) if lowest and abs(y) < 0.06 else (x, y, z) for x, y in flat]
        rings.append(cage.ring(points, hips()))
    cage.tube(rings[::-1])
    low = rings[-1]
    crotch = {}
    for side in 1, -1:
        for x in 0.050, -0.066:
            weights = mixed(({"pelvis": 1.0}, 0.64), ({f"{name_of(side)}-thigh": 1.0}, 0.28),
                            ({f"{name_of(-side)}-thigh": 1.0}, 0.08))
            crotch[side, x] = cage.add((x, side * 0.014, CROTCH), weights)
    front, back = [[crotch[side, x] for side in (1, -1)] for x in (0.050, -0.066)]
    cage.face(low[0], low[11], front[1], front[0])
    cage.face(front[0], front[1], back[1], back[0])
    cage.face(back[0], back[1], low[6], low[5])
    legs = {1: low[:6] + [back[0], front[0]], -1: low[6:] + [front[1], back[1]]}
    for side, top in legs.items():
        rings = [top]
        around = [45 * i + (-22.5 if side > 0 else 157.5) for i in range(8)]
        for z, fore, aft, width, middle in LEGS:
            points = [(middle + x, side * LEG + y, z) for x, y in outline(around, fore, aft, width)]
            rings.append(cage.ring(points, lambda point, side=side: leg(side, point)))
        cage.tube(rings[::-1])
    return cage.fit(loose={*crotch.values(), low[0], low[5], low[6], low[11]})


# ---- Shirt: height, front, back, width, middle, square in front and behind.

SHIRT = [(0.937, 0.104, 0.114, 0.156, -0.005, 0.2, 0.1),
         (0.934, 0.120, 0.129, 0.177, -0.005, 0.2, 0.1),
         (0.946, 0.121, 0.130, 0.178, -0.005, 0.2, 0.1),
         (1.020, 0.117, 0.116, 0.167, -0.005, 0.2, 0.1),
         (1.105, 0.112, 0.097, 0.156, -0.005, 0.2, 0.2),
         (1.170, 0.114, 0.097, 0.155, -0.005, 0.2, 0.2),
         (1.250, 0.121, 0.107, 0.159, -0.005, 0.25, 0.25),
         (1.315, 0.129, 0.120, 0.160, -0.006, 0.3, 0.3),
         (1.380, 0.116, 0.124, 0.160, -0.014, 0.2, 0.3),
         (1.440, 0.083, 0.100, 0.150, -0.024, 0.0, 0.1),
         (1.472, 0.066, 0.078, 0.098, -0.026, 0.0, 0.0),
         (1.489, 0.057, 0.064, 0.070, -0.024, 0.0, 0.0),
         (1.496, 0.053, 0.058, 0.060, -0.022, 0.0, 0.0),
         (1.488, 0.046, 0.051, 0.053, -0.021, 0.0, 0.0)]
ARMPIT = 7                                # of the rows; the next two are beside the arm and above it
SWELLINGS = [(1.345, 0.090, 34, 36, 0.004),  # breasts: height, reach, angle, reach, how far
             (1.30, 0.150, 180, 24, -0.012),  # furrow of the spine
             (1.39, 0.090, 140, 34, 0.008)]   # shoulder blades
# Of the left arm's hole: angle of the trunk's ring, row, place, how much of the arm's turn it makes.
HOLE = [(60, 1, (0.046, 0.140, 1.376), 0.34), (60, 2, (0.026, 0.134, 1.420), 0.20),
        (90, 2, (-0.020, 0.134, 1.438), 0.13),
        (120, 2, (-0.066, 0.134, 1.424), 0.20), (120, 1, (-0.088, 0.140, 1.380), 0.34),
        (120, 0, (-0.073, 0.144, 1.322), 0.28),
        (90, 0, (-0.015, 0.150, 1.298), 0.22), (60, 0, (0.043, 0.144, 1.318), 0.28)]
# Along the arm from its shoulder: how far, front, back, width, tilt (further on its upper side).
SLEEVE = [(0.015, 0.054, 0.057, 0.0475, 0.28),
          (0.075, 0.0575, 0.059, 0.0515, 0.15),
          (0.140, 0.060, 0.060, 0.054, 0.0),
          (0.176, 0.0595, 0.059, 0.054, 0.0),
          (0.185, 0.058, 0.058, 0.053, 0.0),
          (0.183, 0.044, 0.044, 0.042, 0.0)]


def fade(x):
    return max(0.0, 1 - x * x) ** 2


def swelling(z, angle):
    angle = min(angle, 360 - angle)
    return sum(far * fade((z - at) / reach) * fade((angle - aside) / wide) for at, reach, aside, wide, far in SWELLINGS)


def shirt_ring(row, angles):
    z, front, back, width, middle, square, behind = row
    points = []
    for angle, (x, y) in zip(angles, outline(angles, front, back, width, square, behind)):
        longer = 1 + swelling(z, angle) / math.hypot(x, y)
        points.append((middle + longer * x, longer * y, z))
    return points


def shirt_weights(point):
    x, y, z = point
    side = 1 if y > 0 else -1
    if z < 1.13:
        return at_hip(point, side, hem=1.0)
    shoulder = smooth((abs(y) - 0.05) / 0.10) * smooth((z - 1.25) / 0.13)
    arm = 0.14 * smooth((abs(y) - 0.09) / 0.06) * smooth((z - 1.21) / 0.09)
    parts = [(trunk(z), (1 - shoulder) * (1 - arm)), ({f"{name_of(side)}-clavicle": 1.0}, shoulder * (1 - arm)),
             ({f"{name_of(side)}-sleeve": 1.0}, arm)]
    neck = smooth((z - 1.465) / 0.04) * 0.5
    return mixed((mixed(*parts), 1 - neck), ({"neck": 1.0}, neck))


def sleeve_ring(row, side):
    """In the frame of an arm that is lifted aside."""
    far, front, back, width, tilt = row
    lift = math.radians(LIFTED)
    out, up = (math.sin(lift), -math.cos(lift)), (math.cos(lift), math.sin(lift))
    points = []
    for i in range(8):
        angle = math.radians(45 * i)
        x, across = math.cos(angle) * (front if math.cos(angle) > 0 else back), math.sin(angle) * width
        t = far + tilt * across
        points.append((SHOULDER[0] + x, side * (SHOULDER[1] + t * out[0] + across * up[0]),
                       SHOULDER[2] + t * out[1] + across * up[1]))
    return points


def sleeve_weights(side, row):
    """Less of the arm where the sleeve begins, least in the armpit."""
    def weights(point):
        share = 1.0 if row else 0.70 + 0.10 * (point[2] - SHOULDER[2]) / 0.05
        return mixed(({f"{name_of(side)}-clavicle": 1.0}, 1 - share), ({f"{name_of(side)}-sleeve": 1.0}, share))
    return weights


def shirt():
    cage = Cage()
    angles = [30 * i for i in range(12)]
    rings = [cage.ring(shirt_ring(row, angles), shirt_weights) for row in SHIRT]
    holes = set()
    for side in 1, -1:
        hole = []
        for angle, row, place, share in HOLE:
            at = rings[ARMPIT + row][(angle if side > 0 else 360 - angle) // 30]
            cage.points[at] = (place[0], side * place[1], place[2])
            rest = mixed((trunk(place[2]), 0.25), ({f"{name_of(side)}-clavicle": 1.0}, 0.75))
            cage.weights[at] = mixed((rest, 1 - share), ({f"{name_of(side)}-sleeve": 1.0}, share))
            hole.append(at)
        holes.update(hole)
        tube = [hole]
        for number, row in enumerate(SLEEVE):
            tube.append(cage.ring(sleeve_ring(row, side), sleeve_weights(side, number)))
        for near, far in zip(tube, tube[1:]):
            cage.bridge(far, near) if side > 0 else cage.bridge(near, far)
        inside = rings[ARMPIT + 1]
        inside[3 if side > 0 else 9] = None
    cage.tube(rings)
    return compact(cage.fit(loose=holes))


def compact(cage):
    """Without points that no face has."""
    used = sorted({i for face in cage.faces for i in face})
    number = {old: new for new, old in enumerate(used)}
    cage.points, cage.weights = [cage.points[i] for i in used], [cage.weights[i] for i in used]
    cage.faces = [tuple(number[i] for i in face) for face in cage.faces]
    return cage


# ---- The left arm, from inside the sleeve to the fingers' tips: how far below the shoulder, front, back, width.

ARM = [(0.118, 0.0450, 0.0445, 0.0410), (0.195, 0.0460, 0.0460, 0.0417),
       (0.255, 0.0425, 0.0425, 0.0405), (0.295, 0.0415, 0.0425, 0.0402), (0.335, 0.0430, 0.0435, 0.0415),
       (0.395, 0.0430, 0.0420, 0.0398), (0.475, 0.0350, 0.0340, 0.0300),
       (0.548, 0.0285, 0.0275, 0.0205)]
HAND = (SHOULDER[0], SHOULDER[1], SHOULDER[2] - WRIST)   # places below are from here: forward, outward, up
# Rows of the palm: along the back of the hand from thumb to little finger, then along the palm back again.
WRIST_ROW = [(0.029, 0.010, -0.012), (0.011, 0.0175, -0.013), (-0.010, 0.0175, -0.013), (-0.027, 0.011, -0.012),
             (-0.027, -0.011, -0.014), (-0.010, -0.0175, -0.015), (0.011, -0.0185, -0.015), (0.029, -0.013, -0.014)]
PALM_ROW = [(0.021, 0.0175, -0.056), (0.004, 0.0180, -0.057), (-0.016, 0.0165, -0.056), (-0.036, 0.0100, -0.052),
            (-0.036, -0.0130, -0.052), (-0.016, -0.0150, -0.056), (0.004, -0.0150, -0.057), (0.021, -0.0165, -0.056)]
# The roots of the fingers, on either side. Six edges meet between fingers; their places make normals there agree best.
BACK = [(0.0395, 0.0075, -0.089), (0.0205, 0.0068, -0.0987), (0.0005, 0.0083, -0.0939), (-0.0195, 0.0111, -0.093),
        (-0.0370, 0.0060, -0.086)]
FRONT = [(0.0395, -0.0085, -0.092), (0.0205, -0.0055, -0.0939), (0.0005, -0.0146, -0.0959), (-0.0195, -0.0116, -0.0939),
         (-0.0370, -0.0085, -0.090)]
# Fingers: first joint, how far it leans forward, thickness, lengths of the phalanges.
FINGERS = {"index": ((0.0305, 0.001, -0.083), 4, 0.0104, (0.040, 0.024, 0.020)),
           "middle": ((0.0105, 0.002, -0.086), 1, 0.0106, (0.044, 0.027, 0.021)),
           "ring": ((-0.0095, 0.001, -0.084), -3, 0.0102, (0.041, 0.025, 0.021)),
           "little": ((-0.0290, -0.001, -0.077), -7, 0.0092, (0.033, 0.019, 0.018))}
BENT = (14, 20, 12)                                  # degrees, of a finger's joints at rest
THUMB = (0.020, -0.005, -0.028)                      # its first joint, where it points and where it bends to
THUMB_DOWN, THUMB_TO = (0.60, -0.22, -0.72), (-0.45, -0.80, -0.30)
THUMB_LENGTHS, THUMB_BENT = (0.036, 0.029, 0.023), (0, 8, 12)


def added(a, b, times=1.0):
    return tuple(p + times * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normal(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def digit(name):
    """Of a finger or the thumb at rest: places of its joints and its tip, the directions of its phalanges, its hinge,
    about which it bends."""
    if name == "thumb":
        at, down, lengths, bends = THUMB, normal(THUMB_DOWN), THUMB_LENGTHS, THUMB_BENT
        hinge = normal(cross(down, THUMB_TO))
    else:
        at, lean, _, lengths = FINGERS[name]
        down, bends = (math.sin(math.radians(lean)), 0.0, -math.cos(math.radians(lean))), BENT
        hinge = normal(cross(down, (0, -1, 0)))
    places, directions = [at], []
    for length, bend in zip(lengths, bends):
        c, s = math.cos(math.radians(bend)), math.sin(math.radians(bend))
        down = tuple(c * d + s * t for d, t in zip(down, cross(hinge, down)))
        directions.append(down)
        places.append(added(places[-1], down, length))
    return places, directions, hinge


def phalanges(name):
    return [f"left-{name}-{k}" for k in (1, 2, 3)]


def halves(a, b, share=0.5):
    return mixed(({a: 1.0}, 1 - share), ({b: 1.0}, share))


def stations(name, thick):
    """Where a digit has rings: phalanx, part of its length, thickness, weights."""
    one, two, three = phalanges(name)
    rings = [(0, 0.52, 1.03, {one: 1.0}), (1, 0, 0.99, halves(one, two)), (1, 0.5, 0.90, {two: 1.0}),
             (2, 0, 0.90, halves(two, three)), (2, 0.76, 0.74, {three: 1.0})]
    if name == "thumb":
        rings = [(1, 0, 1.0, halves(one, two)), (1, 0.5, 0.93, {two: 1.0}), (2, 0, 0.95, halves(two, three)),
                 (2, 0.74, 0.78, {three: 1.0})]
    return [(phalanx, part, thick * wide, weights) for phalanx, part, wide, weights in rings]


def digit_tube(cage, name, base, thick, corners):
    """From its base on; `corners` of a ring: along the hinge, and to where it bends."""
    places, directions, hinge = digit(name)
    rings = [base]
    for phalanx, part, wide, weights in stations(name, thick):
        down = directions[phalanx]
        middle = added(places[phalanx], down, part * math.dist(places[phalanx], places[phalanx + 1]))
        if part == 0:
            down = normal(added(down, directions[phalanx - 1]))
        to = cross(hinge, down)
        points = [added(added(added(HAND, middle), hinge, a * wide * 0.707), to, b * wide * 0.707) for a, b in corners]
        rings.append(cage.ring(points, weights))
    return rings


def arm():
    cage = Cage()
    chain = ["left-upper-arm", ("left-forearm", 0.24, 0.355), ("left-hand", 0.525, 0.595)]
    around = [45 * i + 22.5 for i in range(8)]
    rings = []
    for far, front, back, width in ARM:
        points = [(SHOULDER[0] + x, SHOULDER[1] + y, SHOULDER[2] - far) for x, y in outline(around, front, back, width)]
        rings.append(cage.ring(points, along(chain, far)))
    for row, far in (WRIST_ROW, 0.574), (PALM_ROW, 0.6):
        rings.append(cage.ring([added(HAND, p) for p in row], along(chain, far)))
    cage.tube(rings[:-1][::-1])
    return cage.fit(loose=add_hand(cage, *rings[-2:]))


def add_hand(cage, wrist, palm):
    """Below the palm's row. Returns the points at the roots of fingers and thumb."""
    names = list(FINGERS)

    def knuckle(i):
        beside = [f"left-{names[k]}-1" for k in (i - 1, i) if 0 <= k < 4]
        return mixed(({"left-hand": 1.0}, 0.62), *(({bone: 1.0}, 0.38 / len(beside)) for bone in beside))
    back, front = ([cage.add(added(HAND, p), knuckle(i)) for i, p in enumerate(row)] for row in (BACK, FRONT))
    row = [*back[1:], *front[:0:-1]]
    for low, high in (palm, wrist), (row, palm):
        for i in range(7):
            cage.face(low[i], low[i + 1], high[i + 1], high[i])
    for i, name in enumerate(names):
        rings = digit_tube(cage, name, [back[i], back[i + 1], front[i + 1], front[i]], FINGERS[name][2],
                           [(-1, -1), (1, -1), (1, 1), (-1, 1)])
        cage.tube(rings[::-1])
        cage.cap(rings[-1][::-1])
    return {*back, *front, *add_thumb(cage, wrist, palm, back, front)}


def add_thumb(cage, wrist, palm, back, front):
    """It comes out of the side of the hand, between the wrist and the root of the index."""
    places, directions, hinge = digit("thumb")
    middle, to = added(places[0], directions[0], 0.019), cross(hinge, directions[0])
    corners = [(-1, -1), (-1, 1), (1, 1), (1, -1)]
    base = cage.ring([added(HAND, added(added(middle, hinge, 0.0115 * a), to, 0.0115 * b)) for a, b in corners],
                     halves("left-hand", "left-thumb-1", 0.65))
    a, b, c, d = base
    cage.face(wrist[0], wrist[7], b, a)
    cage.face(wrist[7], palm[7], c, b)
    cage.face(palm[7], front[1], front[0], c)
    cage.face(front[0], back[0], d, c)
    cage.face(back[0], back[1], palm[0], d)
    cage.face(palm[0], wrist[0], a, d)
    rings = digit_tube(cage, "thumb", base, 0.0116, corners)
    cage.tube(rings)
    cage.cap(rings[-1])
    return base


def digit_joints():
    """Of the left hand: name, parent, place in the parent."""
    rows = []
    for name in (*FINGERS, "thumb"):
        parent, before = "hand", (0, 0, 0)
        for k, place in enumerate(digit(name)[0][:3]):
            rows.append((f"{name}-{k + 1}", parent, added(place, before, -1)))
            parent, before = f"{name}-{k + 1}", place
    return rows


# ---- Head and neck: height from the head's joint, front, back, width, forward of it, tilt (down in front, if below 0).
# They begin in the shirt.

HEAD = (0.002, 1.535)                     # of the joint: x, z
HEAD_ROWS = [(-0.115, 0.056, 0.058, 0.064, -0.034, -0.2), (-0.085, 0.053, 0.058, 0.060, -0.030, -0.3),
             (-0.053, 0.050, 0.056, 0.054, -0.024, -0.3), (-0.024, 0.049, 0.055, 0.0510, -0.017, -0.2),
             (0.000, 0.056, 0.055, 0.0505, -0.012, -0.1), (0.008, 0.072, 0.083, 0.0545, 0.014, -0.25),
             (0.027, 0.081, 0.085, 0.0600, 0.006, -0.14), (0.041, 0.081, 0.089, 0.0630, 0.006, -0.04),
             (0.056, 0.085, 0.090, 0.0665, 0.002, 0), (0.073, 0.088, 0.092, 0.0695, 0, 0),
             (0.093, 0.088, 0.094, 0.0715, 0, 0), (0.113, 0.0885, 0.095, 0.0725, 0, 0),
             (0.135, 0.0900, 0.095, 0.0735, 0, 0),
             (0.166, 0.084, 0.087, 0.0710, 0, 0), (0.196, 0.065, 0.071, 0.0590, 0, 0),
             (0.213, 0.037, 0.041, 0.035, 0, 0)]
COLUMNS, CROWDED = 14, 0.55               # of a row, closer together in front
JAW = 5                                   # the first row that has a face
FACE = [(0.055, 0.018, 0.062, 0, 15, 0.025),  # nose: height, reach below, above, angle, reach, how far out
        (0.053, 0.016, 0.022, 14, 10, 0.004),  # its wings
        (0.095, 0.026, 0.022, 24, 20, -0.010),  # eyes lie deeper
        (0.118, 0.020, 0.024, 24, 26, 0.002),  # brows
        (0.068, 0.030, 0.030, 46, 26, 0.004),  # cheeks
        (0.034, 0.016, 0.012, 0, 26, 0.002),  # lips
        (0.004, 0.016, 0.018, 0, 30, 0.005),  # chin
        (0.010, 0.026, 0.030, 95, 40, 0.003)]  # angle of the jaw
EAR = [(0.050, 0.005, 0.006, 0.003, 0.004), (0.058, 0.009, 0.009, 0.005, 0.002), (0.074, 0.011, 0.013, 0.006, -0.001),
       (0.090, 0.013, 0.017, 0.0065, -0.004), (0.101, 0.011, 0.014, 0.006, -0.006),
       (0.107, 0.005, 0.007, 0.004, -0.006)]


def features(z, angle):
    angle = min(angle, 360 - angle)
    return sum(far * fade((z - at) / (below if z < at else above)) * fade((angle - aside) / wide)
               for at, below, above, aside, wide, far in FACE)


def head_row(row, angles, with_face):
    at, front, back, width, middle, tilt = row
    points = []
    for angle, (x, y) in zip(angles, outline(angles, front, back, width)):
        out = features(at, angle) if with_face else 0.0
        x, y = x + out * math.cos(math.radians(angle)), y + out * math.sin(math.radians(angle))
        points.append((HEAD[0] + middle + x, y, HEAD[1] + at + tilt * (middle + x)))
    return points


def head_and_neck():
    cage = Cage()
    even = [360 * i / COLUMNS for i in range(COLUMNS)]
    angles = [angle - math.degrees(CROWDED * math.sin(math.radians(angle))) for angle in even]
    chain = ["chest", ("neck", 1.43, 1.50), ("head", 1.50, 1.548)]
    rings = []
    for number, row in enumerate(HEAD_ROWS):
        above = number >= JAW
        rings.append(cage.ring(head_row(row, angles, above),
                               {"head": 1.0} if above else lambda point: along(chain, point[2])))
    cage.tube(rings)
    cage.cap(rings[-1], (HEAD[0] - 0.006, 0.0, HEAD[1] + 0.2200))
    return cage.fit()


def ear():
    """The left one, which leans outward to the back and up."""
    origin, forward, aside, up = (-0.012, 0.0690, 0), (0.94, -0.34, 0), (0.34, 0.94, 0), (-0.10, 0.07, 1)
    cage, rings = Cage(), []
    for at, front, back, width, middle in EAR:
        points = []
        for x, y in outline([60 * i for i in range(6)], front, back, width):
            place = added(added(added(origin, forward, middle + x), aside, y), up, at)
            points.append(added((HEAD[0], 0, HEAD[1]), place))
        rings.append(cage.ring(points, {"head": 1.0}))
    cage.tube(rings)
    cage.cap(rings[0][::-1])
    cage.cap(rings[-1])
    return cage.fit(1)


# ---- Left shoe and its sole, from heel to toe: ahead of the ankle, up, down, width, middle's height from it, square
# above and below.

SHOE = [(-0.069, 0.030, 0.024, 0.0190, -0.052, 0.2, 0.5), (-0.057, 0.061, 0.033, 0.0325, -0.052, 0.2, 0.7),
        (-0.030, 0.080, 0.034, 0.0390, -0.052, 0.1, 0.8), (0.005, 0.090, 0.034, 0.0410, -0.052, 0, 0.8),
        (0.040, 0.074, 0.034, 0.0410, -0.052, 0, 0.8), (0.072, 0.050, 0.034, 0.0435, -0.052, 0.1, 0.8),
        (0.098, 0.037, 0.033, 0.0465, -0.053, 0.2, 0.8), (0.120, 0.029, 0.030, 0.0475, -0.056, 0.2, 0.8),
        (0.144, 0.024, 0.024, 0.0465, -0.062, 0.2, 0.8), (0.168, 0.021, 0.021, 0.0410, -0.065, 0.2, 0.8),
        (0.186, 0.015, 0.017, 0.0300, -0.067, 0.2, 0.7), (0.194, 0.008, 0.010, 0.0170, -0.071, 0.2, 0.5)]
SOLE = [(-0.073, 0.009, 0.010, 0.0220, -0.0765, 0.6, 0.6), (-0.060, 0.015, 0.0141, 0.0365, -0.0755, 0.8, 0.8),
        (-0.025, 0.016, 0.0141, 0.0430, -0.0755, 0.8, 0.8), (0.030, 0.016, 0.0141, 0.0440, -0.0755, 0.8, 0.8),
        (0.085, 0.012, 0.0121, 0.0485, -0.0775, 0.8, 0.8), (0.115, 0.010, 0.0111, 0.0515, -0.0785, 0.8, 0.8),
        (0.145, 0.010, 0.0111, 0.0505, -0.0785, 0.8, 0.8), (0.174, 0.010, 0.0107, 0.0425, -0.0785, 0.8, 0.8),
        (0.193, 0.009, 0.0090, 0.0290, -0.0785, 0.6, 0.6), (0.199, 0.006, 0.0060, 0.0160, -0.0785, 0.6, 0.6)]


# Where toes take over from the foot, ahead of the ankle: behind the ball, so that what stands on the floor stays.
BALL_BENDS = (BALL - 0.092, BALL - 0.004)


def shod(rows):
    cage = Cage()
    rings = []
    for ahead, up, down, width, middle, square, below in rows:
        points = [(ahead, LEG - aside, ANKLE + middle + high)
                  for high, aside in outline([45 * i for i in range(8)], up, down, width, square, below)]
        rings.append(cage.ring(points, along(["left-foot", ("left-toes", *BALL_BENDS)], ahead)))
    cage.tube(rings)
    cage.cap(rings[0][::-1])
    cage.cap(rings[-1])
    return cage.fit(3)


def shoe():
    return shod(SHOE)


def sole():
    return shod(SOLE)
