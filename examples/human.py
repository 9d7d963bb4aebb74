"""A man and his walk, for make_figures.py: in metres and degrees, until the film's unit scales both.

He stands along z and looks along x; y is to his left. Proportions: seven and a half heads, 1.75 m.
"""
import math

import human_cages
from cages import clothe, rest_places, scaled
from human_cages import digit, digit_joints

HIP, THIGH, SHIN, ANKLE = 0.925, 0.435, 0.40, 0.09  # height of the hips; lengths; height of the ankles
HIP_SIDE = 0.092
BALL = (0.115, -0.065)                             # of the foot, from the ankle: where the toes bend
HEEL = (-0.063, -0.09)                             # on which the foot comes down

# What is rigid: shapes of the library at his size, from the joint that carries them.
BOXES = {
    "hair": [[-0.1064, -0.0779, 0.0215], [0.0921, 0.0779, 0.2285]],
    "mouth": [[-0.0114, -0.0209, -0.0052], [0.0076, 0.0209, 0.0052]],
}
SHAPES = {"mouth": "sphere"}

# Joint: parent, place, limits about x, y, z, and of what is rigid its shape and material. Those of a
# pair are the left ones.
JOINTS = [
    ("pelvis", None, (0, 0, HIP), {"x": (-40, 40), "y": (-40, 60), "z": (-60, 60)}, None, None),
    ("spine", "pelvis", (-0.005, 0, 0.105), {"x": (-20, 20), "y": (-20, 45), "z": (-15, 15)}, None, None),
    ("chest", "spine", (0, 0, 0.17), {"x": (-20, 20), "y": (-15, 35), "z": (-30, 30)}, None, None),
    ("neck", "chest", (-0.015, 0, 0.265), {"x": (-25, 25), "y": (-35, 40), "z": (-40, 40)}, None, None),
    ("head", "neck", (0.022, 0, 0.07), {"x": (-20, 20), "y": (-30, 30), "z": (-40, 40)}, None, None),
    ("hair", "head", (0, 0, 0), {}, "hair", "hair"),
    ("trousers", "pelvis", (0, 0, 0), {}, None, None),
    ("shirt", "chest", (0, 0, 0), {}, None, None),
    ("mouth", "head", (0.0812, 0, 0.0271), {}, "mouth", "lips"),
]
PAIRS = [
    ("clavicle", "chest", (-0.015, 0.05, 0.20), {"x": (-10, 35), "z": (-25, 25)}, None, None),
    ("upper-arm", "clavicle", (0, 0.125, 0), {"x": (-30, 170), "y": (-170, 55), "z": (-80, 80)}, None, None),
    ("sleeve", "upper-arm", (0, 0, 0), {}, None, None),
    ("forearm", "upper-arm", (0, 0, -0.30), {"y": (-145, 0), "z": (-80, 80)}, None, None),
    ("hand", "forearm", (0, 0, -0.26), {"x": (-80, 70), "y": (-20, 30)}, None, None),
    ("thigh", "pelvis", (0, HIP_SIDE, 0), {"x": (-25, 45), "y": (-120, 25), "z": (-40, 45)}, None, None),
    ("shin", "thigh", (0, 0, -THIGH), {"y": (0, 150)}, None, None),
    ("foot", "shin", (0, 0, -SHIN), {"x": (-30, 25), "y": (-30, 50), "z": (-20, 20)}, None, None),
    ("sole", "foot", (0, 0, 0), {}, None, None),
    ("toes", "foot", (BALL[0], 0, BALL[1]), {"y": (-70, 40)}, None, None),
    ("toe-sole", "toes", (0, 0, 0), {}, None, None),
    ("ear", "head", (0, 0, 0), {}, None, None),
    ("arm", "upper-arm", (0, 0, 0), {}, None, None),
]
# Of the joints of a finger and of the thumb, about their x axes, in which they bend.
DIGITS = {"finger": [{"x": (-85, 35), "y": (-15, 15)}, {"x": (-95, 22)}, {"x": (-75, 15)}],
          "thumb": [{"x": (-25, 35), "y": (-15, 15), "z": (-25, 25)}, {"x": (-15, 55)}, {"x": (-20, 75)}]}
