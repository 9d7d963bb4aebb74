"""How far measurements of two sides differ, with bounds that hold however noise is distributed.

A block is all that was measured in one repeat, a column one quantity of it. What happens on a machine meets a whole
block, so blocks are resampled as wholes: in each resampling chance decides which side a block's measurements belong to.
Ranks let no single run decide. The bounds of all columns hold together with the confidence 1 - level, because they come
from the column that is furthest from equality in each resampling (Westfall and Young 1993)."""
import functools
import itertools
import math
from dataclasses import dataclass

import numpy

DRAWN = 20000  # resamplings; where there are no more, all are tried
SEED = 1


@dataclass(frozen=True)
class Bounds:
    """Of the difference B - A of one column. Infinite where there are too few blocks."""
    low: float
    middle: float  # Hodges and Lehmann's estimate (1963)
    high: float

    def wider(self, by):
        return Bounds(self.low - by, self.middle, self.high + by)


def ranks(values):
    """From 1; equal values share the mean of their ranks."""
    _, place, counts = numpy.unique(values, return_inverse=True, return_counts=True)
    ends = numpy.cumsum(counts)
    return ((ends - counts + 1 + ends) / 2)[place]


def ranks_of_columns(table):
    return numpy.apply_along_axis(ranks, 0, table)


@functools.lru_cache(maxsize=None)
def exchanges(blocks):
    """1 where a block's sides stay, -1 where they are exchanged; rows: resamplings, the first of them as measured."""
    if 2**blocks <= DRAWN:
        return numpy.array(list(itertools.product((1.0, -1.0), repeat=blocks)))
    drawn = numpy.random.default_rng(SEED).choice((1.0, -1.0), (DRAWN, blocks))
    drawn[0] = 1
    return drawn


@functools.lru_cache(maxsize=None)
def choices(count, total):
    """1 for `count` of the `total` blocks, which are taken for B's; rows: resamplings, the first of them as measured."""
    chosen = numpy.zeros((min(math.comb(total, count), DRAWN), total))
    if math.comb(total, count) <= DRAWN:
        for row, places in zip(chosen, itertools.combinations(reversed(range(total)), count)):
            row[list(places)] = 1
        return chosen
    chosen[:, total - count:] = 1
    chosen[1:] = numpy.random.default_rng(SEED).permuted(chosen[1:], axis=1)
    return chosen


def paired(differences, level):
    """Bounds of each column of the blocks' differences B - A, if chance decided in each block which side ran first: by
    Wilcoxon's signed ranks (1945). They hold however the blocks depend on one another."""
    table = numpy.array(differences, float)
    ranked = numpy.sign(table) * ranks_of_columns(abs(table))
    one, other = numpy.triu_indices(len(table))
    return bounds((table[one] + table[other]) / 2, exchanges(len(table)) @ ranked / 2, level)


def apart(before, after, level):
    """Bounds of each column, if all blocks of both sides depend on nothing that changed between them: by Wilcoxon's rank
    sums. Machines do change: twice what a column drifts within a side is therefore added on both ends."""
    sides = numpy.array(before, float), numpy.array(after, float)
    count, total = len(after), len(before) + len(after)
    sums = choices(count, total) @ ranks_of_columns(numpy.concatenate(sides)) - count * (total + 1) / 2
    differences = (sides[1][:, None] - sides[0][None]).reshape(-1, sides[0].shape[1])
    drifts = numpy.maximum(*map(drift, sides))
    return [each.wider(2 * by) for each, by in zip(bounds(differences, sums, level), drifts)]


def drift(side):
    """How far the medians of a side's two halves lie apart."""
    half = max(1, len(side) // 2)
    return abs(numpy.median(side[-half:], axis=0) - numpy.median(side[:half], axis=0))


def bounds(candidates, resampled, level):
    """Of each column. `candidates`: differences that the measurements show; `resampled`: by how many candidates more or
    fewer than half are above 0, in each resampling."""
    furthest = numpy.sort(abs(resampled).max(axis=1))[::-1][int(level * len(resampled))]
    cut = int(len(candidates) / 2 - furthest + 1e-9)  # candidates that lie outside on each side
    ordered = numpy.sort(candidates, axis=0)
    low, high = (ordered[cut - 1], ordered[-cut]) if cut > 0 else numpy.full((2, ordered.shape[1]), numpy.inf) * [[-1], [1]]
    return [Bounds(*map(float, column)) for column in zip(low, numpy.median(ordered, axis=0), high)]


def stands_out(rows, rounds=5000):
    """The column that is greatest on average, and the probability that one of the columns is so far above 0 if within
    each row all columns were alike. `rows`: lists of numbers of the same length."""
    table = numpy.array(rows, float)
    chance = numpy.random.default_rng(SEED)
    column = int(table.mean(axis=0).argmax())
    drawn = numpy.array([chance.permuted(table, axis=1).mean(axis=0).max() for _ in range(rounds)])
    as_great = int((drawn >= table.mean(axis=0)[column] - 1e-12).sum())
    return column, (1 + as_great) / (1 + rounds)
