"""What the 1992 program does on each node (record.h), for figures of some sizes in the picture."""
import json
import subprocess

import numpy

from costs import WORKS

SCALES = [0.01, 0.014, 0.02, 0.025, 0.03, 0.035, 0.042, 0.05, 0.06, 0.07, 0.085, 0.1, 0.12, 0.145, 0.17, 0.21, 0.25, 0.3, 0.35, 0.42, 0.5, 0.6, 0.7, 0.85,
          1.0]

PARTS = ["whole", "lines", "box", "pixels"]  # of an inbetween's MFB that might be sent


class Job:
    """A keyframe, and perhaps inbetweens, by some nodes. Arrays have a row a node or inbetween, a column a kind of work;
    strips of a keyframe are given as [node, bytes] in the order of each node's."""

    def __init__(self, recorded):
        keyframes = [node[0] for node in recorded["nodes"]]
        inbetweens = sorted((frame for node in recorded["nodes"] for frame in node[1:]), key=lambda f: f["frame"])
        self.nodes = len(keyframes)
        self.values = {
            "lists": table(frame["lists"] for frame in keyframes),
            "lines": table({**frame["lines"], "depth": 0} for frame in keyframes),
            "depth": table({"depth": frame["lines"].get("depth", 0)} for frame in keyframes),
            "sent": numpy.array([frame["sent"] for frame in keyframes], float),
            "strips": numpy.array([frame["strips"] for frame in keyframes], float),
            "depths": numpy.array([frame["depths"] for frame in keyframes], float),
            "host": table(recorded["host"]),
            "inbetweens": table(frame["lines"] for frame in inbetweens),
            "moving": numpy.array([frame["strips"][0] for frame in inbetweens], float),
            **{"moving_" + part: numpy.array([frame["moving"][part] for frame in inbetweens], float) for part in PARTS},
        }

    def __getattr__(self, name):
        try:
            return self.__dict__["values"][name]
        except KeyError:
            raise AttributeError(name) from None


def table(counts):
    return numpy.array([[of.get(work, 0) for work in WORKS] for of in counts], float)


def record(program, film, nodes, inbetweens, scales=None):
    """By nodes and scale, what a film's first interval takes."""
    scales = scales or SCALES
    words = [program, "count", film, ",".join(map(str, nodes)), ",".join(map(str, scales)), str(inbetweens)]
    found = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    by_nodes = {count: {} for count in nodes}
    for one in found:
        by_nodes[int(one["count"])][one["scale"]] = Job(one)
    return by_nodes
