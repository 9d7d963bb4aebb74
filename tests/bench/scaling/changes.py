"""What differs between A and B beyond noise: two programs that one study measured in turns, or two studies. First the
film's time and the processors' seconds; where these differ, the time by step and the time that each machine computes."""
import itertools
import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy

import conditions
import noise
import study
from results import STEPS, WAITS, computing_on, steps_of

LEAST = 0.02        # of a time; smaller changes are not reported: equal programs differ as much by where their code lies
LEAST_APART = 0.05  # between two studies a quiet machine drifts as much
LEVEL = 0.001       # probability with which noise alone may be reported
SAME = 0.05         # wider bounds do not say that two times are the same

FILM = "film's time"  # of all configurations together
PROCESSORS = "processors' seconds"


@dataclass(frozen=True)
class Quantity:
    name: str
    places: list        # configurations in which it is measured
    seconds: object     # function of a run


@dataclass(frozen=True)
class Change:
    name: str
    a: float  # median seconds; of several configurations their sum
    b: float
    bounds: noise.Bounds  # of B - A, as a share of A's time; of a step or machine as a share of the film's
    least: float = LEAST

    @property
    def holds(self):
        return (self.bounds.low > 0 or self.bounds.high < 0) and abs(self.bounds.middle) >= self.least

    @property
    def slower(self):
        return self.holds and self.bounds.middle > 0

    @property
    def within(self):
        """The times are the same but for this share; None where that cannot be told."""
        furthest = max(0.0, -self.bounds.low, self.bounds.high)
        return None if self.holds or furthest > SAME else furthest


class Comparison:
    """Of A's and B's runs, by the configurations that both have. Paired: each block has a run of both, and chance decided
    which was first."""

    def __init__(self, a, b, paired, level):
        self.paired, self.level = paired, level
        of = by_place(a), by_place(b)
        self.places = sorted(of[0].keys() & of[1].keys())
        if not self.places:
            raise study.Trouble("A and B have no configuration in common")
        self.only_one = sorted(of[0].keys() ^ of[1].keys())
        self.sides = [{place: side[place] for place in self.places} for side in of]
        self.other_films = [place for place in self.places if self.checksum(0, place) != self.checksum(1, place)]
        whole = [set.intersection(*(set(own) for own in side.values())) for side in self.sides]
        self.blocks = [sorted(whole[0] & whole[1])] * 2 if paired else [sorted(blocks) for blocks in whole]
        if not all(self.blocks):
            raise study.Trouble("no repeat has all runs")

    def checksum(self, side, place):
        return next(iter(self.sides[side][place].values()))["checksum"]

    def runs(self, side, place):
        return [self.sides[side][place][block] for block in self.blocks[side]]

    @cached_property
    def conditions(self):
        """A's and B's."""
        return [conditions.of([self.runs(side, place) for place in self.places]) for side in (0, 1)]

    @property
    def busy(self):
        return any(each.busy for each in self.conditions)

    @property
    def enough(self):
        """Repeats that suffice to tell anything of the film's time at this level."""
        chance = (lambda count: 2**count) if self.paired else (lambda count: math.comb(2 * count, count))
        return next(count for count in itertools.count(2) if 2 * len(self.times) <= self.level * chance(count))

    @cached_property
    def times(self):
        """The film's, the processors' seconds if they are known, then each configuration's where there are several."""
        seconds = lambda run: run["seconds"]
        quantities = [Quantity(FILM, self.places, seconds)]
        if all(run["processor_seconds"] for side in (0, 1) for place in self.places for run in self.runs(side, place)):
            quantities.append(Quantity(PROCESSORS, self.places, lambda run: run["processor_seconds"]))
        if len(self.places) > 1:
            quantities += [Quantity(named(place), [place], seconds) for place in self.places]
        found = self.changes(quantities, lambda place, seconds: math.log(seconds))
        ratio = lambda bounds: noise.Bounds(math.expm1(bounds.low), math.expm1(bounds.middle), math.expm1(bounds.high))
        return [replace(change, bounds=ratio(change.bounds)) for change in found]

    @property
    def changed(self):
        return any(change.holds for change in self.times)

    @cached_property
    def steps(self):
        """Over all configurations; those that compute first, then the largest. Empty where no time changed: a step's
        noise shall accuse nobody."""
        quantities = [Quantity(step, self.places, lambda run, step=step: steps_of(run)[step]) for step in STEPS]
        order = lambda change: (change.name in WAITS, -abs(change.bounds.middle))
        return sorted(self.changes(quantities, self.share_of_film), key=order) if self.changed else []

    @cached_property
    def machines(self):
        """The time that each machine's nodes compute, in the configurations in which all runs have it."""
        hosts = {host for place in self.places for host in self.hosts_of(place)}
        if len(hosts) == 1 or not self.changed:
            return []
        quantities = [Quantity(host, [place for place in self.places if host in self.hosts_of(place)],
                               lambda run, host=host: computing_on(run, host)) for host in sorted(hosts)]
        return self.changes(quantities, self.share_of_film)

    def hosts_of(self, place):
        return set.intersection(*({node["host"] for node in run["per_node"]}
                                  for side in (0, 1) for run in self.runs(side, place)))

    def share_of_film(self, place, seconds):
        return seconds / self.film_seconds[place]

    @cached_property
    def film_seconds(self):
        return {place: float(numpy.median([run["seconds"] for run in self.runs(0, place)])) for place in self.places}

    def changes(self, quantities, scale):
        """Of all quantities together."""
        tables = [[[numpy.mean([scale(place, each.seconds(self.sides[side][place][block])) for place in each.places])
                    for each in quantities] for block in self.blocks[side]] for side in (0, 1)]
        bounds = self.bounds(*map(numpy.array, tables))
        middle = lambda side, each: float(sum(numpy.median([each.seconds(run) for run in self.runs(side, place)])
                                              for place in each.places))
        least = LEAST if self.paired else LEAST_APART
        return [Change(each.name, middle(0, each), middle(1, each), own, least) for each, own in zip(quantities, bounds)]

    def bounds(self, a, b):
        """Two studies on a busy machine say nothing: what else it did may have changed between them."""
        if self.paired:
            return noise.paired(b - a, self.level)
        found = noise.apart(a, b, self.level)
        return [each.wider(math.inf) for each in found] if self.busy else found

    def cause(self):
        """The step that changed most, of those that compute if any did, and in the film's direction; None if none did."""
        film = next((change for change in self.times if change.holds), None)
        same_way = [step for step in self.steps if step.holds and step.slower == film.slower]
        share = lambda step: abs(step.bounds.middle)
        largest = max(same_way, key=share, default=None)
        # A node's delay makes others wait for it: longer together than the delay, but not by orders of magnitude.
        causes = [step for step in same_way if step.name not in WAITS and share(step) > 0.1 * share(largest)]
        return max(causes, key=share, default=largest)


def named(place):
    title, nodes = place
    return f"{title}, nodes {nodes}"


def by_place(runs):
    """{(series' title without the program, nodes): {block: run}}"""
    found = {}
    for run in runs:
        series = run["series"]
        title = study.Series(series["film"], series["kind"], tuple(series["settings"].items())).title()
        found.setdefault((title, run["nodes"]), {})[run["block"]] = run
    return found


def of_programs(results, level=LEVEL):
    """Of a study with --against."""
    a, b = ([run for run in results.runs if run["series"]["settings"].get("program") == program]
            for program in study.PROGRAMS)
    return Comparison(a, b, True, level)


def of_studies(before, after, level=LEVEL):
    return Comparison(before.runs, after.runs, False, level)
