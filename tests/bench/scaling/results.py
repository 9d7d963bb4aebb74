"""What the runs of studies say: points (one configuration's runs), lines (a series over its numbers of nodes) with their
laws, and findings in words."""
from functools import cached_property

import numpy

import fits
import machines
import study
from runs import KINDS, PHASES, seconds_of

WAITS = ("sum", "exchange", "depth", "credit", "host")  # steps in which a node waits for others
STEPS = (*PHASES, "host")
NOISY = 0.1  # of the median, between the quartiles


def steps_of(run):
    """Seconds of a run by step, of the mean node; "host" is the rest of the film's time, in which a node has nothing to
    do: the host has not given it a task yet, or composes the last frames."""
    nodes = run["per_node"]
    steps = {phase: sum(seconds_of(node[kind], phase) for node in nodes for kind in KINDS) / len(nodes) for phase in PHASES}
    return {**steps, "host": max(0.0, run["seconds"] - sum(steps.values()))}


def computing(run):
    """Seconds that each node computes."""
    return [sum(seconds_of(node[kind], phase) for kind in KINDS for phase in PHASES if phase not in WAITS)
            for node in run["per_node"]]


def computing_on(run, host):
    """Seconds that the machine's nodes compute together."""
    return sum(seconds for node, seconds in zip(run["per_node"], computing(run)) if node["host"] == host)


class Point:
    """One configuration: its runs that count."""

    def __init__(self, runs):
        self.runs, self.nodes = runs, runs[0]["nodes"]
        self.seconds = [run["seconds"] for run in runs]
        self.time = fits.spread(self.seconds)
        self.frames = sum(runs[0]["frames"].values())
        self.pixels = runs[0]["size"][0] * runs[0]["size"][1]
        self.oversubscribed = self.nodes > runs[0]["environment"]["processors"]

    def middle(self, of_run):
        return float(numpy.median([of_run(run) for run in self.runs]))

    @cached_property
    def steps(self):
        return {step: self.middle(lambda run: steps_of(run)[step]) for step in STEPS}

    @property
    def load_ratio(self):
        """Of the nodes' computing as measured: the greatest over the mean."""
        return self.middle(lambda run: max(computing(run)) / numpy.mean(computing(run)))

    def bytes(self, to):
        """Of all nodes in the whole film."""
        return self.middle(lambda run: sum(node[kind]["work"].get(f"bytes_to_{to}", 0) for node in run["per_node"]
                                           for kind in KINDS))

    def frame_seconds(self, kind):
        """Of a node for one frame, of the last node in a keyframe; None where the film has none."""
        return self.middle(lambda run: run["frame_seconds"][kind]) if self.runs[0]["frames"][kind] else None


class Line:
    """One series over its numbers of nodes."""

    def __init__(self, series, points, varied=study.AXES):
        self.series, self.kind = series, series.kind
        self.title, self.choice = series.title(varied), series.choice(varied)
        self.points = sorted(points, key=lambda point: point.nodes)
        self.nodes = [point.nodes for point in self.points]

    def speed_ups(self, of_point):
        """By nodes; of a weak study scaled: as many times the work in how many times the time."""
        return fits.speed_up({point.nodes: of_point(point) / self.work(point) for point in self.points}, self.nodes)

    def work(self, point):
        """Of the point in that of the first: pixels where pictures grow, nodes where a film is given for each."""
        first = self.points[0]
        if self.kind == "strong":
            return 1.0
        own_films = len({each.runs[0]["film"] for each in self.points}) > 1
        return point.nodes / first.nodes if own_films else point.pixels / first.pixels

    @cached_property
    def middle(self):
        return self.speed_ups(lambda point: point.time.median)

    @cached_property
    def best(self):
        return self.speed_ups(lambda point: point.time.best)

    def efficiency(self, point):
        return self.middle[point.nodes] / point.nodes

    def serial_fraction_at(self, point):
        """Karp and Flatt's; of a weak study Gustafson's. None where the study has no single node to compare with."""
        law = fits.karp_flatt if self.kind == "strong" else fits.gustafson
        return law(self.middle[point.nodes], point.nodes) if self.nodes[0] == 1 else None

    @cached_property
    def fitted(self):
        """Points that Amdahl's law may be fitted to: those whose nodes have a processor each."""
        return [point for point in self.points if not point.oversubscribed]

    @cached_property
    def amdahl(self):
        """(serial fraction, its bounds at 95 %, seconds of one node) of a strong study; None of fewer than two points."""
        if self.kind != "strong" or len(self.fitted) < 2:
            return None
        fit = lambda groups: fits.amdahl([(point.nodes, float(numpy.median(group)))
                                          for point, group in zip(self.fitted, groups)])
        measured = [point.seconds for point in self.fitted]
        fraction, one = fit(measured)
        return fraction, fits.bootstrapped(lambda groups: fit(groups)[0], measured), one


class Results:
    """Of the files of one or several studies: (header, runs) each."""

    def __init__(self, files):
        self.headers = [header for header, _ in files]
        every = [{**run, "block": (number, run["repeat"])} for number, (_, runs) in enumerate(files) for run in runs]
        self.failures = [run for run in every if "failure" in run]
        self.runs = [run for run in every if "failure" not in run and run["repeat"] > 0]
        if not self.runs:
            raise study.Trouble("no run succeeded" + "".join(f"\n{run['failure']}" for run in self.failures[:1]))
        self.environments = list({str(run["environment"]): run["environment"] for run in every}.values())
        self.before = every[0]["load_average"]
        self.varied = [axis for axis in (*study.AXES, "program")
                       if len({run["series"]["settings"].get(axis) for run in self.runs}) > 1]
        self.lines = [self.line(series) for series in sorted(set(map(series_of, self.runs)))]

    def line(self, series):
        own = [run for run in self.runs if series_of(run) == series]
        points = [Point([run for run in own if run["nodes"] == nodes]) for nodes in {run["nodes"] for run in own}]
        return Line(series, points, self.varied)

    @property
    def compares(self):
        """Whether programs took turns."""
        return "program" in self.varied

    @cached_property
    def hosts(self):
        return sorted({node["host"] for run in self.runs for node in run["per_node"]})

    @cached_property
    def slow(self):
        """Machines; nodes where there is one machine with enough processors for what ran."""
        if len(self.hosts) > 1:
            return machines.slow_ones(self.runs)
        return machines.slow_ones([run for run in self.runs if run["nodes"] <= run["environment"]["processors"]],
                                  machines.by_node)


def series_of(run):
    series = run["series"]
    return study.Series(series["film"], series["kind"], tuple(series["settings"].items()))
