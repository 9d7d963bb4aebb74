"""What a studio tells of a model and of a film, made from a man each of whose joints has a rigid segment."""

import json
import pathlib

SOURCES = pathlib.Path(__file__).resolve().parents[4]
MAN = SOURCES / "tests/host/studio/page/jointed_man.json"
AXES = "xyz"
FREE = {axis: [-180, 180] for axis in AXES}
SHAPES = [
    {"name": "box", "options": []},
    {"name": "ellipsoid", "options": []},
    {"name": "capsule", "options": [{"key": "ends", "what": "height of each end / height of the sbb", "count": 1, "default": 0.25,
                                     "range": [0.001, 0.5]}]},
    {"name": "rounded_box", "options": [{"key": "edge", "what": "radius / size of the sbb", "count": 3, "default": 0.1,
                                         "range": [0.001, 0.5]}]},
    *({"name": name, "options": []} for name in ("head", "neck", "torso", "abdomen", "pelvis", "thigh", "shin", "foot")),
]


def joints(keyed=()):
    model = json.loads(MAN.read_text())
    names = {joint: limb for limb, joint in model["limbs"].items() if isinstance(joint, str)}
    for side in ("left", "right"):
        names |= {joint: f"{side}.{limb}" for limb, joint in model["limbs"][side].items()}
    return [described(joint, names, joint["name"] in keyed) for joint in model["joints"]]


def described(joint, limbs, keyed):
    limits = joint.get("limits", FREE)
    segment = joint.get("segment", {})
    known = {"name", "parent", "place", "x_axis", "y_axis", "limits", "segment"}
    assert set(joint) <= known, joint
    return {
        "name": joint["name"], "parent": joint.get("parent"), "place": joint.get("place", [0, 0, 0]),
        "x_axis": joint.get("x_axis", [1, 0, 0]), "y_axis": joint.get("y_axis", [0, 1, 0]),
        "limits": [limits.get(axis, [0, 0]) for axis in AXES], "free": [axis for axis in AXES if axis in limits],
        "pose": [0, 0, 0], "keyed": keyed, "shape": segment.get("shape"),
        "options": {key: value for key, value in segment.items() if key not in ("shape", "sbb", "material")},
        "sbb": segment.get("sbb", [[0, 0, 0], [1, 1, 1]]) if segment else None, "material": segment.get("material"),
        "limb": limbs.get(joint["name"]),
    }


def materials():
    return [{"name": name, **material} for name, material in json.loads(MAN.read_text())["materials"].items()]


def key(schema):
    bounds = {ours: schema[theirs] for ours, theirs in (("least", "minimum"), ("most", "maximum")) if theirs in schema}
    choices = {"choices": schema["enum"]} if "enum" in schema else {}
    plain = {"integer": "whole", "boolean": "flag"}.get(schema.get("type"), schema.get("type"))
    return bounds | choices | {"type": schema["$ref"].split("/")[-1] if "$ref" in schema else plain, "meaning": schema["description"]} | {
        name: schema[name] for name in ("default",) if name in schema}


# What schemas do not say, and keys that they do not have.
OF = {"direction": ["directional"], "place": ["point", "spot"], "at": ["spot"], "cone": ["spot"], "reach": ["point", "spot"],
      "softness": ["spot"]}
NOT_TYPED = {"film": ["version", "fog", "camera", "lights", "materials", "models", "actors"]}
PLANTED = {"light": {"softness": {"type": "number", "meaning": "how soft its edge is", "least": 0, "most": 1, "default": 0.5, "keyed": True}},
           "film": {"grain": {"type": "number", "meaning": "noise of the picture", "least": 0, "most": 1, "default": 0, "rare": True}}}


