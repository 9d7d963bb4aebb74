#!/usr/bin/env python3
"""Writes the measuring scenes s1, s1m, s2 and s3 beside itself, and s1s, s2s and s3s, in which the light casts shadows.

One white directional light, coded colours, one sample a pixel, 1920x1080, fixed dicing. A teapot's height is centred on 0.
"""
import json
import math
import pathlib

HERE = pathlib.Path(__file__).parent
PHONG = {"ambient": 0.10, "diffuse": 0.65, "specular": 0.45, "exponent": 32}
COPPER = {"color": [0.85, 0.55, 0.30], **PHONG}
NEAR = {"eye": [1.2, -7.1, 3.3], "at": [0.12, 0, -0.05], "fov": 30}
ABOVE = {"eye": [0, -71, 57], "at": [0, -4, -0.5], "fov": 31}


def teapot(material=None):
    segment = {"shape": "teapot", "lid": 1.077, "sbb": [[-3, -2, -1.575], [3.525, 2, 1.575]]}
    if material:
        segment["material"] = material
    return {"joints": [{"name": "teapot", "limits": {"z": [-360, 360]}, "segment": segment}]}


def rounded(number):
    return round(number, 12)


def degrees(radians):
    return rounded(math.degrees(radians))


def film(frames, dice, camera, materials, models, actors):
    return {"frames": frames, "rate": 24, "size": [1920, 1080], "color": "coded", "samples": 1,
            "background": [0.05, 0.06, 0.10], "dice": dice,
            "camera": camera, "lights": [{"direction": [-0.4, -0.7, 0.8]}],
            "materials": materials, "models": models, "actors": actors}


def one_teapot(dice):
    actor = {"name": "teapot", "model": "teapot", "turn": [0, 0, degrees(0.35)]}
    return film(1, dice, NEAR, {"copper": COPPER}, {"teapot": teapot("copper")}, [actor])


def hundred_teapots(frames=1):
    materials, actors = {}, []
    for j in range(10):
        for i in range(10):
            h = 0.137 * (7 * i + 13 * j) % 1
            name = f"glaze-{i}{j}"
            color = [0.4 + 0.5 * h, 0.75 - 0.4 * h, 0.35 + 0.4 * (3 * h % 1)]
            materials[name] = {"color": [rounded(c) for c in color], **PHONG}
            actors.append({"name": f"teapot-{i}{j}", "model": "teapot", "material": name,
                           "place": [rounded((i - 4.5) * 6.6), rounded((j - 4.5) * 6.6), 0],
                           "turn": [0, 0, degrees(0.63 * (3 * i + 5 * j))]})
    return film(frames, 16, ABOVE, materials, {"teapot": teapot()}, actors)


def one_turning():
    scene = hundred_teapots(30)
    scene["materials"]["copper"] = COPPER
    scene["actors"].append({"name": "turning", "model": "teapot", "material": "copper", "place": [0, -53.8, 42.6],
                            "keys": [{"frame": 0, "pose": {"teapot": [0, 0, 0]}},
                                     {"frame": 30, "pose": {"teapot": [0, 0, 360]}}]})
    return scene


def shadowed(scene):
    return {**scene, "lights": [{**light, "shadow": True} for light in scene["lights"]]}


def text_of(value, indent=0, pack=False):
    """JSON with what is short on one line; the rows of a subdivision surface, several on a line."""
    line = json.dumps(value)
    if len(line) + indent <= 108 or not isinstance(value, (dict, list)):
        return line
    pad = " " * (indent + 2)
    if isinstance(value, dict):
        items = [f"{pad}{json.dumps(k)}: {text_of(v, indent + 2, pack or k == 'subdivision')}" for k, v in value.items()]
        return "{\n" + ",\n".join(items) + "\n" + " " * indent + "}"
    items = lines_of(value, 108 - indent) if pack else [text_of(v, indent + 2) for v in value]
    return "[\n" + ",\n".join(pad + item for item in items) + "\n" + " " * indent + "]"


def lines_of(rows, width):
    lines = [json.dumps(rows[0])]
    for row in map(json.dumps, rows[1:]):
        if len(lines[-1]) + len(row) + 2 <= width:
            lines[-1] += ", " + row
        else:
            lines.append(row)
    return lines


if __name__ == "__main__":
    scenes = {"s1": one_teapot(16), "s1m": one_teapot(64), "s2": hundred_teapots(), "s3": one_turning()}
    scenes |= {f"{name}s": shadowed(scenes[name]) for name in ("s1", "s2", "s3")}
    for name, scene in scenes.items():
        (HERE / f"{name}.json").write_text(text_of(scene) + "\n")