# What commands like walk call the joints of a side.
LIMBS = [("hip", "thigh"), ("knee", "shin"), ("ankle", "foot"), ("toes", "toes"),
         ("shoulder", "upper-arm"), ("elbow", "forearm"), ("wrist", "hand")]
# Balls on the head: name, place of the left one, radii, how far turned to the side, material.
FACE = [("eye", (0.0670, 0.0294, 0.0921), (0.0128, 0.0142, 0.0114), 0, "white"),
        ("iris", (0.0755, 0.0299, 0.0917), (0.0057, 0.0065, 0.0068), 0, "iris"),
        ("lid", (0.0655, 0.0294, 0.0982), (0.0142, 0.0157, 0.0109), 0, "skin"),
        ("brow", (0.0736, 0.0323, 0.1126), (0.0071, 0.0171, 0.0034), 24, "hair")]


def soft(color, specular=0.04, exponent=10):
    """Cloth, skin, hair: a broad, weak highlight."""
    return {"color": color, "reflection": "blinn-phong", "ambient": 0.35, "diffuse": 0.75, "specular": specular,
            "exponent": exponent}


def glazed(color, roughness=0.25):
    """Leather, glass, lacquer: matt under a clear layer."""
    return {"color": color, "reflection": "cook-torrance", "ambient": 0.35, "diffuse": 0.75, "specular": 1.5,
            "roughness": roughness}


MATERIALS = {"skin": soft([0.87, 0.64, 0.50], 0.10, 24), "hair": soft([0.22, 0.13, 0.09], 0.12, 24),
             "shirt": soft([0.84, 0.22, 0.20]), "trousers": soft([0.24, 0.34, 0.55]),
             "shoe": glazed([0.42, 0.25, 0.16], 0.35), "rubber": soft([0.90, 0.88, 0.83]),
             "lips": soft([0.76, 0.44, 0.38], 0.15, 30), "white": glazed([0.92, 0.92, 0.90]),
             "iris": glazed([0.13, 0.10, 0.10], 0.15)}


def human(unit):
    """The model, a metre being `unit` long."""
    joints = [joint(*row, unit=unit) for row in JOINTS]
    for side, sign in ("left", 1), ("right", -1):
        for name, parent, *rest in PAIRS:
            above = parent if parent in ("chest", "head", "pelvis") else f"{side}-{parent}"
            joints.append(joint(f"{side}-{name}", above, *rest, sign, unit))
        joints += digits(side, sign, unit)
        joints += face(side, sign, unit)
    shapes = dress(joints, unit)
    limbs = {part: part for part in ("pelvis", "spine", "chest", "neck", "head")}
    limbs |= {side: {limb: f"{side}-{name}" for limb, name in LIMBS} for side in ("left", "right")}
    return {"materials": MATERIALS, "limbs": limbs, "shapes": shapes, "joints": joints}


def turned(limits, sign):
    """Of the right side, where turns about x and z are the other way round."""
    return {axis: list(limit) if axis == "y" or sign == 1 else [-limit[1], -limit[0]] for axis, limit in limits.items()}


def joint(name, parent, place, limits, shape, material, sign=1, unit=1.0):
    made = {"name": name} | ({"parent": parent} if parent else {})
    made |= {"place": scaled((place[0], sign * place[1], place[2]), unit), "limits": turned(limits, sign)}
    if shape:
        made["segment"] = {"shape": SHAPES.get(shape, shape), "sbb": [scaled(end, unit) for end in BOXES[shape]],
                           "material": material}
    return made