def keys():
    """As the studio makes them of the table of keys: by the schemas, which come from it too; and keys that are planted."""
    schema = json.loads((SOURCES / "docs/schema/film.schema.json").read_text())
    known = {"film": schema, "camera": schema["$defs"]["camera"], "light": schema["$defs"]["light"], "material": schema["$defs"]["film_material"]}
    keys = {thing: {name: key(each) for name, each in of["properties"].items() if name not in NOT_TYPED.get(thing, ["keys"])}
            for thing, of in known.items()}
    for thing in ("camera", "light"):
        for name in keys[thing]:
            if name in schema["$defs"][f"{thing}_key"]["properties"]:
                keys[thing][name]["keyed"] = True
    for thing, planted in PLANTED.items():
        keys[thing] |= planted
    for name, kinds in OF.items():
        keys["light"][name]["of"] = kinds
    keys["light"]["size"]["measures"] = {"directional": {"least": 0, "most": 90, "unit": "degrees"}}
    keys["light"]["reach"]["without"] = "the same at all distances"
    keys["light"]["cone"]["parts"], keys["film"]["size"]["parts"] = ["inner", "outer"], ["width", "height"]
    keys["film"]["samples"]["choices"] = schema["$defs"]["samples"]["enum"]
    keys["camera"]["near"]["rare"] = True
    keys["kinds"] = {"light": [{"name": name, "label": label, "begins_with": words} for name, label, words in
                               (("directional", "Sun", ["direction=1,-1,2"]), ("point", "Bulb", ["place=0,-3,4"]),
                                ("spot", "Spot", ["place=0,-4,5", "at=0,0,1"]))]}
    for name in ("ambient", "diffuse", "specular", "exponent"):
        keys["material"][name] |= {"slider": [0, 2], "of": ["phong", "blinn-phong"]}
    return keys


def limbs():
    sides = ("hip", "knee", "ankle", "toes", "shoulder", "elbow", "wrist")
    return ["pelvis", "spine", "chest", "neck", "head", *(f"{side}.{limb}" for side in ("left", "right") for limb in sides)]


def model():
    return {
        "kind": "model", "file": "examples/models/human.json", "frames": 1, "rate": 24, "frame": 0, "size": [960, 540],
        "actors": [{"name": "model", "model": "model", "place": [0, 0, 0], "turn": [0, 0, 0], "joints": joints()}],
        "materials": materials(), "keys": keys(), "shapes": SHAPES, "bodies": [{"name": name, "what": f"a {name} body"} for name in ("tall", "child", "stout")], "limbs": limbs(),
        "undo": None, "redo": None, "problem": None,
    }


def film():
    actors = [{"name": name, "model": "human", "place": [x, 0, 0], "turn": [0, 0, 0],
               "joints": joints(keyed=("left-thigh", "right-thigh", "head"))} for name, x in (("walker", 0), ("watcher", 2))]
    return {key: value for key, value in model().items() if key not in ("shapes", "bodies", "limbs")} | {"kind": "film", "file": "examples/demo.json", "frames": 120, "frame": 24, "actors": actors,
                      "materials": [{"name": each["name"], "color": each["color"]} for each in materials()],
                      "camera": {"eye": [6, -4, 3], "at": [0, 0, 2], "up": [0, 0, 1], "fov": 40, "exposure": 0, "near": 0.1, "far": 10000, "keyed": [], "animated": ["exposure", "fov"]},
                      "lights": [{"thing": "light/1", "kind": "directional", "direction": [0, 0, 1], "color": [1, 1, 1], "intensity": 1, "keyed": [], "animated": []},
                                 {"thing": "light/2", "kind": "spot", "place": [0, -4, 5], "at": [0, 0, 1], "cone": [32, 40], "softness": 0.25,
                                  "color": [1, 1, 1], "intensity": 1, "keyed": [], "animated": ["reach"]}],
                      "settings": {"frames": 120, "rate": 24, "size": [960, 540], "samples": 4, "color": "linear", "curve": "filmic",
                                   "background": [0, 0, 0], "ambient": {"sky": [1, 1, 1], "ground": [0.7, 0.7, 0.6]}, "intervals": "auto",
                                   "dice": "adaptive", "grain": 0}}
