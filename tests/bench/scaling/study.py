"""What a scaling study runs: its configurations, and the order in which they take turns.

A series is one film with one choice of settings, strong or weak; its configurations differ in the number of nodes."""
import itertools
import math
import os
import random
from dataclasses import dataclass, replace

# The settings that a study may vary, as options of `mars render`; `dice` is a key of the film.
AXES = ("backend", "mapping", "block", "groups", "samples", "size", "dice")
KINDS = ("strong", "weak")
PROGRAMS = ("A", "B")  # values of the setting `program` where a study compares two


class Trouble(Exception):
    """What ends a study, in one line for people."""


@dataclass(frozen=True, order=True)
class Series:
    film: str             # file; of pairs: their files, joined
    kind: str             # strong, weak
    settings: tuple = ()  # pairs (axis, value), those that were asked for

    def title(self, varied=AXES):
        """Names those of the settings."""
        return ", ".join(filter(None, [self.name(), self.kind, self.choice(varied)]))

    def name(self):
        """The film's, without folders; of pairs each one's."""
        return " ".join(os.path.splitext(os.path.basename(word))[0] if ":" not in word else os.path.basename(word)
                        for word in self.film.split(" "))

    def choice(self, varied=AXES):
        return ", ".join(f"{axis} {value}" for axis, value in self.settings if axis in varied)


@dataclass(frozen=True)
class Configuration:
    series: Series
    nodes: int
    film: str         # the file that is rendered
    size: tuple = ()  # width and height in pixels; (): the film's own

    def setting(self, axis):
        return dict(self.series.settings).get(axis)

    def by(self, program):
        """The same of one of PROGRAMS."""
        return replace(self, series=replace(self.series, settings=(*self.series.settings, ("program", program))))


def combinations(axes):
    """Every choice of one value of each axis, as a series has them; axes without values are left out."""
    given = [(axis, axes[axis]) for axis in AXES if axes.get(axis)]
    for values in itertools.product(*(values for _, values in given)):
        yield tuple((axis, value) for (axis, _), value in zip(given, values))


def size_of(text):
    """ "960x540" as (960, 540)."""
    try:
        width, height = (int(number) for number in text.split("x"))
    except ValueError:
        raise Trouble(f"a size is WIDTHxHEIGHT, as 960x540, not {text}") from None
    return width, height


def grown(size, factor):
    """A picture of the same shape with `factor` times the pixels, as nearly as whole pixels allow."""
    return tuple(max(1, round(side * math.sqrt(factor))) for side in size)


def strong(films, nodes, axes):
    for film, settings in itertools.product(films, combinations(axes)):
        size = size_of(dict(settings)["size"]) if "size" in dict(settings) else ()
        for count in nodes:
            yield Configuration(Series(film, "strong", settings), count, film, size)


def weak(films, nodes, axes, own_size):
    """Pictures whose pixels grow with the nodes, from the size given at the fewest nodes on; `own_size` gives a film's."""
    for film, settings in itertools.product(films, combinations(axes)):
        size = size_of(dict(settings)["size"]) if "size" in dict(settings) else own_size(film)
        for count in nodes:
            yield Configuration(Series(film, "weak", settings), count, film, grown(size, count / min(nodes)))


def weak_pairs(pairs, axes):
    """`pairs`: (nodes, film), each film with its nodes' work."""
    name = " ".join(f"{nodes}:{film}" for nodes, film in pairs)
    for settings in combinations(axes):
        size = size_of(dict(settings)["size"]) if "size" in dict(settings) else ()
        for nodes, film in pairs:
            yield Configuration(Series(name, "weak", settings), nodes, film, size)


def turns(configurations, warm_ups, repeats, seed):
    """(configuration, repeat) in the order in which they run; warm-ups have repeat 0. Every configuration runs once
    before any runs again, each time in another order, so that what changes on the machine in time meets all alike."""
    chance = random.Random(seed)
    for repeat in [0] * warm_ups + list(range(1, repeats + 1)):
        shuffled = list(configurations)
        chance.shuffle(shuffled)
        yield from ((configuration, repeat) for configuration in shuffled)


def in_pairs(turns, seed):
    """Each turn as two, one of each of PROGRAMS. Chance decides which is first, each equally often of a configuration, so
    that what happens on the machine meets both alike."""
    turns, chance, orders = list(turns), random.Random(seed), {}
    for configuration, repeat in turns:
        if configuration not in orders:
            count = sum(other == configuration for other, _ in turns)
            orders[configuration] = [PROGRAMS[::step] for step in (1, -1)] * ((count + 1) // 2)
            chance.shuffle(orders[configuration])
        for program in orders[configuration].pop():
            yield configuration.by(program), repeat
