#!/usr/bin/env python3
"""The tables and figures of 1992's thesis (chapter 4), measured on this machine,
beside the thesis's own numbers and those of other sources. It writes a page of
Markdown for each table, tables.md, which links to these pages, tables.html,
results.json (what was measured) and pictures into a folder.

If there are more nodes than cores, wall-clock times show how the nodes share the
cores. "own work" is the computing time of the slowest node, without waiting and
messages. README.md beside this program explains the times."""
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
    measure.write_films(many, ["4.1", "4.2"], *((3, 32) if wanted.quick else (5, 128)))
    measure.write_films(few, ["4.3", "4.4"], 8, 8)
    found = []
    for table in tables:
        with_inbetweens = "inbetween" in cells.KINDS[table]
        found += [measure.Table(table, machine, many if with_inbetweens else few, wanted.nodes,
                                QUICK_ROWS[table] if wanted.quick else None, of_patches)
                  for of_patches in ([False, True] if with_inbetweens else [False])]
    for number in range(wanted.rounds):
        for table in found:
            print(f"round {number + 1} of {wanted.rounds}: table {table.table}", file=sys.stderr)
            table.measure_round()
    parameters = {"machine": f"{platform.node()}, {len(os.sched_getaffinity(0))} cores", "backend": wanted.backend,
                  "rounds": wanted.rounds}
    return [part for table in found for part in table.sources(parameters)]


def studied(wanted, machine, folder):
    """The other comparisons of chapter 4, as tables for a person."""
    measure.write_films(folder, ["4.2", "4.3"], 3, 32)
    blocks = os.path.join(wanted.build, "bench", "tables", "bench-blocks")
    mapped = ["4.2-10400"] if wanted.quick else ["4.2-10400", "4.3-165944"]
    composed = ["4.2-5200"] if wanted.quick else ["4.2-1300", "4.2-5200", "4.2-10400"]
    few = [nodes for nodes in wanted.nodes if nodes <= 8]
    study = studies.Study(machine, folder, wanted.rounds)
    makers = {"positions": lambda: study.positioning(few), "patches": lambda: study.distribution(wanted.nodes),
              "mappings": lambda: study.mappings(wanted.nodes, mapped),
              "blocks": lambda: study.blocks(blocks, composed)}
    return [makers[part]() for part in wanted.parts if part in STUDIES]


ABOUT = ("The benchmark takes the thesis's \"data size\" as a number of polygons. Pictures have 512x480 pixels. "
         "\"here, best\" and \"here, median\" are wall-clock times; if there are more nodes than cores, they show how "
         "the nodes share the cores. \"here, own work\" is the computing time of the slowest node, without waiting and "
         "messages: a lower bound of the time on a machine with a core for each node. \"simulated-thesis\" is a "
         "simulation of the thesis's program; the percentages say by how much its cells differ from the thesis's.")


def beside_thesis(found):
    """The thesis's cells and those of `found`."""
    return cells.load(cells.THESIS) + [part for part in found if "cells" in part]


def sheets_beside_thesis(found):
    """All tables of the page. `found`: objects of files of results."""
    parts = beside_thesis(found)
    return page.sheets_of(parts) + [part for part in found if "rows" in part] + page.parameters_of(parts)


def write_results(wanted, measured):
    """`measured`: objects of a file of results."""
    found = measured + [part for file in wanted.beside for part in cells.load(file)]
    sheets, drawn = sheets_beside_thesis(found), pictures.all_pictures(beside_thesis(found))
    if pictures.pyplot is None:
        print("mars bench tables: no pictures, as Python's matplotlib is missing (./bootstrap bench)", file=sys.stderr)
    os.makedirs(wanted.output, exist_ok=True)
    files = {name + ".svg": svg for name, svg in drawn.items()}
    pages = page.markdown_pages(ABOUT, sheets, drawn)
    files |= pages
    files["tables.html"] = page.page(ABOUT, sheets, drawn)
    if measured:
        files["results.json"] = cells.text_of(measured)
    for name, text in files.items():
        with open(os.path.join(wanted.output, name), "w") as file:
            file.write(text)
    print("\n".join(pages.values()) + f"\n{wanted.output}/tables.html shows the tables with pictures.")


def read_command_line():
    parts = [*cells.TITLES, *STUDIES]
    parser = argparse.ArgumentParser(prog="mars bench tables", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("parts", nargs="*", metavar="PART",
                        help=f"what to measure: {', '.join(parts)}, or none; default: all")
    parser.add_argument("--nodes", default="1,2,4,8,16,32", type=lambda text: [int(n) for n in text.split(",")],
                        help="default: 1,2,4,8,16,32, as in the thesis and one")
    parser.add_argument("--backend", default="threads", choices=["threads", "mpi"], help="default: threads")
    parser.add_argument("--rounds", type=int, default=3, help="over all tables; default: 3")
    parser.add_argument("--quick", action="store_true", help="a few rows, one round, at most 4 nodes: seconds")
    parser.add_argument("--beside", nargs="+", default=[], metavar="FILE",
                        help="results of other sources or earlier runs, to show as well")
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
    with tempfile.TemporaryDirectory() as folder:
        machine = runs.Machine(wanted.build, wanted.backend, folder)
        write_results(wanted, measured_tables(wanted, machine, folder) + studied(wanted, machine, folder))


if __name__ == "__main__":
    try:
        main()
    except cells.Trouble as trouble:
        sys.exit(f"mars bench tables: {trouble}")
