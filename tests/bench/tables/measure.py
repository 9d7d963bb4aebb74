"""The cells of 1992's tables on this machine."""
import os
import statistics

import cells
import runs
import scenes

BEST, MEDIAN, BUSY = "here, best", "here, median", "here, own work"


def rows_of(table):
    thesis = next(part for part in cells.load(cells.THESIS) if part["table"] == table)
    return sorted({cell["row"] for cell in thesis["cells"]})


class Table:
    """Measures one table, a round at a time, so that rounds of all cells interleave. `of_patches`: its films of Bezier
    patches instead of meshes."""

    def __init__(self, table, machine, films, nodes, rows=None, of_patches=False):
        self.table, self.machine, self.films, self.nodes, self.of_patches = table, machine, films, nodes, of_patches
        self.rows = rows or rows_of(table)
        self.found = {}  # by row, kind and nodes: milliseconds on the wall of each round, and of own work

    def measure_round(self):
        for row in self.rows:
            for nodes in self.nodes:
                self.measure(row, nodes)

    def measure(self, row, nodes):
        name = f"{self.table}-{row}" + ("-patches" if self.of_patches else "")
        film = os.path.join(self.films, name + ".json")
        frames, scratch = self.machine.render(film, nodes), self.machine.render(film, nodes, *runs.SCRATCH)
        own = runs.busy_of_keyframe(runs.keyframes(frames))
        self.add((row, "keyframe", nodes), runs.wall_from_scratch(scratch), own)
        if "inbetween" in cells.KINDS[self.table]:
            self.add((row, "inbetween", nodes), runs.wall_of_inbetweens(frames), runs.busy_of_inbetweens(frames, nodes))

    def add(self, key, wall, busy):
        walls, busies = self.found.setdefault(key, ([], []))
        walls.append(wall)
        busies.append(busy)

    def sources(self, parameters):
        """As a file of results has them."""
        def part(source, value):
            found = [{"row": row, "kind": kind, "nodes": nodes, "ms": round(value(*lists), 4)}
                     for (row, kind, nodes), lists in sorted(self.found.items())]
            return {"table": self.table, "source": source, "parameters": parameters, "cells": found}
        if self.of_patches:
            return [part(BUSY + ", patches", lambda walls, busy: min(busy))]
        return [part(BEST, lambda walls, busy: min(walls)), part(MEDIAN, lambda walls, busy: statistics.median(walls)),
                part(BUSY, lambda walls, busy: min(busy))]


def write_films(folder, tables, intervals, inbetweens):
    """The films of `tables`, with `intervals` intervals of a keyframe and `inbetweens` inbetweens."""
    films = scenes.all_films(scenes.Cut(intervals, inbetweens))
    scenes.write({name: film for name, film in films.items() if name.startswith(tuple(tables))}, folder)
