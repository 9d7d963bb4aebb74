"""The pictures of a study, as SVG texts."""
import io

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot, ticker  # noqa: E402

from results import STEPS  # noqa: E402

matplotlib.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "mars", "font.family": "sans-serif", "font.size": 9,
    "font.sans-serif": ["DejaVu Sans"], "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": "#8a8f98",
    "axes.labelcolor": "#3b4048", "xtick.color": "#3b4048", "ytick.color": "#3b4048", "axes.titlesize": 9.5,
    "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.grid": True, "axes.grid.axis": "y", "grid.color": "#e6e8eb",
    "axes.axisbelow": True, "legend.frameon": False, "legend.fontsize": 8.5, "lines.linewidth": 1.6, "lines.markersize": 5})
LINES = ["#1f5f99", "#d1603d", "#3a8f5c", "#8a5aa8", "#b8902b", "#4a4f57", "#c2497f", "#3f9fb0"]
QUIET = "#9aa0a8"
# Computing in cold colours, waiting in warm ones, the rest grey.
COLOURS = dict(zip(STEPS, ["#16456e", "#f0c36d", "#7a6fb0", "#e39a4f", "#5b9bc9", "#2b7a78", "#86b8a5", "#c9563c",
                           "#a23b4e", "#c9ccd1"], strict=True))
WIDTH, HEIGHT = 9.6, 3.5  # inches


def svg(figure):
    """As it stands in a page: without what stands before the element, and without links."""
    file = io.StringIO()
    no_links = dict.fromkeys(["Date", "Creator", "Format", "Type"])
    figure.savefig(file, format="svg", bbox_inches="tight", metadata=no_links)
    pyplot.close(figure)
    text = file.getvalue()
    return text[text.index("<svg"):]


def over_nodes(axes, counts, title):
    """Nodes from left to right, each count as far from the next as its double."""
    axes.set_title(title, pad=10)
    axes.set_xscale("log", base=2)
    axes.set_xticks(counts)
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_locator(ticker.NullLocator())
    axes.set_xlim(min(counts) / 1.15, max(counts) * 1.15)
    axes.set_xlabel("nodes")


def shade_sharing(axes, lines):
    """Where nodes share processors."""
    alone = [point.nodes for line in lines for point in line.points if not point.oversubscribed]
    shared = [point.nodes for line in lines for point in line.points if point.oversubscribed]
    if shared:
        left = (max(alone) * min(shared)) ** 0.5 if alone else min(shared) / 1.15
        axes.axvspan(left, max(shared) * 1.15, color="#f4f1ea", zorder=0, linewidth=0)
        axes.text(1, 1.02, "more nodes than processors", ha="right", va="bottom", fontsize=8, color="#8b7f66",
                  transform=axes.transAxes)


def beside(lines):
    """By how much each line's points are moved to the right, so that none hides another's."""
    return [2 ** (0.05 * (place - (len(lines) - 1) / 2)) for place in range(len(lines))]


def draw_line(axes, line, values, shift, colour, label):
    """`values`: of a point's seconds, that of the axes. The median with its quartiles, the best time hollow."""
    places = [nodes * shift for nodes in line.nodes]
    at = lambda seconds: [values(point, seconds(point)) for point in line.points]
    middle = at(lambda point: point.time.median)
    ends = at(lambda point: point.time.upper), at(lambda point: point.time.lower)
    bars = [[abs(end - value) for end, value in zip(each, middle)] for each in ends]
    axes.errorbar(places, middle, yerr=bars, color=colour, marker="o", capsize=2.5, elinewidth=1, label=label)
    axes.plot(places, at(lambda point: point.time.best), color=colour, marker="o", markerfacecolor="white",
              linestyle="none", markersize=4)


def speed_up_of(line):
    first = line.points[0]
    return lambda point, seconds: first.nodes * first.time.median / seconds * line.work(point)


