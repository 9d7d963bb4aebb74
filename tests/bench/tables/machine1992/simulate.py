#!/usr/bin/env python3
"""The tables of 1992 on a simulated iPSC/2, by the thesis's algorithms: mars bench
machine1992 FILE.

Writes FILE, with all cells, the fitted parameters and their uncertainty, and
prints how far the cells are from the thesis's. README.md says what is fitted on
what."""
import argparse
import concurrent.futures
import json
import os
import statistics
import subprocess
import sys
import tempfile

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

import baselines  # noqa: E402
import cells as tables  # noqa: E402
import choices  # noqa: E402
import fit  # noqa: E402
import inbetweens  # noqa: E402
import records  # noqa: E402
import replay  # noqa: E402
import scenes  # noqa: E402
from costs import WORKS  # noqa: E402

INBETWEENS = 32
CORRECTIONS = 2  # of what is replayed, by what is simulated


class Simulator:
    """Films and programs. `folder`: for films and costs. `names`: of the films; all if none are given."""

    def __init__(self, build, folder, names=None):
        self.program = os.path.join(build, "bench", "tables", "machine1992")
        self.folder = folder
        write_films(scenes.Cut(2, INBETWEENS), 1.0, names, folder)

    def film(self, table, row):
        return os.path.join(self.folder, f"{table}-{row}.json")

    def record(self, table, row, measured):
        """By nodes, the jobs that the row's cells need."""
        nodes = sorted({cell[2] for cell in measured if cell[0] == row})
        if "inbetween" not in tables.KINDS[table]:
            return records.record(self.program, self.film(table, row), nodes, 0)
        most = [max(nodes)]
        return {**records.record(self.program, self.film(table, row), nodes[:-1], 0),
                **records.record(self.program, self.film(table, row), most, INBETWEENS)}

    def times(self, table, measured, parameters):
        """Milliseconds of the cells, simulated."""
        costs = fit.costs_of(parameters)
        file = os.path.join(self.folder, "costs.json")
        with open(file, "w") as to:
            json.dump({"work": dict(zip(WORKS, map(float, costs.work))), "host_byte": costs.host_byte,
                       "host_message": costs.host_message}, to)

        def row_times(row):
            nodes = sorted({cell[2] for cell in measured if cell[0] == row})
            words = [self.program, "time", self.film(table, row), ",".join(map(str, nodes)),
                     repr(parameters["scale"]), replay.IPSC2, file]
            found = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
            keyframe = {("keyframe", int(one["count"])): one["keyframe"] for one in found}
            inbetween = {("inbetween", int(one["count"])): (one["interval"] - one["keyframe"]) / one["count"]
                         for one in found}
            return row, {**keyframe, **inbetween}
        by_row = dict(in_pairs(row_times, rows_of(measured)))
        return [1000 * by_row[row][kind, nodes] for row, kind, nodes, _ in measured]


def write_films(cut, scale, names, folder):
    """Those of table 4.3 with nothing that moves."""
    scenes.write({name: still(film) if name.startswith("4.3") else film
                  for name, film in scenes.all_films(cut, scale).items() if names is None or name in names}, folder)


def still(film):
    """With nothing that moves, all in its first pose."""
    def at_rest(actor):
        first = actor.get("keys", [{"pose": {}}])[0]["pose"]
        return {**{name: value for name, value in actor.items() if name != "keys"},
                "pose": {**actor.get("pose", {}), **first}}
    return {**film, "actors": [at_rest(actor) for actor in film["actors"]]}


def rows_of(measured):
    return sorted({cell[0] for cell in measured})


def in_pairs(function, items):
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return list(pool.map(function, items))


def measured_cells():
    """By table, [row, kind, nodes, ms]."""
    return {part["table"]: cells_of(part) for part in tables.load(tables.THESIS)}


def best_fit(simulator, table, cells, fitted, by):
    """Parameters and simulated times. fitted(cells) gives parameters for what is replayed, which is corrected by what is
    simulated. Of some rounds the one whose simulated cells are nearest to the measured ones among those of by(cell)."""
    rounds = []
    for _ in range(CORRECTIONS + 1):
        found = fitted(cells)
        times = numpy.array(simulator.times(table, cells.cells, found))
        cells.ratio *= times / cells.times(fit.costs_of(found), found["scale"])
        error = fit.squares(numpy.log(times / cells.ms)[[by(cell) for cell in cells.cells]])
        rounds.append((error, found, times))
    return min(rounds, key=lambda of: of[0])[1:]


