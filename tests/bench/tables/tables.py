#!/usr/bin/env python3
"""The tables and figures of 1992's thesis (chapter 4), measured on this machine, beside the thesis's own numbers and
those of other sources. It writes tables.md, tables.html, cells.json (what was measured) and pictures into a folder.

With more nodes than cores, times on the wall say little about a machine with so many cores: "own work" says what the
slowest node computes, without waiting and messages. README.md beside this program tells more."""
import argparse
import os
import platform
import sys
import tempfile

import cells
import measure
import page
import pictures
import runs
import studies

STUDIES = ["positions", "patches", "mappings", "blocks"]
QUICK_ROWS = {"4.1": [1300, 3900], "4.2": [1300, 10400], "4.3": [5200, 27664], "4.4": [2, 4]}


def measured_tables(wanted, machine, folder):
    """The cells of all tables, in rounds over all of them."""
    many, few = os.path.join(folder, "many"), os.path.join(folder, "few")
    tables = [table for table in wanted.parts if table in cells.TITLES]
    if not tables:
        return []
    measure.write_films(many, 3 if wanted.quick else 5, 32 if wanted.quick else 128)
    measure.write_films(few, 3 if wanted.quick else 9, 8)
    found = [measure.Table(table, machine, many if "inbetween" in cells.KINDS[table] else few, wanted.nodes,
                           QUICK_ROWS[table] if wanted.quick else None) for table in tables]
    for _ in range(wanted.rounds):
        for table in found:
            table.measure_round()
    return [part for table in found for part in table.sources()]


def studied(wanted, machine, folder):
    """The other comparisons of chapter 4, as tables for a person."""
    measure.write_films(folder, 3, 32)
    blocks = os.path.join(wanted.build, "bench", "tables", "bench-blocks")
    films = ["4.2-10400"] if wanted.quick else ["4.2-10400", "4.3-165944"]
    makers = {"positions": lambda: studies.positioning(machine, folder, [n for n in wanted.nodes if n <= 8]),
              "patches": lambda: studies.distribution(machine, folder, wanted.nodes),
              "mappings": lambda: studies.mappings(machine, folder, wanted.nodes, films),
              "blocks": lambda: studies.blocks(machine, folder, blocks, ["4.2-1300", "4.2-5200", "4.2-10400"])}
    return [makers[part]() for part in wanted.parts if part in STUDIES]


def about(wanted):
    return (f"Milliseconds of this machine: {platform.node()}, {platform.machine()}, {len(os.sched_getaffinity(0))} cores; "
            f"backend {wanted.backend}, {wanted.rounds} rounds. \"best\" and \"median\" are times on the wall; with more nodes "
            "than cores they say how well so many nodes share these cores. \"own work\" is what the slowest node computes, "
            "without waiting and messages: a lower bound for a machine with a core for each node. 512x480 pixels, data "
            "size read as polygons.")


def write(path, text):
    with open(path, "w") as file:
        file.write(text)


def write_results(wanted, measured, sheets):
    parts = cells.load(cells.THESIS) + measured + [part for file in wanted.beside for part in cells.load(file)]
    drawn = pictures.all_pictures(parts)
    os.makedirs(wanted.output, exist_ok=True)
    for name, _, svg in drawn:
        write(os.path.join(wanted.output, name + ".svg"), svg)
    sheets = page.sheets_of(parts) + sheets + page.parameters_of(parts)
    text = page.markdown(about(wanted), sheets, [(title, name + ".svg") for name, title, _ in drawn])
    write(os.path.join(wanted.output, "tables.md"), text)
    write(os.path.join(wanted.output, "tables.html"), page.page(about(wanted), sheets, [drawing[1:] for drawing in drawn]))
    if measured:
        write(os.path.join(wanted.output, "cells.json"), cells.text_of(measured))
    print(text)
    print(f"{wanted.output}/tables.html shows this with pictures.")


def read_command_line():
    parts = [*cells.TITLES, *STUDIES]
    parser = argparse.ArgumentParser(prog="mars bench tables", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"what to measure: {', '.join(parts)}, or none; default: all")
    parser.add_argument("--nodes", default="1,2,4,8,16,32", type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--backend", default="threads", choices=["threads", "mpi"], help="default: threads")
    parser.add_argument("--rounds", type=int, default=3, help="over all tables; default: 3")
    parser.add_argument("--quick", action="store_true", help="a few rows, one round, at most 4 nodes: seconds")
    parser.add_argument("--beside", nargs="+", default=[], metavar="FILE", help="cells of other sources to show as well")
    parser.add_argument("-o", "--output", default="tables", metavar="FOLDER", help="default: tables")
    wanted = parser.parse_args()
    if unknown := set(wanted.parts) - {*parts, "none"}:
        parser.error(f"there is no part {', '.join(sorted(unknown))}; those here: {', '.join(parts)}")
    wanted.parts = [part for part in parts if part in wanted.parts] if wanted.parts else parts
    if wanted.quick:
        wanted.rounds, wanted.nodes = 1, [nodes for nodes in wanted.nodes if nodes <= 4]
    return wanted


def main():
    wanted = read_command_line()
    pictures.needed()
    with tempfile.TemporaryDirectory() as folder:
        machine = runs.Machine(wanted.build, wanted.backend, folder)
        measured = measured_tables(wanted, machine, folder)
        write_results(wanted, measured, studied(wanted, machine, folder))


if __name__ == "__main__":
    try:
        main()
    except cells.Trouble as trouble:
        sys.exit(f"mars bench tables: {trouble}")
