#!/usr/bin/env python3
"""Writes zone-plate.json and fan.json, films that show whether edges crawl: circles that are ever closer to each other
and drift, and thin blades that turn, both by a fraction of a pixel a frame.

With an argument: into that folder instead of its own.
"""
import math
import pathlib
import sys

from make_scenes import HERE, degrees, rounded, text_of

PAPER, INK = [0.9, 0.9, 0.9], [0.05, 0.05, 0.05]
DISTANCE = 20.0
HALF_HEIGHT = 1.08  # of the picture, where the patterns have a radius of 1
PIXEL = 2 * HALF_HEIGHT / 540


def plain(color):
    """Shows its colour under any light."""
    return {"color": color, "ambient": 1, "diffuse": 0, "specular": 0}


def film(frames, shape, joints, keys):
    fov = degrees(2 * math.atan(HALF_HEIGHT / DISTANCE))
    return {"frames": frames, "rate": 24, "size": [960, 540], "curve": "none", "background": INK,
            "camera": {"eye": [0, -DISTANCE, 0], "at": [0, 0, 0], "fov": fov},
            "lights": [{"direction": [0, -1, 0]}], "materials": {"paper": plain(PAPER), "ink": plain(INK)},
            "models": {"pattern": {"shapes": shape, "joints": joints}},
            "actors": [{"name": "pattern", "model": "pattern", "keys": keys}]}


def flat_mesh(points, faces):
    """In the middle of the unit cube, seen from -y; points are (x, z) from -1 to 1."""
    return {"mesh": {"vertices": [[round(x / 2 + 0.5, 6), 0.5, round(z / 2 + 0.5, 6)] for x, z in points], "faces": faces}}


def around(turns, radius=1.0):
    return radius * math.cos(2 * math.pi * turns), radius * math.sin(2 * math.pi * turns)


def box(radius, y):
    return [[-radius, rounded(y - 0.0001), -radius], [radius, rounded(y + 0.0001), radius]]


def zone_plate(zones=80, corners=256, frames=48):
    """Circle k has the radius sqrt(k / zones); each lies before the next larger one. All rings have the same area."""
    circle = flat_mesh([around(k / corners) for k in range(corners)], [list(range(corners))])
    joints = [{"name": "paper", "segment": {"shape": "circle", "sbb": box(1, 0.001 * zones), "material": "paper"}}]
    for k in range(zones - 1, 0, -1):
        radius, material = round(math.sqrt(k / zones), 6), "ink" if (zones - k) % 2 else "paper"
        joints.append({"name": f"ring-{k}", "parent": "paper",
                       "segment": {"shape": "circle", "sbb": box(radius, 0.001 * k), "material": material}})
    drift = [rounded(0.25 * frames * PIXEL), 0, rounded(0.1 * frames * PIXEL)]
    keys = [{"frame": 0, "place": [0, 0, 0], "ease": "linear"}, {"frame": frames, "place": drift}]
    return film(frames, {"circle": circle}, joints, keys)


def fan(blades=48, inner=0.12, width=1.5 * PIXEL, frames=75):
    """Blades as wide outside as inside. In all its frames it turns from one blade to the next."""
    points, faces = [], []
    for k in range(blades):
        along, across = around(k / blades), around(k / blades + 0.25, width / 2)
        for radius, side in (inner, -1), (0.99, -1), (0.99, 1), (inner, 1):
            points.append(tuple(radius * a + side * b for a, b in zip(along, across)))
        faces.append([4 * k + corner for corner in range(4)])
    joints = [{"name": "blades", "segment": {"shape": "blades", "sbb": box(1, 0), "material": "paper"}}]
    keys = [{"frame": 0, "turn": [0, 0, 0], "ease": "linear"}, {"frame": frames, "turn": [0, rounded(360 / blades), 0]}]
    return film(frames, {"blades": flat_mesh(points, faces)}, joints, keys)


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    for name, scene in {"zone-plate": zone_plate(), "fan": fan()}.items():
        (folder / f"{name}.json").write_text(text_of(scene) + "\n")
