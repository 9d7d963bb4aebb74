#!/usr/bin/env python3
"""MARS itself on the machine that simulate.py has fitted: mars bench
machine1992-product SIMULATED FILE.

Renders the same films with `mars render --backend simulated`, in pictures of
the same size, and writes FILE with the cells' times (source simulated-product).
Inbetweens: of 20 a node. What work costs are the clocks of costs.py for MARS's
own algorithms; the network, the host's link and cost a message are those of
SIMULATED, which simulate.py wrote."""
import argparse
import json
import os
import subprocess
import tempfile

import costs
import replay
import simulate

INBETWEENS_A_NODE = 20
# Of node/wire/work.h. What is missing costs nothing: NX gives memory that is not cleared (fresh_byte), the 80386 is charged
# without waits for memory (first_frame), and a strip costs the host what its message does (host_strip).
OPERATIONS = {
    "frame": {"move": 4 * 480, "step": 480},  # counts of its lines to nothing
    "segment": {"multiply": 36, "add": 27, "load": 36, "store": 12},
    "patch": {"multiply": 72, "add": 72, "load": 24, "compare": 12},  # eight corners of its box
    "meshlet": {"multiply": 72, "add": 72, "load": 24, "compare": 12},
    "vertex": costs.OPERATIONS["vertex"],
    "mesh_vertex": costs.OPERATIONS["vertex"],
    "net_term": {"multiply": 2, "add": 2, "load": 4, "store": 2},  # neighbours share about half of a patch's points
    "skin_weight": {"multiply": 12, "add": 12, "load": 24, "store": 12},
    # Eight numbers, turned to the side of the first bone's; and of three bones' blend, a unit and a matrix.
    "dual_weight": {"multiply": 22, "add": 20, "root": 0.3, "divide": 0.3, "compare": 1, "load": 28, "store": 12},
    "triangle_tested": costs.OPERATIONS["polygon"],
    "row_tested": {"move": 6, "step": 2},  # first and last row between its corners, as integers
    # Planes of 4 values: two steps each, by one division.
    "triangle": {"multiply": 22, "add": 21, "divide": 1, "load": 20, "store": 12, "move": 8},
    "edge_box_made": {"add": 2, "load": 2, "store": 2, "integer": 2, "move": 6, "step": 2},  # columns alone
    # As `light`, with the normal and the way to the eye made units.
    "vertex_light": {"multiply": 28, "add": 16, "root": 2, "divide": 2, "compare": 2, "load": 14, "store": 11},
    "edge_box_filled": {"move": 6, "step": 2},
    "line_mapped": costs.OPERATIONS["line"],
    "line": {"move": 512},  # depths and triangles of half a line to nothing, by REP STOS
    "edge_box": {"multiply": 2, "add": 2, "load": 4, "store": 2, "move": 6, "step": 2},
    "sample": {"multiply": 1, "add": 1, "load": 1, "store": 1, "compare": 1, "step": 1},  # depth alone
    # The normal from its planes and the place from the depth, both made units; bytes.
    "shaded": {"multiply": 23, "add": 15, "root": 2, "divide": 2, "integer": 3, "compare": 3, "load": 12, "store": 10,
               "move": 8, "step": 1},
    "light": {"multiply": 16, "add": 10, "compare": 2, "load": 8, "store": 5},
    # Cook and Torrance: the half-way vector, distribution, shadowing, and Fresnel's reflection of three colours.
    "facet_light": {"multiply": 40, "add": 28, "root": 2, "divide": 4, "compare": 4, "load": 20, "store": 14},
    "pixel": {"move": 2, "step": 1},
    "still_byte": {"move": 0.5, "step": 0.25},
    "casting_light": {"multiply": 6, "add": 3, "load": 12, "store": 6},  # times its colour, then times what arrives
    # The place from the depth, then on the grid.
    "shadow_point": {"multiply": 12, "add": 10, "divide": 1, "integer": 2, "load": 18, "store": 6, "compare": 2},
    "caster": {"multiply": 192, "add": 144, "load": 64, "compare": 96},  # control points, and their box on the grid
    "diced_vertex": costs.OPERATIONS["vertex"],
    "caster_vertex": {"multiply": 9, "add": 6, "integer": 2, "load": 12, "store": 3, "compare": 6},
    # Three edges, a plane by one division, and the points of a row or two.
    "caster_triangle": {"multiply": 16, "add": 24, "divide": 1, "load": 24, "store": 12, "compare": 18, "move": 12,
                        "step": 3},
    "host_run": {"move": 12, "step": 2},
    "host_byte": {"move": 0.5, "step": 0.25},
    "host_restored": {"move": 0.5, "step": 0.25},
    "host_frame": {"move": 960, "step": 960},  # flags of its blocks
}


