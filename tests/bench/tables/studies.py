"""What chapter 4 of the thesis compares besides its tables: positions, distributions of patches, mappings and blocks.

Each study is a table: a title, what it shows, a header and rows."""
import json
import os
import re
import subprocess

import cells
import figures
import limbs
import runs
import scenes

ROUNDS = 3
LIMB = ("limb", None, [0, 0, 0], [[-0.12, -0.12, -1.0], [0.12, 0.12, 1.0]], "skin")
MAPPINGS = ["greedy", "optimal", "cost"]
BLOCKS = [1, 2, 4, 8, 16, 32, 64]
MARKED = {"color": [1, 0, 1], "ambient": 1, "diffuse": 0, "specular": 0}  # a moving segment in a film of masks


def save(film, folder, name):
    path = os.path.join(folder, name + ".json")
    with open(path, "w") as file:
        file.write(json.dumps(film))
    return path


def repeated(machine, film, nodes, *options):
    """The frames of several runs, one after another."""
    return [frame for _ in range(ROUNDS) for frame in machine.render(film, nodes, *options)]


def total(frame, key):
    return sum(node["work"][key] for node in frame["nodes"])


def alone(model, cut, roll=0):
    """A film of one figure that stands still in all but its camera's field of view, so that every frame is drawn."""
    bounds = scenes.corners([[-1.1, -0.3, -1.1], [1.1, 0.3, 1.1]], [0, 0, 0])
    return scenes.film(cut, {"figure": model}, [{"name": "figure", "model": "figure", "turn": [0, roll, 0]}], bounds, 1)


def positioning(machine, folder, nodes):
    """Figure 4.11."""
    model = {"shapes": {"limb": limbs.mesh(scenes.SEGMENT)}, "joints": [figures.joint(*LIMB, "limb")]}
    rows = []
    for name, roll in (("vertical", 0), ("horizontal", 90)):
        film = save(alone(model, scenes.Cut(1, 29), roll), folder, "4.11-" + name)
        for count in nodes:
            frames = [{**frame, "kind": "keyframe", "interval": runs.WARM_UP}
                      for frame in repeated(machine, film, count, "--no-coherence")]
            walls = runs.wall_of_keyframes(frames)
            rows.append([name, count, frames[-1]["edge_box_total"], total(frames[-1], "pixels"),
                         min(walls), runs.busy_of_keyframe(frames)])
    return {"title": "Figure 4.11: one limb of 1300 polygons, vertical and horizontal",
            "note": "The same limb, turned by 90 degrees in the picture's plane.",
            "header": ["limb", "nodes", "edge boxes", "pixels", "keyframe, best ms", "own work, ms"], "rows": rows}


def dealt(items, nodes):
    """Their order in which node i's items i, i + nodes, ... are the i-th stretch of `items`."""
    shares = [len(range(node, len(items), nodes)) for node in range(nodes)]
    tiles, first = [], 0
    for share in shares:
        tiles.append(items[first:first + share])
        first += share
    return [tiles[k % nodes][k // nodes] for k in range(len(items))]


def distribution(machine, folder, nodes):
    """Figure 4.4: patches scattered, and in tiles."""
    patches = figures.standing_patches(figures.MAN, figures.MAN_POSE)
    rows = []
    for count in (n for n in nodes if n > 1):
        for name, order in (("scattered", patches), ("tiled", dealt(patches, count))):
            film = save(alone(figures.as_one_segment(order), scenes.Cut(1, 29)), folder, f"4.4-{name}-{count}")
            frames = [{**frame, "kind": "keyframe", "interval": runs.WARM_UP}
                      for frame in repeated(machine, film, count, "--no-coherence")]
            times = runs.least_by_node(frames, ["dice"])
            rows.append([count, name, runs.load_ratio(frames[-1], lambda node: node["work"]["edge_boxes_diced"]),
                         max(times) * len(times) / sum(times), max(times)])
    return {"title": "Figure 4.4: patches scattered and in tiles",
            "note": "208 patches of the man of table 4.2, as one segment whose patches stand in another order. MARS gives "
                    "node i the patches i, i + P, ...; in tiles node i has neighbours. Load ratio: greatest over "
                    "average of the nodes, in edge boxes made and in the time of making them.",
            "header": ["nodes", "patches", "load ratio, edge boxes", "load ratio, time", "slowest node, ms"],
            "rows": rows}


def mappings(machine, folder, nodes, films):
    """Figure 4.7's heuristic beside the exact mappings."""
    rows = []
    for film in films:
        for count in (n for n in nodes if n > 1):
            for mapping in MAPPINGS:
                frames = repeated(machine, os.path.join(folder, film + ".json"), count, "--mapping", mapping)
                times = runs.least_by_node(runs.keyframes(frames), ["fill", "scanline"])
                rows.append([film, count, mapping,
                             runs.load_ratio(runs.keyframes(frames)[-1], lambda node: node["work"]["edge_boxes"]),
                             max(times) * len(times) / sum(times), runs.busy_of_keyframe(frames)])
    return {"title": "Mapping of scanlines: the thesis's heuristic and the exact ones",
            "note": "greedy is figure 4.7's; optimal has the least possible load ratio in edge boxes; cost, MARS's own "
                    "choice, weighs pixels too. Keyframes; load ratio: greatest over average of the nodes.",
            "header": ["film", "nodes", "mapping", "load ratio, edge boxes", "load ratio, time", "own work, ms"],
            "rows": rows}


def masks(machine, folder, film_path, frames):
    """Pictures of the film's frames in which moving segments have a colour of their own."""
    with open(film_path) as file:
        film = json.load(file)
    moving = {joint for actor in film["actors"] for key in actor.get("keys", []) for joint in key["pose"]}
    film["materials"]["moving"] = MARKED
    for model in film["models"].values():
        for joint in model["joints"]:
            if joint["name"] in moving:
                joint["segment"]["material"] = "moving"
    out = os.path.join(folder, "masks")
    path = save(film, folder, "masks")
    done = subprocess.run([machine.mars, "render", path, "--backend", "threads", "--nodes", "1", "--quiet", "-o", out,
                           "--frames", f"0-{frames - 1}"], capture_output=True, text=True)
    if done.returncode != 0:
        raise cells.Trouble(done.stderr.strip())
    return [os.path.join(out, name) for name in sorted(os.listdir(out)) if re.fullmatch(r"frame-\d+\.png", name)]


def blocks(machine, folder, program, films):
    """Thesis 4.10: how large the blocks of the host's flags should be."""
    rows = []
    for film in films:
        pictures = masks(machine, folder, os.path.join(folder, film + ".json"), 33)
        done = subprocess.run([program, *map(str, BLOCKS), "--", *pictures], capture_output=True, text=True)
        if done.returncode != 0:
            raise cells.Trouble(done.stderr.strip())
        for line in done.stdout.splitlines():
            side, *measured = line.split()
            rows.append([film, int(side), *map(float, measured)])
    return {"title": "Blocks of the host's flags",
            "note": "An inbetween on the host, on average: setting and checking flags, and all of it: pasting the moving "
                    "pixels, and restoring the flagged blocks that they do not fill again.",
            "header": ["film", "block side", "blocks flagged", "pixels restored", "flags, µs", "all, µs"],
            "rows": rows}
