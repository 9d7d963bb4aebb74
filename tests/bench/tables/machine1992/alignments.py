#!/usr/bin/env python3
"""Table 4.4 by the models of docs/1992/alignments.md: mars bench
machine1992-alignments SIMULATED. Costs are those of SIMULATED, which simulate.py
wrote; the scale of the figures is fitted on the column of 8 nodes. Prints the
spread of the five films, greatest over least less one, by nodes."""
import argparse
import math
import tempfile

import fit
import replay
import simulate
from simulate import scenes, tables

TABLE = "4.4"
IN_CUBE = 0.7  # rings to sides of a ring, so that sides of polygons are about as long along as around in the unit cube
LEANING = {1: 45, 2: 0, 3: 30, 4: 90, 5: 20}  # of the line of bodies in each film, from upright, in degrees


def stretched(_):
    return IN_CUBE


def in_cells(number, cut, shape_of):
    return scenes.table_44(number, cut, 1.0, shape_of)


def along_a_line(number, cut, shape_of):
    """Six bodies head to foot on one line, which is turned as a whole."""
    models, bodies = scenes.company(scenes.ALIGNED_SIZE, 3 * scenes.CELL, shape_of)
    lean = math.radians(LEANING[number])
    reach = 3 * scenes.CELL
    steps = [scenes.CELL * (k - 2.5) for k in range(6)]
    places = [[step * math.sin(lean), 0, step * math.cos(lean)] for step in steps]
    film = scenes.of_bodies(models, bodies, places, [LEANING[number]] * 6, cut, [[0, 0, -reach], [0, 0, 0]], 1.0)
    return {**film, "camera": scenes.camera(scenes.corners([[-reach, -0.3, -reach], [reach, 0.3, reach]], [0, 0, 0]), 1.0)}


MODELS = {"A, crossings": (in_cells, scenes.figures.slender), "B, stretched": (in_cells, stretched),
          "C, along a line": (along_a_line, stretched)}


def simulated(build, folder, model, costs, measured):
    """The fitted scale and the times of the cells."""
    film, shape_of = MODELS[model]
    simulator = simulate.Simulator(build, folder, [])
    cut = scenes.Cut(2, simulate.INBETWEENS)
    scenes.write({f"{TABLE}-{row}": film(row, cut, shape_of) for row in simulate.rows_of(measured)}, folder)
    films = {row: simulator.record(TABLE, row, measured) for row in simulate.rows_of(measured)}
    cells = fit.Cells(measured, films, replay.Network())
    found, times = simulate.best_fit(simulator, TABLE, cells, lambda of: {
        **costs, "scale": fit.fit_scale(of, fit.costs_of(costs))}, fit.in_column)
    return found["scale"], times


def spreads(measured, times):
    """By nodes: greatest over least, less one."""
    columns = {}
    for (_, _, nodes, _), ms in zip(measured, times):
        columns.setdefault(nodes, []).append(ms)
    return {nodes: max(ms) / min(ms) - 1 for nodes, ms in columns.items()}


def line(name, scale, measured, times):
    fields = [f"{100 * spread:.1f} %" for spread in spreads(measured, times).values()]
    return f"| {name} | {scale} | " + " | ".join(fields) + " |"


def main():
    parser = argparse.ArgumentParser(prog="mars bench machine1992-alignments", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("simulated", help="of mars bench machine1992")
    wanted = parser.parse_args()
    measured = simulate.measured_cells()[TABLE]
    costs = tables.load(wanted.simulated)[0]["parameters"]
    nodes = list(spreads(measured, [1.0] * len(measured)))
    print("| model | scale | " + " | ".join(f"P = {n}" for n in nodes) + " |\n|:--|--:|" + "--:|" * len(nodes))
    print(line("thesis", "", measured, [cell[3] for cell in measured]))
    for model in MODELS:
        with tempfile.TemporaryDirectory(prefix="machine1992-") as folder:
            scale, times = simulated(wanted.build, folder, model, costs, measured)
        print(line(model, scale, measured, times), flush=True)


if __name__ == "__main__":
    main()
