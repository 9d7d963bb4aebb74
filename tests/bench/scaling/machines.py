"""Which machine or node is slower than the others, by more than noise: the time that each takes for a unit of the work
that its report counts, beside the others of the same run."""
from dataclasses import dataclass

import numpy

import noise
from runs import KINDS

# Steps in which a node computes, and the work that makes their time. Reports have no such work of `shadow`; in all other
# steps a node waits for others.
WORK = {"dice": lambda work: work["vertices"],
        "fill": lambda work: work["edge_boxes_diced"],
        "scanline": lambda work: 7 * work["edge_boxes"] + 2 * work["samples"]}  # docs/measuring.md
NOTABLE = 1.25   # some pictures' parts cost so much more than others for the same count
LEVEL = 0.01


@dataclass(frozen=True)
class Slow:
    name: str           # of the machine or node
    times: float        # as long as the others take
    steps: dict         # the same by step, of those that are NOTABLE
    probability: float  # of such a difference by chance
    runs: int


def by_machine(node):
    return node["host"]


def by_node(node):
    return f"node {node['node']} on {node['host']}"


def totals(run, name_of):
    """Seconds and work by (step, kind of frame), for each name."""
    found = {}
    for node in run["per_node"]:
        own = found.setdefault(name_of(node), {})
        for kind in KINDS:
            for step, count in WORK.items():
                if node[kind]["frames"] > 0:
                    seconds, work = own.get((step, kind), (0, 0))
                    own[step, kind] = seconds + node[kind]["seconds"][step], work + count(node[kind]["work"])
    return found


def slowness(run, name_of):
    """How many times as long each name takes as the middle one of the others: {name: {step: times}}, with "all" for all
    steps together. Empty where there are no others."""
    found = totals(run, name_of)
    slow = {}
    for name, own in found.items():
        took, expected = dict.fromkeys([*WORK, "all"], 0.0), dict.fromkeys([*WORK, "all"], 0.0)
        for key, (seconds, work) in own.items():
            rates = [other[key][0] / other[key][1] for else_name, other in found.items()
                     if else_name != name and key in other and other[key][1] > 0]
            if rates:
                for step in (key[0], "all"):
                    took[step] += seconds
                    expected[step] += work * float(numpy.median(rates))
        slow[name] = {step: took[step] / expected[step] for step in took if expected[step] > 0 and took[step] > 0}
    return {name: times for name, times in slow.items() if "all" in times} if len(slow) > 1 else {}


def slow_ones(runs, name_of=by_machine):
    """The slow names, slowest first. The runs of most names are asked, as a test of one run after the other needs the
    same names in each; once one is found, the others are compared without it."""
    measured = [slowness(run, name_of) for run in runs]
    names = max((frozenset(each) for each in measured), key=lambda each: (len(each), sorted(each)), default=frozenset())
    return among(runs, names, name_of) if len(names) > 1 else []


def can_tell(runs, hosts):
    """Whether there are runs enough on all of the machines to distinguish the slowest from chance."""
    on_all = [run for run in runs if {node["host"] for node in run["per_node"]} == set(hosts)]
    return len(hosts) ** (1 - len(on_all)) <= LEVEL


def among(runs, names, name_of):
    only = [{**run, "per_node": [node for node in run["per_node"] if name_of(node) in names]} for run in runs]
    rows = [row for row in (slowness(run, name_of) for run in only) if set(row) == set(names)]
    order = sorted(names)
    if len(order) < 2 or not rows:
        return []
    column, probability = noise.stands_out([[numpy.log(row[name]["all"]) for name in order] for row in rows])
    name = order[column]
    middle = lambda step: float(numpy.median([row[name][step] for row in rows if step in row[name]] or [1.0]))
    if probability > LEVEL or middle("all") < NOTABLE:
        return []
    steps = {step: middle(step) for step in WORK if middle(step) >= NOTABLE}
    found = Slow(name, middle("all"), steps, probability, len(rows))
    return [found, *among(runs, names - {name}, name_of)]
