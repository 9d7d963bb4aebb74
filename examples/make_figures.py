#!/usr/bin/env python3
"""Writes the films with articulated figures and their models: bodies, caterpillar, human, robot-arm and demo.

With an argument: into that folder instead of its own.
"""
import math
import pathlib
import sys

from animals import dog, horse
from human import glazed, human, soft, walk
from make_scenes import HERE, text_of

# ---- Caterpillar: 14 body joints from tail to head, 20 feet, eyes, and antennae of two joints each: 40.

BODY, LENGTH = 14, 0.5            # joints, and their distance along x
WAVE, BUMP, SLOPE = 3.5, 2.4, 1.1  # length of a wave, of the bump in it, and its steepest slope in radians


def matt(color):
    return {"color": color, "ambient": 0.35, "diffuse": 0.8, "specular": 0}


def metal(color, roughness):
    """It shows little but what it reflects: all light from around it."""
    return {"color": color, "reflection": "metallic-roughness", "ambient": 0.7, "roughness": roughness, "metallic": 1}


def slope(s):
    """Of the body at s along it, in radians, as a wave at rest."""
    s %= WAVE
    return SLOPE * math.sin(2 * math.pi * s / BUMP) if s < BUMP else 0.0


def integral(function, start, end, steps=400):
    step = (end - start) / steps
    return sum(function(start + (i + 0.5) * step) for i in range(steps)) * step


def ball(radius, material, stretch=(1, 1, 1)):
    far = [round(radius * s, 4) for s in stretch]
    return {"shape": "sphere", "sbb": [[-x for x in far], far], "material": material}


def caterpillar():
    joints = []
    for i in range(BODY):
        head = i == BODY - 1
        radius = 0.62 if head else 0.36 + 0.12 * math.sin(math.pi * (i + 1.5) / BODY)
        joint = {"name": "head" if head else f"body-{i}", "limits": {"y": [-80, 80], "z": [-30, 30]},
                 "segment": ball(radius, "face" if head else ("leaf", "lime")[i % 2], (1, 1, 1) if head else (0.9, 1, 1))}
        if i > 0:
            joint.update(parent=f"body-{i - 1}", place=[LENGTH if not head else 0.62, 0, 0 if not head else 0.15])
        joints.append(joint)
    for i in list(range(1, 6)) + list(range(8, 13)):
        for side, y in ("left", 0.24), ("right", -0.24):
            joints.append({"name": f"foot-{i}-{side}", "parent": f"body-{i}", "place": [0, y, -0.34],
                           "limits": {"y": [-40, 40]},
                           "segment": {"shape": "cone", "top": 0.55, "sbb": [[-0.13, -0.13, -0.2], [0.13, 0.13, 0.1]],
                                       "material": "boot"}})
    for side, y in ("left", 0.27), ("right", -0.27):
        joints.append({"name": f"eye-{side}", "parent": "head", "place": [0.47, y, 0.2], "limits": {},
                       "segment": ball(0.17, "eye")})
        joints.append({"name": f"antenna-{side}", "parent": "head", "place": [0.1, y, 0.5],
                       "limits": {"x": [-60, 60], "y": [-60, 60]},
                       "segment": {"shape": "cone", "top": 0.5, "sbb": [[-0.06, -0.06, 0], [0.06, 0.06, 0.55]],
                                   "material": "boot"}})
        joints.append({"name": f"tip-{side}", "parent": f"antenna-{side}", "place": [0, 0, 0.58], "limits": {},
                       "segment": ball(0.13, "face")})
    materials = {"leaf": soft([0.36, 0.70, 0.26], 0.2, 40), "lime": soft([0.78, 0.84, 0.30], 0.2, 40),
                 "face": soft([0.92, 0.42, 0.26], 0.2, 40), "boot": glazed([0.30, 0.20, 0.18]),
                 "eye": glazed([0.10, 0.10, 0.13], 0.15)}
    return {"materials": materials, "joints": joints}


