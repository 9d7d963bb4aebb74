"""Cells of 1992's tables from any source: the thesis, this machine, simulations.

A file of results has objects
  {"table": "4.1", "source": "thesis", "cells": [{"row": 1300, "kind": "keyframe", "nodes": 2, "ms": 2449}, ...]},
alone or in a list. row: polygons that move (4.1, 4.2), all polygons (4.3) or the film's number (4.4); kind: keyframe,
or inbetween: milliseconds a frame at the nodes' throughput. "parameters" may say how they came about. Objects with a
title, note, header and rows are further tables, shown as they are."""
import json
import os
import statistics

HERE = os.path.dirname(os.path.abspath(__file__))
THESIS = os.path.join(HERE, "thesis.json")
TITLES = {"4.1": "3900 polygons in 3 segments", "4.2": "10,400 polygons in 8 segments",
          "4.3": "keyframes of different sizes", "4.4": "27,664 polygons, 2 segments moving, differently aligned"}
ROWS = {"4.1": "moving polygons", "4.2": "moving polygons", "4.3": "polygons", "4.4": "film"}
KINDS = {"4.1": ["keyframe", "inbetween"], "4.2": ["keyframe", "inbetween"], "4.3": ["keyframe"], "4.4": ["keyframe"]}


class Trouble(Exception):
    """Something that ends the benchmark; its text is for a person."""


CELLS, SHEET = {"table", "source", "cells"}, {"title", "note", "header", "rows"}


def load(path):
    """The objects of a file, in a list."""
    try:
        with open(path) as file:
            found = json.load(file)
    except (OSError, json.JSONDecodeError) as error:
        raise Trouble(f"{path}: cannot be read: {error}") from error
    found = found if isinstance(found, list) else [found]
    for number, part in enumerate(found):
        if not (SHEET <= part.keys() or (CELLS <= part.keys() and part["table"] in TITLES)):
            raise Trouble(f"{path}: object {number} is none of cells ({', '.join(sorted(CELLS))}: one of "
                          f"{', '.join(TITLES)}) and no table ({', '.join(sorted(SHEET))})")
    return found


def text_of(parts):
    """As a file, a cell or a row on each line."""
    def part_text(part):
        long = "cells" if "cells" in part else "rows"
        rest = {key: value for key, value in part.items() if key != long}
        lines = ",\n".join("   " + json.dumps(line) for line in part[long])
        return f'{json.dumps(rest)[:-1]}, "{long}": [\n{lines}\n ]}}'
    return "[\n " + ",\n ".join(map(part_text, parts)) + "\n]\n"


def beside_thesis(parts):
    """The tables that any source but the thesis has."""
    return [table for table in TITLES if any(part["table"] == table and part["source"] != "thesis" for part in parts)]


class Cells:
    """All sources of one table; the thesis first, the others in their files' order."""

    def __init__(self, table, parts):
        self.table = table
        self.sources = {"thesis": {}}
        for part in parts:
            if part["table"] == table:
                of = self.sources.setdefault(part["source"], {})
                of |= {(cell["row"], cell["kind"], cell["nodes"]): cell["ms"] for cell in part["cells"]}

    def cells_of(self, source, kind):
        """Milliseconds by row and nodes."""
        return {(row, nodes): ms for (row, k, nodes), ms in self.sources[source].items() if k == kind}

    def ms(self, source, row, kind, nodes):
        return self.sources[source].get((row, kind, nodes))

    def rows(self, kind):
        return sorted({row for of in self.sources.values() for row, k, _ in of if k == kind})

    def nodes(self, kind):
        return sorted({nodes for of in self.sources.values() for _, k, nodes in of if k == kind})

    def nodes_of(self, source, kind):
        return sorted({nodes for _, nodes in self.cells_of(source, kind)})

    def best_nodes(self, source, row, kind):
        """The number of nodes that takes least; None if it has no cell there."""
        of = {nodes: ms for (r, nodes), ms in self.cells_of(source, kind).items() if r == row}
        return min(of, key=of.get) if of else None

    def deviations(self, source, kind):
        """(source - thesis) / thesis of each cell that both have, by row and nodes."""
        thesis = self.cells_of("thesis", kind)
        return {cell: ms / thesis[cell] - 1 for cell, ms in self.cells_of(source, kind).items() if cell in thesis}

    def median_error(self, source, kind):
        errors = [abs(deviation) for deviation in self.deviations(source, kind).values()]
        return statistics.median(errors) if errors else None

    def regrets(self, source, kind):
        """Of each row: by how much the thesis's time with the source's best number of nodes exceeds its least time; of
        the numbers of nodes that both have."""
        rows = {}
        for row, nodes in self.deviations(source, kind):
            rows.setdefault(row, []).append(nodes)
        found = {}
        for row, both in rows.items():
            chosen = min(both, key=lambda nodes: self.ms(source, row, kind, nodes))
            found[row] = self.ms("thesis", row, kind, chosen) / min(self.ms("thesis", row, kind, n) for n in both) - 1
        return found
