"""Results as a table of docs/decisions/faults.md."""

COLUMNS = ("fault", "made by", "reported after", "drawing again after", "frames lost", "drawn twice")


def seconds(value):
    return "-" if value is None else f"{value:.1f} s"


def row(result):
    again = "goes on" if result["goes_on"] else seconds(result["again"])
    return (result["title"], result["how"], seconds(result["reported"]), again, str(result["lost"]),
            str(result["twice"]))


def markdown(results):
    lines = [COLUMNS, ["---"] * len(COLUMNS), *map(row, results)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