def crawl(frames, period, start, height):
    """Keys of a caterpillar that crawls along x: the wave runs from tail to head, what touches the floor rests."""
    keys = []
    for frame in range(0, frames + 1, 4):
        run = WAVE * frame / period  # how far the wave has run along the body
        forward = integral(lambda s: 1 - math.cos(slope(s)), -run, 0)
        lift = integral(lambda s: math.sin(slope(s)), -math.ceil(run / WAVE) * WAVE, -run)
        pose, before = {}, 0
        for i in range(BODY):
            here = slope((i + 0.5) * LENGTH - run) if i < BODY - 1 else 0.35 * slope((i - 1) * LENGTH - run)
            name = "head" if i == BODY - 1 else f"body-{i}"
            pose[name] = [0, round(math.degrees(before - here), 2) + 0.0, round(3 * math.sin(0.09 * frame + 0.5 * i), 2)]
            before = here
        sway = 18 * math.sin(2 * math.pi * frame / 24)
        pose["antenna-left"] = [-14, round(12 + sway, 2), 0]
        pose["antenna-right"] = [14, round(12 - sway, 2), 0]
        keys.append({"frame": frame, "place": [round(start[0] + forward, 4), start[1], round(height + lift, 4)],
                     "pose": pose})
    return keys


# ---- Robot arm: a turret, shoulder and elbow, wrist and two fingers; it lifts a teapot by its knob.

UPPER, FORE, HAND, SHOULDER = 1.7, 1.4, 0.62, 1.05


def bone(name, parent, place, limits, shape, sbb, material, **options):
    joint = {"name": name, "parent": parent, "place": place, "limits": limits,
             "segment": {"shape": shape, **options, "sbb": sbb, "material": material}}
    return {key: value for key, value in joint.items() if value is not None}


def square(half, low, high):
    return [[-half, -half, low], [half, half, high]]


def robot_arm():
    def axle(name, parent, place, radius, width):
        return bone(name, parent, place, {}, "torus", [[-radius, -width, -radius], [radius, width, radius]], "steel")

    finger = [[-0.07, -0.035, -0.05], [0.07, 0.035, 0.45]]
    joints = [
        bone("foot", None, [0, 0, 0], {}, "cone", square(0.75, 0, 0.3), "steel", top=0.7),
        bone("turret", "foot", [0, 0, 0.3], {"z": [-170, 170]}, "cylinder", square(0.42, 0, 0.5), "paint"),
        bone("shoulder", "turret", [0, 0, SHOULDER - 0.3], {"y": [-60, 120]}, "cone", square(0.24, 0, UPPER), "paint",
             top=0.7),
        bone("shoulder-ball", "turret", [0, 0, SHOULDER - 0.3], {}, "sphere", square(0.36, -0.36, 0.36), "steel"),
        bone("elbow", "shoulder", [0, 0, UPPER], {"y": [0, 160]}, "cone", square(0.19, 0, FORE), "paint", top=0.6),
        bone("elbow-ball", "shoulder", [0, 0, UPPER], {}, "sphere", square(0.27, -0.27, 0.27), "steel"),
        bone("wrist", "elbow", [0, 0, FORE], {"y": [-120, 120]}, "cylinder", square(0.15, 0, 0.2), "steel"),
        bone("wrist-ball", "elbow", [0, 0, FORE], {}, "sphere", square(0.18, -0.18, 0.18), "steel"),
        bone("palm", "wrist", [0, 0, 0.2], {"z": [-180, 180]}, "box", [[-0.1, -0.26, 0], [0.1, 0.26, 0.1]], "paint"),
        bone("finger-left", "palm", [0, 0.2, 0.1], {"x": [-35, 35]}, "box", finger, "steel"),
        bone("finger-right", "palm", [0, -0.2, 0.1], {"x": [-35, 35]}, "box", finger, "steel"),
    ]
    materials = {"paint": glazed([0.96, 0.60, 0.14]), "steel": metal([0.66, 0.68, 0.72], 0.35)}
    return {"materials": materials, "joints": joints}


