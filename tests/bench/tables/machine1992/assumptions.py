#!/usr/bin/env python3
"""What else the 1992 program may have done, fitted on table 4.1: mars bench
machine1992-assumptions. Prints, for each assumption, the fitted parameters and
the median errors of keyframes and inbetweens (replayed, not simulated)."""
import argparse
import copy
import statistics
import tempfile

import fit
import replay
import simulate


def sending(job, part):
    """The job if inbetweens send another part of the MFB."""
    other = copy.copy(job)
    other.values = {**job.values, "moving": job.values["moving_" + part]}
    return other


def line(name, cells, found):
    errors = abs(cells.times(fit.costs_of(found), found["scale"]) / cells.ms - 1)
    medians = [100 * statistics.median(error for error, cell in zip(errors, cells.cells) if cell[1] == kind)
               for kind in ("keyframe", "inbetween")]
    values = [f"{found['speed']:.2f}", f"{found['host_byte'] * 1e6:.2f}", f"{found['host_message'] * 1e3:.1f}",
              f"{found['depth'] * 1e6:.2f}", f"{found['scale']:.3f}", *(f"{median:.1f}" for median in medians)]
    return f"| {name} | " + " | ".join(values) + " |"


def main():
    parser = argparse.ArgumentParser(prog="mars bench machine1992-assumptions", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    build = parser.parse_args().build
    measured = simulate.measured_cells()["4.1"]
    with tempfile.TemporaryDirectory(prefix="machine1992-") as folder:
        rows = simulate.rows_of(measured)
        simulator = simulate.Simulator(build, folder, [f"4.1-{row}" for row in rows])
        films = {row: simulator.record("4.1", row, measured) for row in rows}
    print("| assumption | speed | host, us a byte | host, ms a message | us a depth | scale | keyframes, % | inbetweens, % |\n"
          "|:--|--:|--:|--:|--:|--:|--:|--:|")
    network = replay.Network()
    cells = fit.Cells(measured, films, network)
    print(line("as simulated: of an inbetween's MFB the box round what was drawn", cells, fit.fit_costs(cells)))
    for part in ("whole", "lines", "pixels"):
        others = {row: {nodes: {scale: sending(job, part) for scale, job in jobs.items()} for nodes, jobs in of.items()}
                  for row, of in films.items()}
        other = fit.Cells(measured, others, network)
        print(line(f"of an inbetween's MFB: {part}", other, fit.fit_costs(other)))
    print(line("figures fill the picture", cells, fit.fit_costs(cells, [1.0])))


if __name__ == "__main__":
    main()
