"""Whether measurements differ by more than noise, without assuming how noise is distributed: rank and permutation tests,
and Holm's correction where many are made at once."""
import itertools
import math

import numpy

EXACT = 5000  # rearrangements that are all tried; of more, as many are drawn
SEED = 1


def ranks(values):
    """From 1; equal values share the mean of their ranks."""
    _, place, counts = numpy.unique(values, return_inverse=True, return_counts=True)
    ends = numpy.cumsum(counts)
    return ((ends - counts + 1 + ends) / 2)[place]


def rearranged_means(pooled, count, chance):
    """The mean rank of `count` of the pooled values, for all or for many random choices of them; exact?"""
    total = len(pooled)
    if math.comb(total, count) <= EXACT:
        chosen = numpy.array(list(itertools.combinations(range(total), count)))
        return pooled[chosen].mean(axis=1), True
    shuffled = chance.permuted(numpy.tile(pooled, (EXACT, 1)), axis=1)
    return shuffled[:, :count].mean(axis=1), False


def differ(strata):
    """The probability of ranks as different as these or more, if the two sides of every stratum were measured on the same
    thing (two-sided): of one stratum Wilcoxon's rank sum test (1945), of several van Elteren's (1960). `strata`: pairs
    of lists."""
    chance = numpy.random.default_rng(SEED)
    observed, centre, drawn, exact = 0.0, 0.0, 0.0, True
    for before, after in strata:
        pooled = ranks([*after, *before])
        weight = len(after) / (len(pooled) + 1)
        means, all_of_them = rearranged_means(pooled, len(after), chance)
        exact = all_of_them and len(strata) == 1
        observed += weight * pooled[:len(after)].mean()
        centre += weight * (len(pooled) + 1) / 2
        drawn = drawn + weight * (means if exact else chance.choice(means, EXACT))
    as_far = numpy.abs(drawn - centre) >= abs(observed - centre) - 1e-9
    return float(as_far.mean()) if exact else float((1 + as_far.sum()) / (1 + EXACT))


def least_possible(before, after):
    """The smallest probability that `differ` can give for so many measurements of one stratum."""
    return min(1.0, 2 / math.comb(before + after, after))


def holm(probabilities):
    """Each probability corrected for how many there are (Holm 1979): those below a level are all right together with
    the confidence 1 - level."""
    order = numpy.argsort(probabilities)
    corrected, greatest = [1.0] * len(order), 0.0
    for place, index in enumerate(order):
        greatest = max(greatest, min(1.0, (len(order) - place) * probabilities[index]))
        corrected[index] = greatest
    return corrected


def stands_out(rows, rounds=5000):
    """The column that is greatest on average, and the probability that one of the columns is so far above 0 if within
    each row all columns were alike. `rows`: lists of numbers of the same length."""
    table = numpy.array(rows, float)
    chance = numpy.random.default_rng(SEED)
    column = int(table.mean(axis=0).argmax())
    drawn = numpy.array([chance.permuted(table, axis=1).mean(axis=0).max() for _ in range(rounds)])
    as_great = int((drawn >= table.mean(axis=0)[column] - 1e-12).sum())
    return column, (1 + as_great) / (1 + rounds)