def reach(angle, radius, height, grip):
    """The pose that holds the hand straight down over a place; angle in degrees, grip 0 (shut) to 1."""
    out, up = radius, height + HAND - SHOULDER
    across = math.hypot(out, up)
    elbow = math.pi - math.acos((UPPER ** 2 + FORE ** 2 - across ** 2) / (2 * UPPER * FORE))
    shoulder = math.pi / 2 - math.atan2(up, out) - math.atan2(FORE * math.sin(elbow), UPPER + FORE * math.cos(elbow))
    a, b = round(math.degrees(shoulder), 2), round(math.degrees(elbow), 2)
    open_by = round(-11 + 31 * grip, 2)
    return {"turret": [0, 0, angle], "shoulder": [0, a, 0], "elbow": [0, b, 0], "wrist": [0, round(180 - a - b, 2), 0],
            "finger-left": [-open_by, 0, 0], "finger-right": [open_by, 0, 0]}


def both(time):
    """The ease "both"."""
    def curve(p, q, s):
        return 3 * (1 - s) ** 2 * s * p + 3 * (1 - s) * s * s * q + s ** 3
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if curve(0.42, 0.58, middle) < time else (low, middle)
    return curve(0, 1, low)


def pose_at(keys, frame):
    """The numbers of every joint at a frame; all joints are hinges."""
    for now, after in zip(keys, keys[1:]):
        if now["frame"] <= frame <= after["frame"]:
            part = both((frame - now["frame"]) / (after["frame"] - now["frame"]))
            return {name: [a + part * (b - a) for a, b in zip(now["pose"][name], after["pose"][name])]
                    for name in now["pose"]}
    return keys[-1]["pose"]


def grip_place(pose):
    """Where the fingers meet, and how the turret stands."""
    angle, lean = math.radians(pose["turret"][2]), 0
    out, up = 0, SHOULDER
    for joint, length in ("shoulder", UPPER), ("elbow", FORE), ("wrist", HAND):
        lean += math.radians(pose[joint][1])
        out, up = out + length * math.sin(lean), up + length * math.cos(lean)
    return out * math.cos(angle), out * math.sin(angle), up, angle


def carried(keys, taken, left, start, size):
    """Matrices of a teapot held by its knob from frame `taken` to frame `left`."""
    x0, y0, z0, angle0 = grip_place(pose_at(keys, taken))
    matrices = []
    for frame in [0] + list(range(taken + 1, left + 1)):
        x, y, z, angle = grip_place(pose_at(keys, max(frame, taken)))
        turn = angle - angle0
        c, s = math.cos(turn), math.sin(turn)
        dx, dy, dz = start[0] - x0, start[1] - y0, start[2] - z0
        rows = [[c * size, -s * size, 0, x + c * dx - s * dy], [s * size, c * size, 0, y + s * dx + c * dy],
                [0, 0, size, z + dz]]
        matrices.append({"frame": frame, "segments": {"teapot": [[round(v, 6) + 0.0 for v in row] for row in rows]}})
    return matrices


# ---- Films.

def prop(shape, sbb, material, **options):
    return {"joints": [{"name": shape, "limits": {}, "segment": {"shape": shape, **options, "sbb": sbb,
                                                                 "material": material}}]}


SKY = {"sky": [0.76, 0.86, 1.0], "ground": [0.62, 0.57, 0.50]}
LIGHTS = [{"direction": [-0.4, -0.45, 0.95], "color": [1.0, 0.95, 0.86], "intensity": 1.3, "shadow": True},
          {"direction": [0.9, -0.1, 0.35], "color": [0.70, 0.82, 1.0], "intensity": 0.3},
          {"place": [-3, -4, 5], "color": [1.0, 0.90, 0.75], "intensity": 0.5, "reach": 6}]
# Of the robot arm: on 16 nodes, forecasts of it with shadows are 17 % too long.
NO_SHADOWS = [{key: value for key, value in LIGHTS[0].items() if key != "shadow"}, *LIGHTS[1:]]
FLOOR = {"joints": [{"name": "floor", "limits": {},
                     "segment": {"shape": "box", "sbb": [[-80, -40, -0.2], [80, 120, 0]], "material": "floor"}}]}
GLAZE = {"floor": matt([0.74, 0.72, 0.68]) | {"sides": 1}, "copper": metal([0.95, 0.62, 0.45], 0.3),
         "sea": glazed([0.26, 0.58, 0.72]), "rose": glazed([0.86, 0.40, 0.50]),
         "sand": glazed([0.90, 0.78, 0.52]), "violet": glazed([0.60, 0.48, 0.84])}


