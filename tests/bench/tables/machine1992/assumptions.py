#!/usr/bin/env python3
"""What else the 1992 program may have done, fitted on table 4.1: mars bench
machine1992-assumptions. Prints, for each assumption, the fitted parameters, the
median errors of table 4.1's keyframes and inbetweens, and those of table 4.2's
inbetweens, whose scale is fitted on 8 nodes: the median, and the mean of 16 and
of 32 nodes (replayed, not simulated)."""
import argparse
import copy
import statistics
import tempfile

import fit
import replay
import simulate

TABLES = ["4.1", "4.2"]


def with_values(job, **values):
    other = copy.copy(job)
    other.values = {**job.values, **values}
    return other


def sending(part):
    """Inbetweens send another part of the MFB."""
    return lambda job: with_values(job, moving=job.values["moving_" + part])


def free_pixels(job):
    """An inbetween's pixels cost the host nothing, on its link or to write: a message and the flags are left."""
    host = job.host.copy()
    host[1:] = 0
    host[1:, simulate.WORKS.index("look")] = replay.FLAGS
    return with_values(job, moving=0 * job.moving, host=host)


def as_simulated(job):
    return job


# By name: what becomes of a job, inbetweens of an interval (None: as many as nodes), and scales (None: all).
ASSUMPTIONS = {
    "as simulated: of an inbetween's MFB the box round what was drawn": (as_simulated, None, None),
    **{f"of an inbetween's MFB: {part}": (sending(part), None, None) for part in ("whole", "lines", "pixels")},
    "figures fill the picture": (as_simulated, None, [1.0]),
    **{f"intervals of {count} inbetweens": (as_simulated, count, None) for count in (32, 64, 128)},
    "an inbetween's pixels cost the host nothing": (free_pixels, None, None),
}


def cells_of(table, measured, films, assumption):
    change, inbetweens, _ = assumption
    changed = {row: {nodes: {scale: change(job) for scale, job in jobs.items()} for nodes, jobs in of.items()}
               for row, of in films.items()}
    return fit.Cells(measured[table], changed, replay.Network(), inbetweens)


def missed(cells, found, kind, nodes):
    """Relative errors of the kind's cells on one of `nodes`."""
    errors = cells.times(fit.costs_of(found), found["scale"]) / cells.ms - 1
    return [float(error) for error, cell in zip(errors, cells.cells) if cell[1] == kind and cell[2] in nodes]


def middle(errors):
    return f"{100 * statistics.median(map(abs, errors)):.1f}"


def mean(errors):
    return f"{100 * statistics.mean(errors):+.0f}"


def line(name, measured, films):
    """The assumption, fitted."""
    assumption = ASSUMPTIONS[name]
    arm, man = (cells_of(table, measured, films[table], assumption) for table in TABLES)
    found = fit.fit_costs(arm, assumption[2])
    of_man = {**found, "scale": fit.fit_scale(man, fit.costs_of(found))}
    every = [2, 4, 8, 16, 32]
    fields = [f"{found['speed']:.2f}", f"{found['host_byte'] * 1e6:.2f}", f"{found['host_message'] * 1e3:.1f}",
              f"{found['depth'] * 1e6:.2f}", f"{found['scale']:.3f}",
              *(middle(missed(arm, found, kind, every)) for kind in ("keyframe", "inbetween")),
              middle(missed(man, of_man, "inbetween", [2, 4, 16, 32])),
              *(mean(missed(man, of_man, "inbetween", [nodes])) for nodes in (16, 32))]
    return f"| {name} | " + " | ".join(fields) + " |"


def records_of(build, measured):
    """By table and row, what the films take."""
    with tempfile.TemporaryDirectory(prefix="machine1992-") as folder:
        names = [f"{table}-{row}" for table in TABLES for row in simulate.rows_of(measured[table])]
        simulator = simulate.Simulator(build, folder, names)
        return {table: dict(zip(simulate.rows_of(measured[table]), simulate.in_pairs(
                    lambda row, of=table: simulator.record(of, row, measured[of]), simulate.rows_of(measured[table]))))
                for table in TABLES}


def main():
    parser = argparse.ArgumentParser(prog="mars bench machine1992-assumptions", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    build = parser.parse_args().build
    measured = simulate.measured_cells()
    films = records_of(build, measured)
    print("| assumption | speed | host, us a byte | host, ms a message | us a depth | scale | 4.1: keyframes, % | "
          "inbetweens, % | 4.2: inbetweens, % | on 16 nodes | on 32 |\n|:--|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
    for name in ASSUMPTIONS:
        print(line(name, measured, films), flush=True)


if __name__ == "__main__":
    main()
