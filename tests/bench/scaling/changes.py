"""What changed between two studies beyond noise: the time of each configuration, the time by step over all of them, and
the time that each machine computes."""
from dataclasses import dataclass, replace
from functools import cached_property

import numpy

import noise
from results import STEPS, WAITS, steps_of
from runs import KINDS

LEAST = 0.02  # of a time; smaller changes are not reported: between two studies a quiet machine drifts as much


@dataclass(frozen=True)
class Change:
    name: str
    before: float  # median seconds; of several configurations their sum
    after: float
    best: float    # ratio of the best times, after / before
    probability: float  # of ranks so different by chance, corrected for all that were compared with it
    least: float = 0  # smaller differences are not reported, seconds
    wanted: int = 0  # repeats that would suffice, where so few can show nothing

    @property
    def ratio(self):
        return self.after / self.before if self.before > 0 else float("inf" if self.after > 0 else 1)

    def holds(self, level):
        return self.probability <= level and abs(self.after - self.before) >= self.least

    @property
    def slower(self):
        return self.ratio > 1


class Comparison:
    """Of two Results, by the configurations that both have."""

    def __init__(self, before, after, level=0.05):
        self.level = level
        of = [{(line.series.title(), point.nodes): point for line in results.lines for point in line.points}
              for results in (before, after)]
        self.pairs = {key: (of[0][key], of[1][key]) for key in of[0] if key in of[1]}
        self.only_one = sorted(set(of[0]) ^ set(of[1]))
        self.other_films = [key for key, (a, b) in self.pairs.items()
                            if a.runs[0]["checksum"] != b.runs[0]["checksum"]]

    def change(self, name, of_run, pairs):
        """Of one quantity of runs over pairs of points; with its probability alone."""
        strata = [([of_run(run) for run in a.runs], [of_run(run) for run in b.runs]) for a, b in pairs]
        total = lambda side, statistic: float(sum(statistic(stratum[side]) for stratum in strata))
        before = total(0, min)
        middle = total(0, numpy.median)
        return Change(name, middle, total(1, numpy.median), total(1, min) / before if before > 0 else 1,
                      noise.differ(strata), LEAST * middle)

    def corrected(self, changes):
        """With Holm's correction for all of them."""
        return [replace(change, probability=probability)
                for change, probability in zip(changes, noise.holm([change.probability for change in changes]))]

    @cached_property
    def times(self):
        """Of all configurations together, then of each."""
        everything = [("all configurations", list(self.pairs.values()))]
        each = [(f"{title}, nodes {nodes}", [pair]) for (title, nodes), pair in self.pairs.items()]
        seconds = lambda run: run["seconds"]
        corrected = self.corrected([self.change(name, seconds, pairs) for name, pairs in everything + each])
        wanted = [0, *map(self.repeats_wanted, self.pairs.values())]
        return [replace(change, wanted=repeats) for change, repeats in zip(corrected, wanted)]

    def repeats_wanted(self, pair):
        """Where even the clearest difference of so few runs would be lost among so many comparisons; else 0."""
        possible = lambda a, b: (1 + len(self.pairs)) * noise.least_possible(a, b) <= self.level
        if possible(len(pair[0].runs), len(pair[1].runs)):
            return 0
        return next(repeats for repeats in range(2, 100) if possible(repeats, repeats))

    @cached_property
    def steps(self):
        """Over all configurations; those that compute first, then by seconds gained or lost. Waiting follows from what
        other nodes do. What is little beside the film's time is not reported."""
        least = self.times[0].least
        pairs = list(self.pairs.values())
        changes = self.corrected([self.change(step, lambda run, step=step: steps_of(run)[step], pairs) for step in STEPS])
        order = lambda change: (change.name in WAITS, -abs(change.after - change.before))
        return sorted([replace(change, least=least) for change in changes], key=order)

    def cause(self):
        """The step that changed most, of those that compute if any did, and in the film's direction if that is known;
        None if no step changed."""
        film = self.times[0]
        same_way = [step for step in self.steps
                    if step.holds(self.level) and (step.slower == film.slower or not film.holds(self.level))]
        share = lambda step: abs(step.after - step.before)
        computing = [step for step in same_way if step.name not in WAITS]
        largest = max(same_way, key=share, default=None)
        # A node's delay makes others wait for it: longer together than the delay, but not by orders of magnitude.
        causes = [step for step in computing if share(step) > 0.1 * share(largest)]
        return max(causes, key=share, default=largest)

    @cached_property
    def machines(self):
        """The time that each machine's nodes compute, over the configurations in which both studies have it."""
        changes = []
        for host in sorted({host for a, _ in self.pairs.values() for host in hosts_of(a)}):
            pairs = [(a, b) for a, b in self.pairs.values() if host in hosts_of(a) & hosts_of(b)]
            if pairs:
                changes.append(self.change(host, lambda run, host=host: computing_on(run, host), pairs))
        return self.corrected(changes)


def hosts_of(point):
    return set.intersection(*({node["host"] for node in run["per_node"]} for run in point.runs))


def computing_on(run, host):
    return sum(node[kind]["seconds"][step] for node in run["per_node"] if node["host"] == host
               for kind in KINDS for step in STEPS if step not in WAITS)