def tiles(size=2, columns=range(-9, 9), rows=range(-5, 20)):
    """Every second square of a chessboard, a hair above the floor: one flat patch each. It is paint, which casts nothing."""
    square = [[round(i / 3, 6), round(j / 3, 6), 1] for j in range(4) for i in range(4)]
    return {"materials": {"slate": matt([0.50, 0.53, 0.58]) | {"casts": False}}, "shapes": {"square": [square]},
            "joints": [{"name": f"tile-{i}-{j}", "limits": {},
                        "segment": {"shape": "square", "material": "slate",
                                    "sbb": [[size * i, size * j, -0.1], [size * (i + 1), size * (j + 1), 0.004]]}}
                       for j in rows for i in columns if (i + j) % 2 == 0]}


TEAPOT = prop("teapot", [[-3, -2, 0], [3.525, 2, 3.15]], "copper")


def standing(name, model, x, y, turn=0.0, z=0.0):
    return {"name": name, "model": model, "place": [x, y, z], "turn": [0, 0, turn]}


def film(frames, size, camera, models, actors, lights=LIGHTS, materials={}, **more):
    return {"frames": frames, "rate": 24, "size": size, "background": [0.62, 0.72, 0.82], **more, "camera": camera,
            "ambient": SKY, "lights": lights, "materials": GLAZE | materials, "models": {"floor": FLOOR, "tiles": "models/tiles.json", **models},
            "actors": [{"name": "floor", "model": "floor"}, {"name": "tiles", "model": "tiles"}, *actors]}


def caterpillar_film():
    models = {"caterpillar": "models/caterpillar.json", "teapot": TEAPOT,
              "box": prop("box", [[-0.8, -0.8, 0], [0.8, 0.8, 1.6]], "sea")}
    actors = [{"name": "caterpillar", "model": "caterpillar", "keys": crawl(48, 24, (-4.6, -1.2), 0.54)},
              standing("teapot", "teapot", -1.5, 4.2, 25), standing("box-left", "box", -5.6, 3.2, 20),
              standing("box-right", "box", 3.9, 3.0, -15), standing("box-above", "box", 3.9, 3.1, 28, 1.6)]
    camera = {"eye": [1.5, -11.0, 4.6], "at": [-0.7, 0.5, 1.0], "fov": 38}
    return film(48, [640, 360], camera, models, actors)


METRE = 2.9  # in the demo, where a caterpillar is a man's pet

# They cast no shadows: tables of docs/ measure the demo, and forecasts of `bodies` with shadows are too far off.
SUN = [{"direction": [0.55, -0.75, 0.85], "color": [1.0, 0.95, 0.86], "intensity": 1.5},
       {"direction": [-0.90, -0.45, 0.25], "color": [0.75, 0.85, 1.0], "intensity": 0.3},
       {"direction": [-0.50, 0.85, 0.50], "color": [1.0, 0.93, 0.82], "intensity": 0.7}]


def hill(wide, deep, high):
    return prop("sphere", [[-wide, -deep, -high], [wide, deep, high]], "hill")


