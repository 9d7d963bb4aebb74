"""Where the time of inbetweens goes. On P nodes one takes A / P + B: A is a node's time, of which all have a share, B
what does not shrink with the nodes: the host's time for a strip, as it takes one after the other."""
import numpy

import replay


def shares(cells):
    """A and B, from milliseconds by nodes, by least squares of relative errors."""
    terms = numpy.array([[1 / nodes, 1] for nodes in cells])
    ms = numpy.array([*cells.values()], float)
    return tuple(map(float, numpy.linalg.lstsq(terms / ms[:, None], numpy.ones(len(ms)), rcond=None)[0]))


def by_nodes(cells, row):
    """Of [row, kind, nodes, ms], the row's inbetweens."""
    return {nodes: ms for of, kind, nodes, ms in cells if (of, kind) == (row, "inbetween")}


def host_takes(job, costs, network):
    """Milliseconds of the host for an inbetween, on average, by what for."""
    each = [replay.host_takes(job, k, k, costs, network) for k in range(len(job.moving))]
    return {name: 1000 * float(numpy.mean([of[name] for of in each])) for name in each[0]}


def sheet_of(table, measured, simulated, jobs, costs, network):
    """A table for a person. `measured`, `simulated`: cells; `jobs`: by row, that of the most nodes."""
    rows = []
    for row, job in jobs.items():
        takes = host_takes(job, costs, network)
        rows.append([row, *(round(term, 1) for cells in (measured, simulated) for term in shares(by_nodes(cells, row))),
                     *(round(ms, 1) for ms in takes.values())])
    return {"title": f"Table {table}: where the time of inbetweens goes", "page": f"table-{table}",
            "note": "Times on P nodes are fitted by A / P + B, by least squares. A is a node's time for an inbetween; B is "
                    "the time of the host, which takes one inbetween after the other. The last four columns say where the "
                    "simulated host spends it: the strip on its link, the message, the flags of its blocks, and the pixels "
                    "that it looks at, writes and restores.",
            "header": ["moving polygons", "thesis: A, ms", "B", "simulated: A, ms", "B", "link", "message", "flags",
                       "pixels"],
            "rows": rows}
