"""The laws of scaling, and how far repeated measurements spread. Times are seconds."""
from dataclasses import dataclass

import numpy


@dataclass(frozen=True)
class Spread:
    """Of repeated measurements."""
    best: float
    lower: float   # quartile
    median: float
    upper: float   # quartile
    count: int


def spread(values):
    lower, median, upper = numpy.percentile(values, [25, 50, 75])
    return Spread(float(min(values)), float(lower), float(median), float(upper), len(values))


def speed_up(times, nodes):
    """By number of nodes, from the times by number of nodes. The fewest nodes are taken to be perfectly efficient, which
    means nothing where they are one."""
    base = min(nodes)
    return {count: base * times[base] / times[count] for count in nodes}


def karp_flatt(speed_up, nodes):
    """The serial fraction that alone would explain a speed-up (Karp and Flatt 1990); None for one node."""
    return None if nodes == 1 else (1 / speed_up - 1 / nodes) / (1 - 1 / nodes)


def amdahl(times):
    """The serial fraction s of T(P) = T(1) (s + (1 - s) / P), Amdahl's law (1967), and T(1): the least sum of squared
    relative errors over `times`, pairs of nodes and seconds. Below 0 or above 1 the law does not hold."""
    nodes, seconds = (numpy.array(column, float) for column in zip(*times))
    terms = numpy.stack([numpy.ones_like(nodes), 1 / nodes], axis=1) / seconds[:, None]
    (serial, parallel), *_ = numpy.linalg.lstsq(terms, numpy.ones_like(seconds), rcond=None)
    return float(serial / (serial + parallel)), float(serial + parallel)


def gustafson(scaled, nodes):
    """The serial fraction s of the scaled speed-up P + (1 - P) s (Gustafson 1988); None for one node."""
    return None if nodes == 1 else (nodes - scaled) / (nodes - 1)


def bootstrapped(statistic, groups, rounds=1000, seed=1, level=0.05):
    """Bounds of `statistic(groups)` with the confidence 1 - level, by resampling each group's values."""
    chance = numpy.random.default_rng(seed)
    drawn = [statistic([chance.choice(group, len(group)) for group in groups]) for _ in range(rounds)]
    return tuple(float(bound) for bound in numpy.quantile(drawn, [level / 2, 1 - level / 2]))