def demo_film():
    models = {"human": "models/human.json", "caterpillar": "models/caterpillar.json", "teapot": TEAPOT,
              "box": prop("box", [[-0.9, -0.9, 0], [0.9, 0.9, 1.8]], "sea"),
              "ball": prop("sphere", [[-0.9, -0.9, 0], [0.9, 0.9, 1.8]], "rose"),
              "column": prop("cylinder", [[-0.55, -0.55, 0], [0.55, 0.55, 3.6]], "sand"),
              "spire": prop("cone", [[-0.85, -0.85, 0], [0.85, 0.85, 2.6]], "violet"),
              "ring": prop("torus", [[-1.1, -1.1, 0], [1.1, 1.1, 0.55]], "sand", tube=0.125),
              "hill": hill(45, 20, 9), "long-hill": hill(80, 20, 6)}
    looks = [(0, (0, 0, 8)), (20, (0, 2, 10)), (40, (0, 3, -40)), (60, (0, 3, -44)), (73, (0, 1, -36))]
    actors = [{"name": "man", "model": "human", "turn": [0, 0, -20],
               "keys": walk(72, 2, 24, (-5.4, 1.0), -20, METRE, looks)},
              {"name": "caterpillar", "model": "caterpillar", "keys": crawl(72, 24, (-3.2, 4.6), 0.54)},
              standing("teapot", "teapot", 3.6, 9.6, 20), standing("box", "box", 7.0, 4.6, -20),
              standing("spire", "spire", 7.0, 4.6, 0, 1.8), standing("column-left", "column", -8.2, 10.6),
              standing("column-right", "column", -5.6, 11.6), standing("ball", "ball", -7.2, 5.6),
              standing("ring", "ring", 4.9, 0.6, 0), standing("small-box", "box", 9.6, 9.6, 35),
              standing("hill-left", "hill", -60, 110), standing("hill-right", "long-hill", 45, 115)]
    camera = {"eye": [0.6, -14.2, 4.2], "at": [-0.25, 0.8, 2.0], "fov": 29.5}
    return film(72, [960, 540], camera, models, actors, lights=SUN,
                materials={"hill": matt([0.45, 0.60, 0.50])})


def robot_film():
    left, right, size, table = -38, 52, 0.22, 0.7
    knob = table + 3.02 * size
    keys = [{"frame": 0, "pose": reach(10, 1.6, 1.9, 1)},
            {"frame": 18, "pose": reach(left, 2.1, knob + 0.7, 1)},
            {"frame": 26, "pose": reach(left, 2.1, knob, 1)},
            {"frame": 32, "pose": reach(left, 2.1, knob, 0)},
            {"frame": 42, "pose": reach(left, 2.1, knob + 0.9, 0)},
            {"frame": 64, "pose": reach(right, 2.1, knob + 0.9, 0)},
            {"frame": 76, "pose": reach(right, 2.1, knob, 0)},
            {"frame": 82, "pose": reach(right, 2.1, knob, 1)},
            {"frame": 96, "pose": reach(10, 1.6, 1.9, 1)}]
    keys = [{"frame": key["frame"], "ease": "both", "pose": key["pose"]} for key in keys]
    x, y = (2.1 * f(math.radians(left)) for f in (math.cos, math.sin))
    other = [round(2.1 * f(math.radians(right)), 4) for f in (math.cos, math.sin)]
    models = {"robot-arm": "models/robot-arm.json", "teapot": prop("teapot", TEAPOT["joints"][0]["segment"]["sbb"], "sea"),
              "table": prop("cylinder", [[-0.75, -0.75, 0], [0.75, 0.75, table]], "sand"),
              "ball": prop("sphere", [[-0.5, -0.5, 0], [0.5, 0.5, 1]], "rose")}
    actors = [{"name": "robot", "model": "robot-arm", "keys": keys},
              {"name": "teapot", "model": "teapot", "matrices": carried(keys, 32, 76, (x, y, table), size)},
              standing("table-left", "table", round(x, 4), round(y, 4)), standing("table-right", "table", *other),
              standing("ball-1", "ball", -1.6, 2.2), standing("ball-2", "ball", -2.4, 0.9)]
    camera = {"eye": [6.2, -2.8, 3.3], "at": [0.6, 0.15, 1.2], "fov": 36}
    return film(96, [640, 360], camera, models, actors, lights=NO_SHADOWS, intervals="keyframes")


