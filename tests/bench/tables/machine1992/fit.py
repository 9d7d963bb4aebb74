"""The costs of the 1992 machine from the cells of table 4.1, and the scale of other tables' figures from one column."""
import math

import numpy

import records
import replay

NODES_OF_COLUMN = 8  # the column by which other tables' figures get their scale
# Where the fit begins: the published clocks, the rate of a channel, and guesses.
FIRST = {"speed": 1.0, "host_byte": 0.4e-6, "host_message": 0.02, "depth": 2e-6}


class Cells:
    """Measured cells of one table, [row, kind, nodes, ms] each, and what the program does for them. `films`: by row,
    nodes and scale, the jobs. `inbetweens`: of an interval; None: as many as nodes. A cell's `ratio` corrects what
    replay.py leaves out: simulated / replayed."""

    def __init__(self, measured, films, network, inbetweens=None):
        self.cells, self.films, self.network, self.inbetweens = measured, films, network, inbetweens
        self.ms = numpy.array([cell[3] for cell in measured], float)
        self.ratio = numpy.ones(len(measured))

    def times(self, costs, scale):
        """Milliseconds, replayed and corrected."""
        def seconds(row, kind, nodes):
            films = self.films[row]
            if kind == "keyframe":
                return replay.keyframe(films[nodes][scale], costs, self.network)
            rounds = self.inbetweens // nodes if self.inbetweens else 1
            return replay.inbetween(films[max(films)][scale], nodes, costs, self.network, rounds)
        return 1000 * self.ratio * numpy.array([seconds(*cell[:3]) for cell in self.cells])

    def only(self, wanted):
        """Those cells for which wanted(cell) holds."""
        keep = [k for k, cell in enumerate(self.cells) if wanted(cell)]
        some = Cells([self.cells[k] for k in keep], self.films, self.network, self.inbetweens)
        some.ms, some.ratio = self.ms[keep], self.ratio[keep]
        return some


def costs_of(parameters):
    return replay.Costs(*(parameters[name] for name in replay.Costs.NAMES))


def residuals(cells, parameters):
    """ln(simulated / measured)."""
    return numpy.log(cells.times(costs_of(parameters), parameters["scale"]) / cells.ms)


def fit_costs(cells, scales=None):
    """The parameters with the least sum of squares of residuals; all are positive. The scale is one of `scales`; of all
    if none are given."""
    found = FIRST
    fits = []
    for scale in scales or records.SCALES:
        found = fit_at(cells, {**found, "scale": scale})
        fits.append(found)
    return min(fits, key=lambda found: squares(residuals(cells, found)))


def fit_at(cells, first):
    """The same, from some values on, at their scale."""
    names = replay.Costs.NAMES

    def parameters(logs):
        return {**first, **dict(zip(names, map(float, numpy.exp(logs))))}
    return parameters(least_squares(lambda logs: residuals(cells, parameters(logs)),
                                    numpy.log([first[name] for name in names])))


def squares(values):
    return float((values**2).sum())


def least_squares(function, at, rounds=40):
    """Levenberg and Marquardt's method with differences for derivatives."""
    damping, now = 1e-2, function(at)
    for _ in range(rounds):
        slopes = numpy.stack([(function(at + step) - now) / 1e-4 for step in 1e-4 * numpy.eye(len(at))], axis=1)
        normal = slopes.T @ slopes
        gained = 0.0
        while gained <= 0 and damping < 1e8:
            step = numpy.linalg.solve(normal + damping * numpy.diag(numpy.diag(normal) + 1e-9), -slopes.T @ now)
            step = numpy.clip(step, -1, 1)
            after = function(at + step)
            gained = now @ now - after @ after
            damping *= 4
        if gained <= 0:
            break
        at, now, damping = at + step, after, damping / 12
        if gained < 1e-9 * (now @ now):
            break
    return at


def uncertainty(cells, found):
    """The standard deviation of each parameter, by the jackknife over the table's columns: cells of one
    column err alike, so they are left out together."""
    columns = sorted({(cell[1], cell[2]) for cell in cells.cells})
    near = max(records.SCALES.index(found["scale"]) - 1, 0)
    fits = [fit_costs(cells.only(lambda cell, column=column: (cell[1], cell[2]) != column), records.SCALES[near:near + 3])
            for column in columns]

    def spread(name):
        values = numpy.array([fit[name] for fit in fits])
        return math.sqrt((len(values) - 1) / len(values) * float(((values - values.mean())**2).sum()))
    return {name: spread(name) for name in found}


def in_column(cell):
    return cell[2] == NODES_OF_COLUMN


def fit_scale(cells, costs):
    """Of a table's figures, by the column of NODES_OF_COLUMN."""
    column = cells.only(in_column)

    return min(records.SCALES, key=lambda scale: squares(numpy.log(column.times(costs, scale) / column.ms)))
