"""A comparison in words: slower or faster and by how much, the same within so much, or cannot tell and why."""
import math

import changes
from table import fraction_text, seconds_text


def tables(comparison):
    """For a terminal."""
    titled = [("time", comparison.times), ("step", comparison.steps), ("machine, computing", comparison.machines)]
    return "\n".join("\n".join(rows(title, found)) + "\n" for title, found in titled if found)


def sentences(comparison):
    return [*summary(comparison), *conditions(comparison), *caveats(comparison)]


def rows(title, found):
    width = max(len(title), *(len(change.name) for change in found))
    yield f"{title.ljust(width)}  {'A':>9}  {'B':>9}  {'B - A':>9}  {'bounds':^20}  answer"
    for change in found:
        yield (f"{change.name.ljust(width)}  {seconds_text(change.a):>9}  {seconds_text(change.b):>9}  "
               f"{signed(change.bounds.middle):>7} %  {bounds_text(change):^20}  {answer(change)}")


def signed(share):
    return f"{round(100 * share, 1) + 0.0:+.1f}"  # no -0.0


def bounds_text(change):
    if not math.isfinite(change.bounds.high):
        return "none"
    return f"{signed(change.bounds.low)} to {signed(change.bounds.high)} %"


def answer(change):
    if change.holds:
        return "slower" if change.slower else "faster"
    return "cannot tell" if change.within is None else f"same within {fraction_text(change.within)}"


def summary(comparison):
    yield f"Film's time: {claim(comparison, comparison.times[0], 'is slower', 'is faster')}"
    for change in comparison.times[1:2]:
        if change.name == changes.PROCESSORS:
            yield f"Processors' seconds: {claim(comparison, change, 'takes more', 'takes fewer')}"
    yield from (f"{change.name}: B is {answer(change)}, by {by(change)}." for change in comparison.times[1:]
                if change.holds and change.name != changes.PROCESSORS)
    if comparison.changed:
        yield f"Step: {step(comparison.cause())}"


def claim(comparison, change, slower, faster):
    if change.holds:
        return f"B {slower if change.slower else faster} than A, by {by(change)}."
    if change.within is not None:
        return f"A and B are the same within {fraction_text(change.within)}."
    return f"cannot tell; {reason(comparison, change)}"


def by(change):
    low, high = sorted((abs(change.bounds.low), abs(change.bounds.high)))
    return f"{fraction_text(abs(change.bounds.middle))} ({100 * low:.1f} to {fraction_text(high)})"


def step(cause):
    if not cause:
        return "cannot tell which; the bounds of none leave zero out."
    return (f"{cause.name}, {answer(cause)} by {fraction_text(abs(cause.bounds.middle))} of the film's time: "
            f"{seconds_text(cause.a)} to {seconds_text(cause.b)} of a mean node.")


def reason(comparison, change):
    """Why it cannot be told, and what to do."""
    count = min(map(len, comparison.blocks))
    if comparison.busy and not comparison.paired:
        return "the machine was busy. Measure the two in turns: mars bench scaling FILM --against PROGRAM."
    if not math.isfinite(change.bounds.high):
        return f"{count} repeats are too few at level {comparison.level}: take {comparison.enough}."
    half = (change.bounds.high - change.bounds.low) / 2
    wanted = math.ceil(count * max(1.1, (half / changes.SAME)**2))
    busy = "the machine was busy, and " if comparison.busy else ""
    return (f"{busy}the runs differ too much: the bounds are {bounds_text(change)}. A quieter machine would help, or "
            f"some {wanted} repeats.")


def conditions(comparison):
    for side, found in zip("AB", comparison.conditions):
        least, greatest = found.load
        seen = [f"load average {least:.2f} to {greatest:.2f} on {found.cores} cores"]
        if found.others is not None:
            seen += [f"other programs took {100 * found.others:.0f} % of the processors",
                     f"{found.switches:.0f} involuntary switches for a processor's second"]
        if found.waited:
            seen += [f"nodes computed {found.waited:.2f} s by the clock for a processor's second"]
        seen += [f"quartiles {fraction_text(found.spread)} of the median apart"]
        yield f"{side}{' (busy)' if found.busy else ''}: {', '.join(seen)}."


def caveats(comparison):
    for title, nodes in comparison.only_one:
        yield f"Only of one of A and B: {title}, nodes {nodes}."
    for title, nodes in comparison.other_films:
        yield f"Other films, sizes or samples of the same name: {title}, nodes {nodes}."
    least = fraction_text(comparison.times[0].least)
    how = "A and B in turns" if comparison.paired else "A and B one after the other"
    yield (f"{min(map(len, comparison.blocks))} repeats, {how}; bounds of a table hold together with the confidence "
           f"{100 * (1 - comparison.level):g} %; changes below {least} are not reported.")
