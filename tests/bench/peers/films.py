"""The measuring scenes as films for one competition: culled, and with frames enough."""
import copy
import json
import math
import os

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "examples")
STEP = 12         # degrees that s3's teapot turns in a frame
INTERVAL = 120    # frames of s3 from one keyframe to the next: whole turns
FILM = 30         # frames of s3 as it is: one turn
SHADOWED = {"s1s": "s1", "s2s": "s2", "s3s": "s3"}  # scenes whose light casts shadows, and what they are otherwise


def load(name, size=None, dice=None, samples=1, sun=0):
    """An example as it is, but seen from outside only, with `samples` samples a pixel, and in the size and as finely
    diced as wanted. `sun`: the size of a light that casts, the tangent of half the angle that it takes up."""
    with open(os.path.join(EXAMPLES, SHADOWED.get(name, name) + ".json")) as file:
        film = json.load(file)
    if name in SHADOWED:
        film["lights"][0].update({"shadow": True, "size": math.degrees(2 * math.atan(sun))} if sun else {"shadow": True})
    for material in film["materials"].values():
        material["sides"] = 1
    film["samples"] = samples
    if size:
        film["size"] = size
    if dice:
        film["dice"] = dice
    return film


def turning(film):
    """The joint keys that must be stretched with the film; none in scenes that stand still."""
    return [actor for actor in film["actors"] if "keys" in actor]


def without_shadows(film):
    lights = [{key: value for key, value in light.items() if key not in ("shadow", "size")} for light in film["lights"]]
    return {**film, "lights": lights}


def lengthened(film, frames, interval=INTERVAL):
    """The same film with `frames` frames, cut at every `interval` where something turns."""
    film = copy.deepcopy(film)
    film["frames"] = frames
    for actor in turning(film):
        keys = range(0, frames + interval, interval)
        actor["keys"] = [{"frame": k, "pose": {actor["model"]: [0, 0, STEP * k]}} for k in keys]
        film["models"][actor["model"]]["joints"][0]["limits"] = {"z": [0, STEP * keys[-1]]}
        film["intervals"] = "keyframes"
    return film


def save(film, path):
    with open(path, "w") as file:
        json.dump(film, file)
    return path
