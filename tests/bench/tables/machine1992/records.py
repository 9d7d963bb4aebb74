"""What the 1992 program does on each node (record.h), for figures of any size in the picture: recorded at some scales,
and interpolated between them."""
import bisect
import json
import math
import subprocess

import numpy

from costs import WORKS

SCALES = [0.035, 0.055, 0.08, 0.12, 0.17, 0.25, 0.35, 0.5, 0.7, 1.0]

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


def between(a, b, part):
    """The job `part` of the way from one to the other."""
    job = object.__new__(Job)
    job.nodes = a.nodes
    job.values = {name: (1 - part) * value + part * b.values[name] for name, value in a.values.items()}
    return job


class Scaled:
    """A film's jobs on some nodes by the scale of its figures."""

    def __init__(self, jobs):
        self.scales = sorted(jobs)
        self.jobs = [jobs[scale] for scale in self.scales]

    def at(self, scale):
        scale = min(max(scale, self.scales[0]), self.scales[-1])
        upper = min(max(bisect.bisect_left(self.scales, scale), 1), len(self.scales) - 1)
        low, high = self.scales[upper - 1:upper + 1]
        return between(self.jobs[upper - 1], self.jobs[upper], math.log(scale / low) / math.log(high / low))


def record(program, film, nodes, inbetweens, scales=None):
    """By nodes, what a film's first interval takes."""
    scales = scales or SCALES
    words = [program, "count", film, ",".join(map(str, nodes)), ",".join(map(str, scales)), str(inbetweens)]
    found = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    by_nodes = {count: {} for count in nodes}
    for one in found:
        by_nodes[int(one["count"])][one["scale"]] = Job(one)
    return {count: Scaled(jobs) for count, jobs in by_nodes.items()}
