"""Films rendered here, and what the reports say of their frames."""
import json
import os
import statistics
import subprocess

from cells import Trouble

ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
WORK = ["dice", "map", "fill", "scanline"]  # phases in which a node waits for nobody
WARM_UP = 1  # intervals at a run's beginning that do not count
SKIPPED = 2  # frames at a run's beginning that do not count where all are drawn from scratch
SCRATCH = ["--no-coherence", "--frames", "0-59"]


def run(words, **options):
    """The program's standard output."""
    done = subprocess.run(words, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise Trouble(done.stderr.strip())
    return done.stdout


class Machine:
    """Renders films with this build. `folder`: for its reports."""

    def __init__(self, build, backend, folder):
        self.mars = os.path.join(build, "bin", "mars")
        self.backend, self.folder = backend, folder

    def render(self, film, nodes, *options):
        """The report's frames."""
        report = os.path.join(self.folder, "report.json")
        words = [self.mars, "render", film, "--backend", self.backend, "--nodes", str(nodes), "--groups", "1",
                 "--sink", "none", "--quiet", "--report", report, *options]
        run(words, env={**os.environ, **ROOT})
        with open(report) as file:
            return json.load(file)["frames"]


def keyframes(frames):
    return [frame for frame in frames if frame["kind"] == "keyframe" and frame["interval"] >= WARM_UP]


def inbetweens(frames):
    return [frame for frame in frames if frame["kind"] == "inbetween" and frame["interval"] >= WARM_UP]


def wall_from_scratch(frames):
    """Milliseconds a frame of a run without coherence: the time between the arrivals of its first and its last frame at
    the host, shared out. Keyframes among inbetweens have no such time, for nodes that are done with theirs begin one
    while others still draw."""
    arrivals = sorted(frame["seconds"] for frame in frames)[SKIPPED:]
    return 1000 * (arrivals[-1] - arrivals[0]) / (len(arrivals) - 1)


def wall_of_inbetweens(frames):
    """Milliseconds a frame: in each interval from the keyframe's arrival at the host to the last inbetween's, all added
    up and shared out."""
    begins = {frame["interval"]: frame["seconds"] for frame in keyframes(frames)}
    ends = dict.fromkeys(begins, 0)
    for frame in inbetweens(frames):
        ends[frame["interval"]] = max(ends[frame["interval"]], frame["seconds"])
    return 1000 * sum(ends[interval] - begins[interval] for interval in begins) / len(inbetweens(frames))


def working(node, phases):
    return sum(node["seconds"][phase] for phase in phases)


def least_by_node(frames, phases):
    """Milliseconds of each node in these phases, its least of all frames: the system may have stopped it in others."""
    least = {}
    for frame in frames:
        for node in frame["nodes"]:
            least[node["node"]] = min(least.get(node["node"], 1e9), 1000 * working(node, phases))
    return list(least.values())


def busy_of_keyframe(own):
    """Milliseconds of `own` keyframes if each node had a core to itself and messages took no time: the slowest node's
    making of triangles, then the slowest one's scanlines."""
    return max(least_by_node(own, ["dice"])) + max(least_by_node(own, ["map", "fill", "scanline"]))


def busy_of_inbetweens(frames, nodes):
    """Milliseconds a frame if each node had a core to itself."""
    return statistics.median(1000 * working(frame["nodes"][0], WORK) for frame in inbetweens(frames)) / nodes


def load_ratio(frame, count):
    """Greatest over average of `count`(node) over the nodes."""
    loads = [count(node) for node in frame["nodes"]]
    return max(loads) * len(loads) / sum(loads)