def digits(side, sign, unit):
    """Joints of the fingers and the thumb, which bend about their x axes."""
    made = []
    for name, parent, place in digit_joints():
        finger, number = name.split("-")
        limits = DIGITS["thumb" if finger == "thumb" else "finger"][int(number) - 1]
        row = joint(f"{side}-{name}", f"{side}-{parent}", place, limits, None, None, sign, unit)
        if finger == "thumb":
            _, directions, hinge = digit("thumb")
            row["x_axis"] = scaled((hinge[0], sign * hinge[1], hinge[2]), 1)
            row["y_axis"] = scaled((sign * directions[0][0], directions[0][1], sign * directions[0][2]), 1)
        made.append(row)
    return made


def face(side, sign, unit):
    made = []
    for name, (x, y, z), radii, aside, material in FACE:
        c, s = math.cos(math.radians(aside)), sign * math.sin(math.radians(aside))
        made.append({"name": f"{side}-{name}", "parent": "head", "place": scaled((x, sign * y, z), unit),
                     **({"x_axis": scaled((c, s, 0), 1), "y_axis": scaled((-s, c, 0), 1)} if aside else {}),
                     "limits": {},
                     "segment": {"shape": "sphere", "sbb": [scaled([-r for r in radii], unit), scaled(radii, unit)],
                                 "material": material}})
    return made


# ---- Surfaces that bend: shape, the joint that has it, material, level. Those of a pair are the left ones.

SURFACES = [(human_cages.trousers, "trousers", "trousers", 1), (human_cages.shirt, "shirt", "shirt", 1),
            (human_cages.head_and_neck, "head", "skin", 1), (human_cages.ear, "left-ear", "skin", 1),
            (human_cages.arm, "left-arm", "skin", 1), (human_cages.shoe, "left-foot", "shoe", 0),
            (human_cages.sole, "left-sole", "rubber", 0)]


def dress(joints, unit):
    """Gives joints segments with skins. Returns their shapes."""
    shapes = {}
    for make, carrier, material, level in SURFACES:
        cage, name = make(), make.__name__.replace("_", "-")
        if not carrier.startswith("left-"):
            shapes[name] = clothe(joints, carrier, name, cage, material, unit, level)
            continue
        for side, one in ("left", cage), ("right", cage.mirrored()):
            shape = f"{side}-{name}"
            shapes[shape] = clothe(joints, carrier.replace("left", side), shape, one, material, unit, level)
    lift_sleeves(joints)
    return shapes


def lift_sleeves(joints):
    """The shirt's `bind`: it is made with lifted arms."""
    places = rest_places(joints)
    skin = next(each for each in joints if each["name"] == "shirt")["segment"]["skin"]
    skin["bind"] = []
    for bone in skin["joints"]:
        angle = human_cages.LIFTED if bone == "left-sleeve" else -human_cages.LIFTED if bone == "right-sleeve" else 0
        back = transposed(turn(angle, 0, 0))
        place = applied(back, [a - b for a, b in zip(places["shirt"], places[bone])])
        skin["bind"].append([round(v, 6) + 0.0 for row, at in zip(back, place) for v in (*row, at)])


# ---- Matrices: three rows; turns in degrees as in a pose.

def turn(a, b, c):
    """Rot(x, a) Rot(y, b) Rot(z, c)."""
    (ca, sa), (cb, sb), (cc, sc) = ((math.cos(math.radians(t)), math.sin(math.radians(t))) for t in (a, b, c))
    return [[cb * cc, -cb * sc, sb],
            [sa * sb * cc + ca * sc, -sa * sb * sc + ca * cc, -sa * cb],
            [-ca * sb * cc + sa * sc, ca * sb * sc + sa * cc, ca * cb]]


def angles(m):
    """Of the turn that makes `m`."""
    return [math.degrees(t) for t in (math.atan2(-m[1][2], m[2][2]), math.asin(max(-1, min(1, m[0][2]))),
                                      math.atan2(-m[0][1], m[0][0]))]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def applied(m, v):
    return [sum(m[i][k] * v[k] for k in range(3)) for i in range(3)]


