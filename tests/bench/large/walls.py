"""What binds films on 1 to 4096 nodes, by mars plan from exact counts."""
import json
import pathlib
import resource
import subprocess
import sys

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
PLATFORMS = {"fat-tree": "fat tree", "dragonfly": "dragonfly", "ethernet": "Ethernet"}
SHOWN = [4 ** k for k in range(7)]  # nodes

# How each film is rendered; the large film's intervals keep as many groups busy alike.
FILMS = {
    "large": ["--groups", "60"],
    "demo": ["--size", "3840x2160", "--samples", "4"],
    "stones": ["--size", "1920x1080"],
}

# In the picture: a color of each wall.
COLORS = {"compute": "tab:blue", "imbalance": "tab:cyan", "sum": "tab:pink", "exchange": "tab:olive",
          "still lines": "tab:red", "bands": "tab:purple", "host": "tab:brown", "encoder": "tab:green",
          "storage": "black", "one frame": "tab:orange"}
LINES = {"fat-tree": "-", "dragonfly": "--", "ethernet": ":"}


def plan(mars, film_file, counts, options, platform, nodes):
    """The forecast of each power of two of nodes, explained; its cost in seconds of a processor."""
    command = [mars, "plan", film_file, *options, "--counted", counts, "--platform", platform, "--nodes", str(nodes),
               "--write", "nodes", "--explain", "--json"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if run.returncode:
        sys.exit(f"{film_file} on {platform}: {run.stderr.strip()[-400:]}")
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {"by_nodes": json.loads(run.stdout)["by_nodes"], "processor_seconds": processor}


def explained(mars, output, film_name, film_file, platform, nodes):
    """As plan, or what a run before has written."""
    path = output / f"walls-{film_name}-{platform}-{nodes}.json"
    if not path.exists():
        counts = output / f"{film_name}.counts"
        path.write_text(json.dumps(plan(mars, film_file, counts, FILMS[film_name], platform, nodes)) + "\n")
    return json.loads(path.read_text())


def cell(entry):
    """Seconds, what binds, seconds without it, and what binds then."""
    walls = entry["explained"]
    if "binding" not in walls:
        return f"{entry['seconds']:.3g}"
    without = next(wall["without"] for wall in walls["walls"] if wall["wall"] == walls["binding"])
    then = f"; then {walls['next']}" if "next" in walls else ""
    return f"{entry['seconds']:.3g}: {walls['binding']} ({without:.3g}{then})"


def table(by_platform):
    """Rows of one film, of those numbers of nodes that are shown."""
    names = list(by_platform)
    head = " | ".join(["| nodes", *(PLATFORMS.get(name, name) for name in names)])
    lines = [head + " |", "|" + "---|" * (len(names) + 1)]
    entries = {name: {entry["nodes"]: entry for entry in by_platform[name]["by_nodes"]} for name in names}
    most = max(next(iter(entries.values())))
    for nodes in [n for n in SHOWN if n < most] + [most]:
        lines.append(f"| {nodes} | " + " | ".join(cell(entries[name][nodes]) for name in names) + " |")
    return "\n".join(lines) + "\n"


def draw(films, path):
    """Speed-up over nodes, a line for each network; the color of a point says what binds."""
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "mars", "svg.fonttype": "none"})
    from matplotlib import pyplot
    from matplotlib.lines import Line2D
    figure, axes = pyplot.subplots(1, len(films), figsize=(4 * len(films), 4.6), squeeze=False, sharey=True)
    seen = set()
    for (name, by_platform), axis in zip(films.items(), axes[0]):
        for platform, found in by_platform.items():
            entries = found["by_nodes"]
            nodes = [entry["nodes"] for entry in entries]
            speed_up = [entries[0]["seconds"] / entry["seconds"] for entry in entries]
            binding = [entry["explained"].get("binding") for entry in entries]
            axis.loglog(nodes, speed_up, LINES.get(platform, "-"), color="gray", linewidth=1.2, zorder=1)
            axis.scatter(nodes, speed_up, c=[COLORS.get(wall, "gray") for wall in binding], s=26, zorder=2)
            seen |= set(binding)
        axis.loglog(nodes, nodes, color="lightgray", linewidth=0.8, zorder=0)
        axis.set(title=name, xlabel="nodes")
        axis.set_xticks([n for n in SHOWN if n <= nodes[-1]], [str(n) for n in SHOWN if n <= nodes[-1]])
        axis.minorticks_off()
        axis.grid(True, alpha=0.3)
    axes[0][0].set_ylabel("speed-up")
    networks = dict.fromkeys(platform for by_platform in films.values() for platform in by_platform)
    keys = [Line2D([], [], color="gray", linestyle=LINES.get(name, "-"), label=PLATFORMS.get(name, name))
            for name in networks]
    keys.append(Line2D([], [], color="lightgray", linewidth=0.8, label="ideal"))
    keys += [Line2D([], [], color=color, marker="o", linestyle="", label=wall)
             for wall, color in COLORS.items() if wall in seen]
    figure.legend(handles=keys, loc="lower center", ncol=6, frameon=False)
    figure.tight_layout(rect=(0, 0.14, 1, 1))
    figure.savefig(path, metadata={"Date": None, "Creator": None})


def run(mars, output, names, platforms, nodes, write_large):
    """`write_large`: writes the large film into a file."""
    films = {}
    for name in names:
        film_file = EXAMPLES / f"{name}.json"
        if name == "large":
            film_file = output / "large.json"
            write_large(film_file)
        films[name] = {}
        for platform in platforms:
            films[name][platform] = explained(mars, output, name, film_file, platform, nodes)
            print(f"{name}, {platform}: {films[name][platform]['processor_seconds']:.0f} s of a processor", flush=True)
    text = "\n".join(f"{name}\n\n{table(by_platform)}" for name, by_platform in films.items())
    (output / "walls.md").write_text(text)
    draw(films, output / "walls.svg")
    print(text)
