"""What chapter 4 of the thesis compares besides its tables: positions, distributions of patches, mappings and blocks.

Each study is a table: a title, what it shows, a header and rows."""
import json
import os
import re

import figures
import limbs
import runs
import scenes

LIMB = ("limb", None, [0, 0, 0], [[-0.12, -0.12, -1.0], [0.12, 0.12, 1.0]], "skin")
MAPPINGS = ["greedy", "optimal", "cost"]
BLOCKS = [1, 2, 4, 8, 16, 32, 64]
MARKED = {"color": [1, 0, 1], "ambient": 1, "diffuse": 0, "specular": 0}  # a moving segment in a film of masks


def save(film, folder, name):
    path = os.path.join(folder, name + ".json")
    with open(path, "w") as file:
        file.write(json.dumps(film))
    return path


def total(frame, key):
    return sum(node["work"][key] for node in frame["nodes"])


def alone(model, roll=0):
    """A film of one figure, to be drawn from scratch frame by frame."""
    bounds = scenes.corners([[-1.1, -0.3, -1.1], [1.1, 0.3, 1.1]], [0, 0, 0])
    return scenes.film(scenes.Cut(), {"figure": model}, [{"name": "figure", "model": "figure", "turn": [0, roll, 0]}],
                       bounds, 1)


def dealt(items, nodes):
    """Their order in which node i's items i, i + nodes, ... are the i-th stretch of `items`."""
    shares = [len(range(node, len(items), nodes)) for node in range(nodes)]
    tiles, first = [], 0
    for share in shares:
        tiles.append(items[first:first + share])
        first += share
    return [tiles[k % nodes][k // nodes] for k in range(len(items))]


class Study:
    """Renders on `machine`, with films and pictures in `folder`."""

    def __init__(self, machine, folder, rounds):
        self.machine, self.folder, self.rounds = machine, folder, rounds

    def repeated(self, film, nodes, *options):
        """The frames of several runs, one after another, without their beginnings."""
        rounds = [self.machine.render(film, nodes, *options) for _ in range(self.rounds)]
        return [frame for frames in rounds for frame in frames[runs.SKIPPED:]]

    def positioning(self, nodes):
        """Figure 4.11."""
        model = {"shapes": {"limb": limbs.mesh(scenes.SEGMENT)}, "joints": [figures.joint(*LIMB, "limb")]}
        rows = []
        for name, roll in (("vertical", 0), ("horizontal", 90)):
            film = save(alone(model, roll), self.folder, "4.11-" + name)
            for count in nodes:
                frames = self.repeated(film, count, *runs.SCRATCH)
                rows.append([name, count, frames[-1]["edge_box_total"], total(frames[-1], "pixels"),
                             runs.busy_of_keyframe(frames)])
        return {"title": "Figure 4.11: one limb of 1300 polygons, vertical and horizontal",
                "note": "All rows draw the same limb. In the horizontal rows it is turned by 90 degrees in the "
                        "picture's plane.",
                "header": ["limb", "nodes", "edge boxes", "pixels", "own work, ms"], "rows": rows}

    def distribution(self, nodes):
        """Figure 4.4: patches scattered, and in tiles."""
        patches = figures.standing_patches(figures.MAN, figures.MAN_POSE)
        rows = []
        for count in (n for n in nodes if n > 1):
            for name, order in (("scattered", patches), ("tiled", dealt(patches, count))):
                film = save(alone(figures.as_one_segment(order)), self.folder, f"4.4-{name}-{count}")
                frames = self.repeated(film, count, *runs.SCRATCH)
                times = runs.least_by_node(frames, ["dice"])
                rows.append([count, name, runs.load_ratio(frames[-1], lambda node: node["work"]["edge_boxes_diced"]),
                             max(times) * len(times) / sum(times), max(times)])
        return {"title": "Figure 4.4: patches scattered and in tiles",
                "note": "The film draws the 208 patches of table 4.2's man as one segment. Node i gets the patches i, "
                        "i + P, i + 2P, ... Scattered: the patches are in their order along the body. Tiled: they are "
                        "in an order that gives each node neighbouring patches. Load ratio: the busiest node's number "
                        "of edge boxes, or time to make them, divided by the average of the nodes.",
                "header": ["nodes", "patches", "load ratio, edge boxes", "load ratio, time", "slowest node, ms"],
                "rows": rows}

    def mappings(self, nodes, films):
        """Figure 4.7's heuristic beside the exact mappings."""
        rows = []
        for film in films:
            for count in (n for n in nodes if n > 1):
                for mapping in MAPPINGS:
                    path = os.path.join(self.folder, film + ".json")
                    frames = self.repeated(path, count, "--mapping", mapping, *runs.SCRATCH)
                    times = runs.least_by_node(frames, ["fill", "scanline"])
                    rows.append([film, count, mapping,
                                 runs.load_ratio(frames[-1], lambda node: node["work"]["edge_boxes"]),
                                 max(times) * len(times) / sum(times), runs.busy_of_keyframe(frames)])
        return {"title": "Mapping of scanlines: the thesis's heuristic and the exact ones",
                "note": "greedy is the heuristic of figure 4.7. optimal has the least possible load ratio in edge "
                        "boxes. cost is MARS's default, which counts pixels, too. Load ratio: the busiest node's "
                        "number of edge boxes, or time, divided by the average of the nodes.",
                "header": ["film", "nodes", "mapping", "load ratio, edge boxes", "load ratio, time", "own work, ms"],
                "rows": rows}

    def masks(self, film_path, frames):
        """Pictures of the film's frames in which moving segments have a colour of their own."""
        with open(film_path) as file:
            film = json.load(file)
        moving = {joint for actor in film["actors"] for key in actor.get("keys", []) for joint in key["pose"]}
        film["materials"]["moving"] = MARKED
        for model in film["models"].values():
            for joint in model["joints"]:
                if joint["name"] in moving:
                    joint["segment"]["material"] = "moving"
        name = "masks-" + os.path.basename(film_path).removesuffix(".json")
        path, out = save(film, self.folder, name), os.path.join(self.folder, name)
        runs.run([self.machine.mars, "render", path, "--backend", "threads", "--nodes", "1", "--quiet", "-o", out,
                  "--frames", f"0-{frames - 1}"])
        return [os.path.join(out, name) for name in sorted(os.listdir(out)) if re.fullmatch(r"frame-\d+\.png", name)]

    def blocks(self, program, films):
        """Thesis 4.10: how large the blocks of the host's flags should be."""
        rows = []
        for film in films:
            pictures = self.masks(os.path.join(self.folder, film + ".json"), 33)
            for line in runs.run([program, *map(str, BLOCKS), "--", *pictures]).splitlines():
                side, *measured = line.split()
                rows.append([film, int(side), *map(float, measured)])
        return {"title": "Blocks of the host's flags",
                "note": "The average costs of an inbetween on the host. Flags: the host sets and checks the flags. "
                        "All: it also pastes the moving pixels, and restores those flagged blocks that the moving "
                        "pixels do not fill again.",
                "header": ["film", "block side", "blocks flagged", "pixels restored", "flags, µs", "all, µs"],
                "rows": rows}