def transposed(m):
    return [list(row) for row in zip(*m)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit_vector(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


# ---- The walk. A foot's phase runs from 0, where its heel strikes, to 1.

STRIDE = 1.14                                # metres in a cycle
FLAT, LIFT, OFF = 2 / 24, 8 / 24, 14 / 24     # phases, at keys: sole down, heel rises, toes leave
STRIKE_PITCH, OFF_PITCH = -20, 50            # degrees of the sole, toes down
SAG = 0.0015                                 # half of what feet sink between keys
AHEAD = 0.30                                 # of the pelvis, where a foot stands flat at its strike
APART, TOE_OUT = 0.062, 6                    # of a foot from the line of the walk; degrees
SWING_PITCH = [(0.66, 63), (0.76, 38), (0.87, 0), (0.95, -19)]
SWING_RISE = [(0.625, 0.194), (0.70, 0.216), (0.80, 0.176), (0.90, 0.119)]
SWING_TOES = [(0.667, -46), (0.72, -18), (0.78, -3), (0.86, 0)]


def hermite(points, slopes, x):
    for (x0, y0), (x1, y1), m0, m1 in zip(points, points[1:], slopes, slopes[1:]):
        if x <= x1:
            h, t = x1 - x0, (x - x0) / (x1 - x0)
            return (((2 * t - 3) * t * t + 1) * y0 + ((t - 2) * t + 1) * t * h * m0 +
                    (3 - 2 * t) * t * t * y1 + (t - 1) * t * t * h * m1)
    return points[-1][1]


def through(start, between, end, x):
    """A smooth curve through points; start and end have slopes as well: (x, y, slope)."""
    points = [start[:2], *between, end[:2]]
    slopes = [start[2]] + [(c[1] - a[1]) / (c[0] - a[0]) for a, c in zip(points, points[2:])] + [end[2]]
    return hermite(points, slopes, x)


def rolled(pivot, pitch):
    """How far the ankle of a left foot is ahead and aside of where it stands flat, and its height, when the foot is
    pitched about a pivot that stays in place."""
    c, s = math.cos(math.radians(pitch)), math.sin(math.radians(pitch))
    ahead = pivot[0] - pivot[0] * c - pivot[1] * s
    out = math.radians(TOE_OUT)
    return ahead * math.cos(out), ahead * math.sin(out), ANKLE + pivot[1] + pivot[0] * s - pivot[1] * c


def standing_foot(phase):
    """Ankle ahead and aside of where it stands flat, its height, pitch of the sole, turn of the toes."""
    if phase < FLAT:
        pitch = STRIKE_PITCH * (1 - phase / FLAT)
        return (*rolled(HEEL, pitch), pitch, 0)
    if phase < LIFT:
        return 0, 0, ANKLE, 0, 0
    pitch = OFF_PITCH * ((phase - LIFT) / (OFF - LIFT)) ** 2
    return (*rolled(BALL, pitch), pitch, -pitch)


def foot_at(phase):
    if phase < OFF:
        return standing_foot(phase)
    step = 1e-4
    off, before = standing_foot(OFF - 1e-9), standing_foot(OFF - 1e-9 - step)
    strike, after = standing_foot(0), standing_foot(step)

    def swung(i, between, more=0):
        return through((OFF, off[i], (off[i] - before[i]) / step), between,
                       (1, strike[i] + more, (after[i] - strike[i]) / step), phase)
    return swung(0, [], STRIDE), swung(1, []), swung(2, SWING_RISE), swung(3, SWING_PITCH), swung(4, SWING_TOES)


def leg(pelvis, hip, ankle, pitch, toes, sign):
    """Turns of thigh, shin, foot and toes that bring the ankle there; knees bend only as knees do."""
    foot = times(turn(0, 0, sign * TOE_OUT), turn(0, pitch, 0))
    down = [a - h for a, h in zip(ankle, hip)]
    length = math.sqrt(sum(x * x for x in down))
    assert length < 0.9995 * (THIGH + SHIN), f"a leg is too short by {length - THIGH - SHIN}"
    knee = math.pi - math.acos((THIGH ** 2 + SHIN ** 2 - length ** 2) / (2 * THIGH * SHIN))
    lean = math.atan2(SHIN * math.sin(knee), THIGH + SHIN * math.cos(knee))  # of the thigh before the straight line
    hinge = unit_vector(cross([row[0] for row in turn(0, 0, sign * TOE_OUT * 0.7)], down))
    up = unit_vector([-x for x in down])
    straight = transposed([cross(hinge, up), hinge, up])
    thigh = times(straight, turn(0, -math.degrees(lean), 0))
    shin = times(thigh, turn(0, math.degrees(knee), 0))
    return (angles(times(transposed(pelvis), thigh)), [0, math.degrees(knee), 0],
            angles(times(transposed(shin), foot)), [0, toes, 0])


def pelvis_at(phase):
    """Place from the middle of the walk, and turns, by the left foot's phase."""
    wave = lambda at, times=1: math.cos(2 * math.pi * times * (phase - at))
    return [0.012 * wave(0.015, 2), 0.020 * wave(0.31), HIP - 0.020 - 0.0115 * wave(0.056, 2)], \
           [2.5 * wave(0.18), 3 + 1.0 * wave(0.05, 2), -5 * wave(0.0)]


def pose_at(phase, forward):
    """Joints' turns and the pelvis' place, `forward` along the walk."""
    wave = lambda at: math.cos(2 * math.pi * (phase - at))
    offset, turns = pelvis_at(phase)
    place = [forward + offset[0], offset[1], offset[2]]
    pelvis = turn(*turns)
    pose = {"pelvis": turns,
            "spine": [-2.2 * wave(0.18), 0.5, 4.5 * wave(0.02)],
            "chest": [-1.4 * wave(0.18), 1.5 - 0.8 * math.cos(4 * math.pi * (phase - 0.1)), 5.5 * wave(0.04)],
            "neck": [0.6 * wave(0.18), 1, -2.6 * wave(0.05)], "head": [0.5 * wave(0.18), -4, -2.4 * wave(0.05)]}
    for side, sign, own in ("left", 1, phase % 1), ("right", -1, (phase + 0.5) % 1):
        swing = lambda late: math.cos(2 * math.pi * (own - late))
        ahead, aside, height, pitch, toes = foot_at(own)
        ankle = [forward + AHEAD - own * STRIDE + ahead, sign * (APART + aside), height]
        hip = [p + q for p, q in zip(place, applied(pelvis, [0, sign * HIP_SIDE, 0]))]
        for name, turns in zip(("thigh", "shin", "foot", "toes"), leg(pelvis, hip, ankle, pitch, toes, sign)):
            pose[f"{side}-{name}"] = turns
        pose[f"{side}-clavicle"] = [sign * 1.5 * swing(0.5), 0, sign * 3 * swing(0)]
        pose[f"{side}-upper-arm"] = [sign * (8 + 1.5 * swing(0.5)), -3 + 21 * swing(0.02), sign * -12]
        pose[f"{side}-forearm"] = [0, -(30 - 15 * swing(0.09)), sign * -14]
        pose[f"{side}-hand"] = [sign * (-6 + 5 * swing(0.2)), 4 + 5 * swing(0.16), 0]
    return place, pose


def walk(frames, every, cycle, start, heading, unit, looks):
    """Keys of an actor that walks towards `heading`, degrees, so that it passes `start` at frame 0.

    `looks`: (frame, turns of the head beyond the walk's own), at least two.
    """
    c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
    keys = []
    for frame in range(0, frames + every, every):
        (x, y, z), pose = pose_at(frame / cycle, STRIDE * frame / cycle)
        for joint, share in ("neck", 0.5), ("head", 0.5):
            for axis in range(3):
                (first, *between, last) = [(at, to[axis]) for at, to in looks]
                pose[joint][axis] += share * through((*first, 0), between, (*last, 0), frame)
        x, y = x * unit, y * unit
        keys.append({"frame": frame, "place": [round(v, 4) for v in (start[0] + c * x - s * y, start[1] + s * x + c * y,
                                                                    (z - HIP + SAG) * unit)],
                     "pose": {name: [round(v, 2) + 0.0 for v in turns] for name, turns in pose.items()}})
    return keys
