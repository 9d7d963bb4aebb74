"""Points of a study in words."""


def seconds_text(seconds):
    if seconds >= 1:
        return f"{seconds:.3f} s"
    return f"{1e3 * seconds:.3g} ms" if seconds >= 1e-3 else f"{1e6 * seconds:.3g} \u00b5s"


def fraction_text(fraction):
    return "" if fraction is None else f"{100 * fraction:.1f} %"


def bytes_text(count):
    return f"{count / 1e6:.2f} MB"


COLUMNS = ("nodes", "best", "median", "quartiles", "speed-up", "efficiency", "serial", "load", "to nodes", "to host")


def row_of(line, point):
    """A point in words, by COLUMNS. One that has none to be compared with has no speed-up."""
    time, alone = point.time, len(line.points) == 1 and point.nodes > 1
    return (f"{point.nodes}{'*' if point.oversubscribed else ''}", seconds_text(time.best), seconds_text(time.median),
            f"{seconds_text(time.lower)} to {seconds_text(time.upper)}",
            "" if alone else f"{line.middle[point.nodes]:.2f}", "" if alone else fraction_text(line.efficiency(point)),
            fraction_text(line.serial_fraction_at(point)), f"{point.load_ratio:.2f}", bytes_text(point.bytes("nodes")),
            bytes_text(point.bytes("host")))


def text(results):
    """For a terminal."""
    output = ""
    for line in results.lines:
        rows = [COLUMNS, *(row_of(line, point) for point in line.points)]
        widths = [max(len(row[k]) for row in rows) for k in range(len(COLUMNS))]
        output += f"{line.title}\n"
        for row in rows:
            output += "  " + "  ".join(cell.rjust(width) for cell, width in zip(row, widths)) + "\n"
        output += "\n"
    return output + "* more nodes than processors\n" if "*" in output else output
