"""Naive predictions of the thesis's cells, beside which those of a simulation are judged: a column's mean, and the row's
cell of 8 nodes divided by the nodes. Cells are {(row, nodes): ms}."""
import statistics

COLUMN = 8  # nodes of the column from which other columns are predicted


def column_means(thesis):
    """For each cell the mean of its column, which knows the cell itself."""
    return {(row, nodes): statistics.mean(column(thesis, nodes).values()) for row, nodes in thesis}


def shared_out(thesis):
    """For each cell its row's cell of 8 nodes times 8/P: as if all work were divided."""
    return {(row, nodes): thesis[row, COLUMN] * COLUMN / nodes for row, nodes in thesis if (row, COLUMN) in thesis}


NAIVE = {"the column's mean": column_means, f"the cell of {COLUMN} nodes times {COLUMN}/P": shared_out}


def column(cells, nodes):
    """By row."""
    return {row: ms for (row, of), ms in cells.items() if of == nodes}


def judged(thesis):
    """The cells by which predictions are compared: neither of the column from which they start, nor alone in theirs."""
    return [(row, nodes) for row, nodes in thesis if nodes != COLUMN and len(column(thesis, nodes)) > 1]


def errors(predicted, thesis):
    """(predicted - thesis) / thesis of the judged cells, by row and nodes."""
    return {cell: predicted[cell] / thesis[cell] - 1 for cell in judged(thesis) if cell in predicted}


def r_squared(predicted, thesis, nodes):
    """The part of a column's variance that the prediction explains: 1 is all, 0 as the column's mean, less than 0 is worse
    than that. None where nothing varies or rows are missing."""
    measured, there = column(thesis, nodes), column(predicted, nodes)
    mean = statistics.mean(measured.values()) if measured else 0
    variance = sum((ms - mean)**2 for ms in measured.values())
    if variance == 0 or not measured.keys() <= there.keys():
        return None
    return 1 - sum((there[row] - ms)**2 for row, ms in measured.items()) / variance


def predictions(table, kind, sources):
    """The cells of the sources in a cells.Cells, then the naive ones, by name."""
    thesis = table.cells_of("thesis", kind)
    return {**{source: table.cells_of(source, kind) for source in sources},
            **{name: predict(thesis) for name, predict in NAIVE.items()}}


def sheet_of(table, kind, sources):
    """Errors and R2 of the sources beside those of naive predictions, as page.py shows tables."""
    thesis, nodes = table.cells_of("thesis", kind), table.nodes_of("thesis", kind)
    rows = []
    for name, predicted in predictions(table, kind, sources).items():
        missed = errors(predicted, thesis)
        (row, at), worst = max(missed.items(), key=lambda item: abs(item[1]))
        rows.append([name, len(missed), f"{100 * statistics.median(map(abs, missed.values())):.1f} %",
                     f"{100 * worst:+.0f} % (row {row}, P = {at})"] +
                    [r_squared(predicted, thesis, n) for n in nodes])
    return {"title": f"Table {table.table}: {kind}s, beside naive predictions", "page": f"table-{table.table}",
            "note": "R2 is the part of a column's variance that a prediction explains. If it is below 0, the prediction is "
                    "worse than the column's mean, which is taken from the cells themselves. The errors leave out "
                    f"P = {COLUMN}, from which predictions start, and columns with a single row.",
            "header": ["prediction", "cells", "median error", "worst"] + [f"R2, P = {n}" for n in nodes], "rows": rows}
