#!/usr/bin/env python3
"""What else the 1992 program may have done, fitted on table 4.1: assumptions.py --build BUILD. Prints, for each
assumption, the fitted parameters and the median errors of keyframes and inbetweens (replayed, not simulated)."""
import argparse
import statistics
import tempfile

import fit
import replay
import simulate


class Sending:
    """A film's jobs if inbetweens send another part of the MFB."""

    def __init__(self, scaled, part):
        self.scaled, self.part = scaled, part

    def at(self, scale):
        job = self.scaled.at(scale)
        job.values = {**job.values, "moving": job.values["moving_" + self.part]}
        return job


def line(name, cells, found):
    errors = abs(cells.times(fit.costs_of(found), found["scale"]) / cells.ms - 1)
    medians = [100 * statistics.median(error for error, cell in zip(errors, cells.cells) if cell[1] == kind)
               for kind in ("keyframe", "inbetween")]
    values = [f"{found['speed']:.2f}", f"{found['host_byte'] * 1e6:.2f}", f"{found['host_message'] * 1e3:.1f}",
              f"{found['depth'] * 1e6:.2f}", f"{found['scale']:.3f}", *(f"{median:.1f}" for median in medians)]
    return f"| {name} | " + " | ".join(values) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True)
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
        others = {row: {nodes: Sending(scaled, part) for nodes, scaled in jobs.items()} for row, jobs in films.items()}
        sending = fit.Cells(measured, others, network)
        print(line(f"of an inbetween's MFB: {part}", sending, fit.fit_costs(sending)))
    print(line("figures fill the picture", cells, fit.fit_from(cells, {**fit.FIRST, "scale": 1.0}, ["scale"])))


if __name__ == "__main__":
    main()