def platform_of(parameters):
    """The iPSC/2 with fitted costs, as its platform file has it. As for the 1992 program, a message of up to 100 bytes costs
    the host nothing."""
    with open(replay.IPSC2) as file:
        platform = json.load(file)
    platform["network"] |= {"host_rate": 1 / parameters["host_byte"],
                            "host_end": [[0, 0], [101, parameters["host_message"]]]}
    platform["work"] |= {work: seconds_of(operations, parameters["speed"]) for work, operations in OPERATIONS.items()}
    return platform


def seconds_of(operations, speed):
    clocks = sum(costs.CLOCKS[name] * count for name, count in operations.items())
    return float(f"{speed * clocks / costs.HERTZ:.4g}")


class Product:
    def __init__(self, build, folder, platform):
        self.mars, self.folder = os.path.join(build, "bin", "mars"), folder
        self.platform = os.path.join(folder, "platform.json")
        with open(self.platform, "w") as file:
            json.dump(platform, file)

    def frames(self, film, nodes, count):
        """Of the report: the first `count` of a film."""
        report = os.path.join(self.folder, f"report-{os.path.basename(film)}-{nodes}")
        subprocess.run([self.mars, "render", film, "--backend", "simulated", "--platform", self.platform, "--nodes",
                        str(nodes), "--groups", "1", "--frames", f"0-{count - 1}", "--sink", "none", "--quiet",
                        "--report", report], check=True, capture_output=True, text=True)
        with open(report) as file:
            return json.load(file)["frames"]

    def seconds(self, film, nodes, with_inbetweens):
        """By kind, of a frame."""
        inbetweens = INBETWEENS_A_NODE * nodes if with_inbetweens else 1
        keyframe, *others = self.frames(film, nodes, 1 + inbetweens)
        found = {"keyframe": max([keyframe["seconds"], *(sum(node["seconds"].values()) for node in keyframe["nodes"])])}
        if with_inbetweens:
            found["inbetween"] = (max(frame["seconds"] for frame in others) - found["keyframe"]) / inbetweens
        return found


def cells_of(product, table, measured, scale, folder):
    with_inbetweens = "inbetween" in simulate.tables.KINDS[table]
    most = INBETWEENS_A_NODE * max(cell[2] for cell in measured)
    names = {f"{table}-{row}" for row in simulate.rows_of(measured)}
    simulate.write_films(simulate.scenes.Cut(1, most), scale, names, folder)

    def times(place):
        row, nodes = place
        seconds = product.seconds(os.path.join(folder, f"{table}-{row}.json"), nodes, with_inbetweens)
        return [{"row": row, "kind": kind, "nodes": nodes, "ms": round(1000 * of, 1)} for kind, of in seconds.items()]
    places = sorted({(row, nodes) for row, _, nodes, _ in measured})
    return [cell for cells in simulate.in_pairs(times, places) for cell in cells]


def main():
    parser = argparse.ArgumentParser(prog="mars bench machine1992-product", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("simulated", help="of mars bench machine1992")
    parser.add_argument("file", help="for `mars bench tables --beside`")
    wanted = parser.parse_args()
    measured, parts = simulate.measured_cells(), []
    simulated = [part for part in simulate.tables.load(wanted.simulated) if "cells" in part]
    costs_there = next(part["parameters"] for part in simulated if part["table"] == "4.1")
    with tempfile.TemporaryDirectory(prefix="machine1992-") as folder:
        product = Product(wanted.build, folder, platform_of(costs_there))
        for part in simulated:
            table = part["table"]
            cells = cells_of(product, table, measured[table], part["parameters"][f"scale of {table}"], folder)
            parts.append({"table": table, "source": "simulated-product", "cells": cells})
    with open(wanted.file, "w") as file:
        file.write(simulate.tables.text_of(parts))


if __name__ == "__main__":
    main()