def scaling(lines):
    """Speed-up and efficiency of one film's lines of one kind."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(WIDTH, HEIGHT), gridspec_kw={"wspace": 0.22})
    counts = sorted({nodes for line in lines for nodes in line.nodes})
    over_nodes(left, counts, "Speed-up" if lines[0].kind == "strong" else "Scaled speed-up")
    over_nodes(right, counts, "Efficiency")
    for axes in (left, right):
        shade_sharing(axes, lines)
    left.plot(counts, counts, color=QUIET, linestyle=(0, (1, 2)), linewidth=1.2, label="ideal")
    right.axhline(1, color=QUIET, linestyle=(0, (1, 2)), linewidth=1.2)
    for line, shift, colour in zip(lines, beside(lines), LINES * len(lines)):
        speed_up = speed_up_of(line)
        draw_line(left, line, speed_up, shift, colour, line.choice or "measured")
        draw_line(right, line, lambda point, seconds: speed_up(point, seconds) / point.nodes, shift, colour, None)
        draw_amdahl(left, line, colour)
    left.set_yscale("log", base=2)
    left.yaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    right.yaxis.set_major_formatter(ticker.PercentFormatter(1, decimals=0, symbol=" %"))
    right.set_ylim(0, max(1.1, right.get_ylim()[1]))
    legend_above(figure, left)
    return svg(figure)


def legend_above(figure, *of):
    """Above all axes, where no line runs through it."""
    handles, labels = (sum(parts, []) for parts in zip(*(axes.get_legend_handles_labels() for axes in of)))
    figure.legend(handles, labels, loc="lower left", bbox_to_anchor=(figure.subplotpars.left, 0.99), ncol=4,
                  borderaxespad=0, borderpad=0, columnspacing=1.5)


def draw_amdahl(axes, line, colour):
    if line.amdahl and len(line.fitted) > 2:
        fraction, _, _ = line.amdahl
        axes.plot(line.nodes, [1 / (fraction + (1 - fraction) / nodes) for nodes in line.nodes], color=colour, linewidth=1,
                  linestyle=(0, (5, 3)), label="Amdahl's law")


def steps(lines):
    """The time of a mean node by step, a column of each point: one panel a line."""
    columns = min(3, len(lines)) if len(lines) != 4 else 2
    rows = -(-len(lines) // columns)
    height = 3.3 * rows + 0.4
    figure, panels = pyplot.subplots(rows, columns, figsize=(WIDTH, height), squeeze=False,
                                     gridspec_kw={"wspace": 0.22, "hspace": 0.45, "top": 1 - 0.75 / height})
    for axes in panels.flat[len(lines):]:
        axes.set_axis_off()
    for axes, line in zip(panels.flat, lines):
        draw_steps(axes, line)
    for row in panels:
        row[0].set_ylabel("seconds of a mean node")
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncol=len(STEPS), bbox_to_anchor=(0.5, 1),
                  handlelength=1, handleheight=1, columnspacing=1.3)
    return svg(figure)


def draw_steps(axes, line):
    axes.set_title(line.title, pad=8, fontsize=9)
    bottoms, places = [0.0] * len(line.points), range(len(line.points))
    for step in STEPS:
        heights = [point.steps[step] for point in line.points]
        axes.bar(places, heights, bottom=bottoms, width=0.62, color=COLOURS[step], label=step)
        bottoms = [bottom + height for bottom, height in zip(bottoms, heights)]
    axes.set_xticks(places, [f"{point.nodes}{'*' if point.oversubscribed else ''}" for point in line.points])
    axes.set_xlabel("nodes")


def balance(lines):
    """Load ratio, and bytes sent."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(WIDTH, HEIGHT), gridspec_kw={"wspace": 0.22})
    counts = sorted({nodes for line in lines for nodes in line.nodes})
    over_nodes(left, counts, "Load ratio: the busiest node over the mean")
    over_nodes(right, counts, "Megabytes in the whole film")
    for line, colour in zip(lines, LINES * len(lines)):
        left.plot(line.nodes, [point.load_ratio for point in line.points], color=colour, marker="o", label=line.title)
        for to, style in (("nodes", "-"), ("host", (0, (4, 2)))):
            right.plot(line.nodes, [point.bytes(to) / 1e6 for point in line.points], color=colour, linestyle=style,
                       marker="o", markersize=4)
    left.set_ylim(1, max(1.1, left.get_ylim()[1]))
    left.yaxis.set_major_locator(ticker.MaxNLocator(6, steps=[1, 2, 5, 10]))
    right.set_ylim(bottom=0)
    for to, style in (("to other nodes", "-"), ("to the host", (0, (4, 2)))):
        right.plot([], [], color="#3b4048", linestyle=style, label=to)
    legend_above(figure, left, right)
    return svg(figure)
