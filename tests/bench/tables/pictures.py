"""Pictures of the tables as SVG: times over nodes, and figure 4.12. Without matplotlib there are none."""
import io
import math
import re

import cells

try:
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "mars", "svg.fonttype": "none", "font.size": 9})
    from matplotlib import pyplot, ticker
except ImportError:
    pyplot = None


def svg_of(figure):
    out = io.StringIO()
    figure.savefig(out, format="svg", bbox_inches="tight", metadata={"Date": None, "Creator": None})
    pyplot.close(figure)
    return re.sub(r"^.*?(?=<svg)", "", out.getvalue(), flags=re.S)  # without the XML header, to stand in a page


def shown(table, kind=None):
    """Sources that have a panel: of several from this machine, those that say most."""
    return [source for source, of in table.sources.items() if not source.endswith((", median", ", patches")) and
            any(kind in (None, k) for _, k, _ in of)]


def lines_of(table, source, kind):
    """Row, and nodes and milliseconds along it."""
    for row in table.rows(kind):
        points = [(n, table.ms(source, row, kind, n)) for n in table.nodes(kind)]
        points = [(n, ms) for n, ms in points if ms]
        if points:
            yield row, list(zip(*points))


def equal_decades(panels, spans):
    """Gives all panels the same factor from bottom to top, so that slopes compare."""
    reach = 1.15 * math.sqrt(max(high / low for low, high in spans))
    for axes, (low, high) in zip(panels, spans):
        axes.set_yscale("log")
        middle = math.sqrt(low * high)
        axes.set_ylim(middle / reach, middle * reach)
        axes.yaxis.set_major_locator(ticker.LogLocator(base=10, subs=(1, 2, 5), numticks=20))
        axes.yaxis.set_major_formatter(ticker.FuncFormatter(lambda ms, _: f"{ms:g}"))
        axes.yaxis.set_minor_locator(ticker.NullLocator())


def nodes_axis(axes, nodes):
    axes.set_xscale("log", base=2)
    axes.set_xticks(nodes, [str(n) for n in nodes])
    axes.minorticks_off()
    axes.set_xlabel("nodes")


def over_nodes(parts, table_name, kind):
    """A panel for each source: a line for each row of the table."""
    table = cells.Cells(table_name, parts)
    sources, rows = shown(table, kind), table.rows(kind)
    figure, (panels,) = pyplot.subplots(1, len(sources), figsize=(2.7 * len(sources) + 0.6, 2.8), squeeze=False)
    spans = []
    for axes, source in zip(panels, sources):
        for row, (nodes, ms) in lines_of(table, source, kind):
            axes.plot(nodes, ms, marker="o", markersize=3, linewidth=1.2, label=str(row),
                      color=pyplot.get_cmap("viridis")(0.9 * rows.index(row) / max(1, len(rows) - 1)))
        times = [ms for (_, k, _), ms in table.sources[source].items() if k == kind]
        spans.append((min(times), max(times)))
        nodes_axis(axes, table.nodes(kind))
        axes.set_title(source)
        axes.grid(alpha=0.3)
    equal_decades(panels, spans)
    panels[0].set_ylabel("ms a frame")
    figure.tight_layout()
    panels[0].legend(title=cells.ROWS[table_name], fontsize=6, title_fontsize=7, loc="center left",
                     bbox_to_anchor=(1, 0.5), bbox_transform=panels[-1].transAxes)
    return svg_of(figure)


def in_three_dimensions(parts):
    """Figure 4.12: nodes, polygons and time, a panel for each source of table 4.3."""
    table = cells.Cells("4.3", parts)
    sources = shown(table)
    figure = pyplot.figure(figsize=(4.2 * len(sources), 3.8))
    for number, source in enumerate(sources):
        axes = figure.add_subplot(1, len(sources), number + 1, projection="3d")
        columns = {}
        for row, kind, nodes in sorted(table.sources[source]):
            columns.setdefault(nodes, []).append((row, table.ms(source, row, kind, nodes)))
        for place, (nodes, points) in enumerate(sorted(columns.items())):
            sizes, ms = zip(*points)
            axes.plot([nodes.bit_length() - 1] * len(sizes), [size / 1000 for size in sizes], ms, marker="o",
                      markersize=3, linewidth=1.2, color=pyplot.get_cmap("viridis")(place / max(1, len(columns) - 1)))
        axes.set_xticks([n.bit_length() - 1 for n in columns], [str(n) for n in columns])
        axes.set_xlabel("nodes")
        axes.set_ylabel("thousand polygons")
        axes.set_title(f"{source}, ms")
        axes.set_box_aspect(None, zoom=0.85)
    return svg_of(figure)


def all_pictures(parts):
    """The SVG of each, by name, for the tables that have another source than the thesis; none without matplotlib."""
    if pyplot is None:
        return {}
    tables = cells.beside_thesis(parts)
    found = {f"table-{table}-{kind}s": over_nodes(parts, table, kind)
             for table in tables for kind in cells.KINDS[table]}
    if "4.3" in tables:
        found["figure-4.12"] = in_three_dimensions(parts)
    return found
