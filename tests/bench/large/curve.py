"""The runs as a table and a picture."""


def best_runs(runs):
    """The quickest groups of each platform, writer and number of nodes."""
    best = {}
    for run in runs:
        key = (run["platform"], run["writer"], run["frames"], run["size"], run["nodes"])
        if key not in best or run["film_seconds"] < best[key]["film_seconds"]:
            best[key] = run
    return [best[key] for key in sorted(best, key=str_then_nodes)]


def str_then_nodes(key):
    return (*map(str, key[:-1]), key[-1])


def ideal(run):
    return max(run["floors"].values())


def wall(run):
    return max(run["floors"], key=run["floors"].get)


def with_efficiency(runs):
    """(run, its efficiency against the fewest nodes of its curve)."""
    first = {}
    for run in runs:
        base = first.setdefault((run["platform"], run["writer"], run["frames"], run["size"]), run)
        seconds = base["film_seconds"] * base["nodes"] / run["nodes"]
        yield run, seconds / run["film_seconds"]


def table(runs):
    lines = ["| film | platform | frames written by | nodes | groups | film (s) | efficiency | ideal (s) | film / ideal | "
             "ideal's wall | load (s) | keyframe (ms) | inbetweens a second |", "|" + "---|" * 13]
    for run, efficiency in with_efficiency(runs):
        lines.append(
            f"| {run['size']} | {run['platform']} | {run['writer']} | {run['nodes']} | {run['groups']} | {run['film_seconds']:.3g} | "
            f"{efficiency:.0%} | {ideal(run):.3g} | {run['film_seconds'] / ideal(run):.2f} | {wall(run)} | "
            f"{run['load_seconds']:.2g} | {1e3 * run['keyframe_seconds']:.3g} | {run['inbetweens_a_second']:.0f} |")
    return "\n".join(lines) + "\n"


def draw(runs, path):
    import matplotlib
    matplotlib.use("svg")
    from matplotlib import pyplot
    names = sorted({run["platform"] for run in runs})
    figure, axes = pyplot.subplots(1, len(names), figsize=(5 * len(names), 4), squeeze=False, sharey=True)
    for name, axis in zip(names, axes[0]):
        for writer, color in (("host", "tab:blue"), ("nodes", "tab:orange")):
            curve = [run for run in runs if run["platform"] == name and run["writer"] == writer]
            nodes = [run["nodes"] for run in curve]
            axis.loglog(nodes, [run["film_seconds"] for run in curve], "o-", color=color, label=f"written by {writer}")
            axis.loglog(nodes, [ideal(run) for run in curve], "--", color=color, label="its ideal")
        axis.set(title=name, xlabel="nodes")
        axis.grid(True, which="both", alpha=0.3)
    axes[0][0].set_ylabel("film, seconds")
    axes[0][0].legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