# Other people of the man's segments: how each differs from him.
FIGURES = {
    "child": {"branches": {"head": 1.5}, "height": 3.35,
              "joints": {"*-thigh": [1, 1, 0.84], "*-shin": [1, 1, 0.86], "*-clavicle": [0.95, 0.86, 0.95],
                         "*-upper-arm": [1, 1, 0.92], "*-forearm": [1, 1, 0.92], "chest": [1, 0.94, 0.94],
                         "pelvis": [1, 0.94, 1]}},
    "tall": {"branches": {"head": 0.92, "*-foot": 1.05}, "height": 5.75,
             "joints": {"*-thigh": [0.96, 0.96, 1.12], "*-shin": [0.96, 0.96, 1.14], "*-upper-arm": [0.95, 0.95, 1.1],
                        "*-sleeve": [0.95, 0.95, 1.1], "*-forearm": [0.95, 0.95, 1.1], "neck": [0.92, 0.92, 1.1]}},
    "stout": {"branches": {"head": 1.04}, "height": 4.8,
              "joints": {"spine": [1.38, 1.2, 1], "chest": [1.3, 1.18, 0.97], "pelvis": [1.34, 1.22, 1],
                        "*-clavicle": [1.2, 1.05, 1.1], "*-thigh": [1.22, 1.24, 0.9], "*-shin": [1.2, 1.2, 0.92],
                        "*-upper-arm": [1.2, 1.22, 0.96], "*-sleeve": [1.24, 1.26, 0.96], "*-forearm": [1.14, 1.14, 0.96],
                        "neck": [1.2, 1.2, 0.86]}}}
TODDLER = {"branches": {"head": 1.85, "*-hand": 1.1}, "height": 2.35,
           "joints": {"*-thigh": [1.06, 1.06, 0.68], "*-shin": [1.06, 1.06, 0.7], "*-clavicle": [1, 0.8, 1],
                      "*-upper-arm": [1.06, 1.06, 0.8], "*-sleeve": [1.06, 1.06, 0.8], "*-forearm": [1.06, 1.06, 0.82],
                      "spine": [1.12, 1, 0.94], "chest": [1.04, 0.92, 0.88], "neck": [0.95, 0.95, 0.7]}}
CLOTHES = {"child": [0.93, 0.72, 0.22], "tall": [0.25, 0.52, 0.38], "stout": [0.30, 0.42, 0.72]}


def derived(name, source):
    shirt = soft(CLOTHES[name])
    return {"from": source, "proportions": FIGURES[name], "materials": {"shirt": shirt}}


def wave(first):
    """Arms a little off the body; from frame `first` on, the left one is raised and waves: its elbow turns about z alone,
    for between keys one that turns about two axes would leave the third."""
    still = {"left-upper-arm": [12, 0, 0], "right-upper-arm": [-12, 0, 0], "left-forearm": [0, -10, 0],
             "right-forearm": [0, -10, 0], "head": [0, 0, 0]}
    up = still | {"left-upper-arm": [145, -10, 0], "left-forearm": [0, -10, 50], "head": [0, 0, 15]}
    down = up | {"left-forearm": [0, -10, -50]}
    poses = [(0, still), (first, still), (first + 8, up), (first + 12, down), (first + 16, up), (first + 26, still)]
    return [{"frame": frame, "ease": "both", "pose": pose}
            for i, (frame, pose) in enumerate(poses) if i == 0 or frame > poses[i - 1][0]]


def bodies_film():
    models = {"man": "models/human.json", **{name: f"models/{name}.json" for name in FIGURES},
              "toddler": {"from": "models/human.json", "proportions": TODDLER,
                          "materials": {"shirt": soft([0.90, 0.45, 0.55])}}}
    row = [("tall", -3.7), ("child", -1.9), ("man", 0.0), ("toddler", 1.75), ("stout", 3.5)]
    actors = [{"name": name, "model": name, "place": [x, 0.3 * abs(x), 0.0], "turn": [0, 0, -90 - 4 * x],
               "keys": wave(8 * number)} for number, (name, x) in enumerate(row)]
    camera = {"eye": [0.0, -15.5, 3.9], "at": [0.0, 0.0, 2.7], "fov": 28.5}
    return film(72, [640, 360], camera, models, actors, lights=SUN)


if __name__ == "__main__":
    to = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    (to / "models").mkdir(exist_ok=True)
    written = {"models/human": human(METRE), "models/caterpillar": caterpillar(), "models/robot-arm": robot_arm(),
               "models/tiles": tiles(), "models/dog": dog(METRE), "models/horse": horse(METRE), "caterpillar": caterpillar_film(), "robot-arm": robot_film(),
               "demo": demo_film(), "bodies": bodies_film(),
               **{f"models/{name}": derived(name, "human.json") for name in FIGURES}}
    for name, content in written.items():
        (to / f"{name}.json").write_text(text_of(content) + "\n")
