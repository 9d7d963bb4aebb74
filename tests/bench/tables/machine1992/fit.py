"""The costs of the 1992 machine from the cells of table 4.1, and the scale of other tables' figures from one column."""
import math

import numpy

import records
import replay

NODES_OF_COLUMN = 8  # the column by which other tables' figures get their scale
# Where the fit begins: the published clocks, the rate of a channel, and guesses.
FIRST = {"speed": 1.0, "host_byte": 0.4e-6, "host_message": 0.02, "depth": 2e-6, "scale": 0.2}
FIRST_SCALES = [0.05, 0.2, 0.6]


class Cells:
    """Measured cells of one table, [row, kind, nodes, ms] each, and what the program does for them. `films`: by row, the
    Scaled jobs by nodes. A cell's `ratio` corrects what replay.py leaves out: simulated / replayed."""

    def __init__(self, measured, films, network):
        self.cells, self.films, self.network = measured, films, network
        self.ms = numpy.array([cell[3] for cell in measured], float)
        self.ratio = numpy.ones(len(measured))

    def times(self, costs, scale):
        """Milliseconds, replayed and corrected."""
        jobs = {}

        def job(row, nodes):
            if (row, nodes) not in jobs:
                jobs[row, nodes] = self.films[row][nodes].at(scale)
            return jobs[row, nodes]

        def seconds(row, kind, nodes):
            if kind == "keyframe":
                return replay.keyframe(job(row, nodes), costs, self.network)
            return replay.inbetween(job(row, max(self.films[row])), nodes, costs, self.network)
        return 1000 * self.ratio * numpy.array([seconds(*cell[:3]) for cell in self.cells])

    def only(self, wanted):
        """Those cells for which wanted(cell) holds."""
        keep = [k for k, cell in enumerate(self.cells) if wanted(cell)]
        some = Cells([self.cells[k] for k in keep], self.films, self.network)
        some.ms, some.ratio = self.ms[keep], self.ratio[keep]
        return some


def costs_of(parameters):
    return replay.Costs(*(parameters[name] for name in replay.Costs.NAMES))


def residuals(cells, parameters):
    """ln(simulated / measured)."""
    return numpy.log(cells.times(costs_of(parameters), parameters["scale"]) / cells.ms)


def fit_costs(cells):
    """The parameters with the least sum of squares of residuals; all are positive."""
    fits = [fit_from(cells, {**FIRST, "scale": scale}) for scale in FIRST_SCALES]
    return min(fits, key=lambda found: float((residuals(cells, found)**2).sum()))


def fit_from(cells, first, fixed=()):
    """The same, from some values on. `fixed`: names that keep theirs."""
    names = [name for name in FIRST if name not in fixed]

    def parameters(logs):
        return {**first, **dict(zip(names, map(float, numpy.exp(logs))))}

    def within(logs):
        low, high = math.log(min(records.SCALES)), math.log(max(records.SCALES))
        return numpy.array([min(max(log, low), high) if name == "scale" else log for name, log in zip(names, logs)])
    return parameters(least_squares(lambda logs: residuals(cells, parameters(logs)),
                                    numpy.log([first[name] for name in names]), within))


def least_squares(function, at, within, rounds=40):
    """Levenberg and Marquardt's method with differences for derivatives. within(x): the place next to x that is allowed."""
    at = within(at)
    damping, now = 1e-2, function(at)
    for _ in range(rounds):
        slopes = numpy.stack([(function(at + step) - now) / 1e-4 for step in 1e-4 * numpy.eye(len(at))], axis=1)
        normal = slopes.T @ slopes
        gained = 0.0
        while gained <= 0 and damping < 1e8:
            step = numpy.linalg.solve(normal + damping * numpy.diag(numpy.diag(normal) + 1e-9), -slopes.T @ now)
            step = within(at + numpy.clip(step, -1, 1)) - at
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
    fits = [fit_from(cells.only(lambda cell, column=column: (cell[1], cell[2]) != column), found) for column in columns]

    def spread(name):
        values = numpy.array([fit[name] for fit in fits])
        return math.sqrt((len(values) - 1) / len(values) * float(((values - values.mean())**2).sum()))
    return {name: spread(name) for name in found}


def in_column(cell):
    return cell[2] == NODES_OF_COLUMN


def fit_scale(cells, costs):
    """Of a table's figures, by the column of NODES_OF_COLUMN."""
    column = cells.only(in_column)

    def error(scale):
        return float((numpy.log(column.times(costs, scale) / column.ms)**2).sum())
    least, most = min(records.SCALES), max(records.SCALES)
    coarse = numpy.geomspace(least, most, 30)
    best = min(coarse, key=error)
    step = coarse[1] / coarse[0]
    return float(min(numpy.clip(best * numpy.geomspace(1 / step, step, 21), least, most), key=error))