def simulate(simulator, wanted, measured):
    """The parts of the file, a table each, and where the time of inbetweens goes; 4.1 is the first, by which costs are
    fitted."""
    network = replay.Network()
    parts, sheets, costs, spread = [], [], None, {}
    for table in wanted:
        rows = rows_of(measured[table])
        films = dict(zip(rows, in_pairs(lambda row, of=table: simulator.record(of, row, measured[of]), rows)))
        cells = fit.Cells(measured[table], films, network)
        if table == "4.1":
            costs, times = best_fit(simulator, table, cells, fitted_costs, lambda cell: True)
            found, spread = costs, fit.uncertainty(cells, costs)
        else:
            found, times = best_fit(simulator, table, cells, lambda of, known=costs: {
                **known, "scale": fit.fit_scale(of, fit.costs_of(known))}, fit.in_column)
        parts.append(part_of(table, measured[table], times, found, spread))
        if "inbetween" in tables.KINDS[table]:
            jobs = {row: of[max(of)][found["scale"]] for row, of in films.items()}
            sheets.append(inbetweens.sheet_of(table, measured[table], cells_of(parts[-1]), jobs, fit.costs_of(costs),
                                              network))
    return parts + sheets


def fitted_costs(cells):
    """With the digits that the file has, so that who reads it finds the same times."""
    return {name: rounded(value) for name, value in fit.fit_costs(cells).items()}


def part_of(table, measured, times, found, spread):
    listed = [{"row": row, "kind": kind, "nodes": nodes, "ms": round(ms, 1)}
              for (row, kind, nodes, _), ms in zip(measured, times)]
    parameters = {f"scale of {table}": rounded(found["scale"])}
    if table == "4.1":
        parameters |= {name: found[name] for name in replay.Costs.NAMES}
        parameters |= {f"{name}, standard deviation": rounded(spread[name]) for name in replay.Costs.NAMES}
    return {"table": table, "source": "simulated-thesis", "parameters": parameters, "cells": listed}


def cells_of(part):
    """Of a file's part, [row, kind, nodes, ms]."""
    return [(cell["row"], cell["kind"], cell["nodes"], cell["ms"]) for cell in part["cells"]]


def rounded(value):
    return float(f"{value:.4g}")


def report(part):
    """Deviations from the thesis, for a person: those of all cells, a line a row, beside naive predictions."""
    table = part["table"]
    beside = tables.Cells(table, [*tables.load(tables.THESIS), part])
    lines = [f"Table {table}: " + ", ".join(f"{name} {value:g}" for name, value in part["parameters"].items())]
    for kind in tables.KINDS[table]:
        lines += report_of_kind(beside, part["source"], kind)
    return "\n".join(lines)


def report_of_kind(table, source, kind):
    thesis, deviations, regrets = table.cells_of("thesis", kind), table.deviations(source, kind), table.regrets(source, kind)
    medians = [f"{name} {100 * statistics.median(map(abs, baselines.errors(predicted, thesis).values())):.1f} %"
               for name, predicted in baselines.predictions(table, kind, [source]).items()]
    yield f"  {kind}s, median errors but for {baselines.COLUMN} nodes: " + ", ".join(medians)
    for row in table.rows(kind):
        errors = "  ".join(f"{nodes}: {100 * error:+.0f}" for (of, nodes), error in deviations.items() if of == row)
        yield (f"    {row:>7}  {errors}   best at {table.best_nodes(source, row, kind)}, measured there "
               f"{100 * regrets[row]:+.0f} % of the least")


def main():
    parser = argparse.ArgumentParser(prog="mars bench machine1992", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("file", help="for `mars bench tables --beside`")
    parser.add_argument("--tables", default=",".join(sorted(tables.TITLES)), help="4.1 and others; default all")
    wanted = parser.parse_args()
    measured = measured_cells()
    with tempfile.TemporaryDirectory(prefix="machine1992-") as folder:
        names = sorted({"4.1", *wanted.tables.split(",")})
        parts = simulate(Simulator(wanted.build, folder), names, measured)
    with open(wanted.file, "w") as file:
        file.write(tables.text_of([*parts, choices.sheet()]))
    for part in parts:
        if "cells" in part:
            print(report(part))


if __name__ == "__main__":
    main()
