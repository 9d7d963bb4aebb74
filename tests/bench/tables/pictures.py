"""Pictures of the tables as SVG, by matplotlib: times over nodes, and figure 4.12."""
import io
import re

import cells

try:
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "mars", "svg.fonttype": "none", "font.size": 9})
    from matplotlib import pyplot
except ImportError:
    pyplot = None


def needed():
    if pyplot is None:
        raise cells.Trouble("Python's matplotlib is missing (./bootstrap bench installs it)")


def svg_of(figure):
    out = io.StringIO()
    figure.savefig(out, format="svg", bbox_inches="tight", metadata={"Date": None, "Creator": None})
    pyplot.close(figure)
    return re.sub(r"^.*?(?=<svg)", "", out.getvalue(), flags=re.S)  # without the XML header, to stand in a page


def lines_of(table, source, kind):
    """Nodes and milliseconds of each row."""
    for row in table.rows(kind):
        points = [(n, table.ms(source, row, kind, n)) for n in table.nodes(kind)]
        points = [(n, ms) for n, ms in points if ms]
        if points:
            yield row, list(zip(*points))


def nodes_axis(axes, nodes):
    axes.set_xscale("log", base=2)
    axes.set_xticks(nodes, [str(n) for n in nodes])
    axes.minorticks_off()
    axes.set_xlabel("nodes")


def over_nodes(parts, table_name, kind):
    """A panel for each source: a line for each row of the table."""
    table = cells.Cells(table_name, parts)
    sources = [source for source in table.sources if any(lines_of(table, source, kind))]
    figure, panels = pyplot.subplots(1, len(sources), figsize=(2.9 * len(sources), 2.7), squeeze=False)
    rows = table.rows(kind)
    colors = pyplot.get_cmap("viridis")
    for axes, source in zip(panels[0], sources):
        for row, (nodes, ms) in lines_of(table, source, kind):
            axes.plot(nodes, ms, marker="o", markersize=3, linewidth=1.2, label=str(row),
                      color=colors(0.9 * rows.index(row) / max(1, len(rows) - 1)))
        nodes_axis(axes, table.nodes(kind))
        axes.set_yscale("log")
        axes.set_title(source)
        axes.grid(alpha=0.3)
    panels[0][0].set_ylabel("ms a frame")
    panels[0][-1].legend(title=cells.ROWS[table_name], fontsize=6, title_fontsize=7, loc="center left",
                         bbox_to_anchor=(1, 0.5))
    figure.tight_layout()
    return svg_of(figure)


def in_three_dimensions(parts):
    """Figure 4.12: nodes, polygons and time, a panel for each source of table 4.3."""
    table = cells.Cells("4.3", parts)
    sources = [source for source in table.sources if table.sources[source]]
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
        axes.set_zlabel("ms")
        axes.set_title(source)
    figure.subplots_adjust(wspace=0.25)
    return svg_of(figure)


def all_pictures(parts):
    """Name, title and SVG of each, for the tables that have another source than the thesis."""
    measured = {part["table"] for part in parts if part["source"] != "thesis"}
    found = [(f"table-{table}-{kind}s", f"Table {table}, {kind}s: ms over nodes", over_nodes(parts, table, kind))
             for table in cells.TITLES if table in measured for kind in cells.KINDS[table]]
    if "4.3" in measured:
        found.append(("figure-4.12", "Figure 4.12: nodes, polygons and time", in_three_dimensions(parts)))
    return found
