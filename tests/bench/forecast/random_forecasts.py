"""Whether renderings take as long as the intervals of their forecasts say: random films are forecast and rendered."""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "identity"))
from random_film import RandomFilm  # noqa: E402

LARGEST, LONGEST = 1600, 96  # pixels of a side, and frames
SECONDS = 0.5, 3


class Machine:
    """Runs `mars` in a folder that goes away."""

    def __init__(self, build, folder):
        self.mars = os.path.abspath(os.path.join(build, "bin", "mars"))
        self.folder = pathlib.Path(folder)
        self.platform = str(self.folder / "here.json")

    def run(self, *words):
        return subprocess.run([self.mars, *map(str, words)], check=True, capture_output=True, text=True).stdout

    def calibrate(self):
        self.run("calibrate", "-o", self.platform)

    def write(self, seed):
        film, path = RandomFilm(seed, LARGEST, LONGEST), self.folder / f"film-{seed}.json"
        path.write_text(json.dumps(film.json))
        for command in film.commands:
            self.run(*[path if word == "FILM" else word for word in command])
        return path

    def plan(self, film, nodes):
        return json.loads(self.run("plan", film, "--nodes", nodes, "--sink", "none", "--platform", self.platform, "--json"))

    def seconds(self, film, nodes, groups):
        report = self.folder / "report.json"
        self.run("render", film, "--nodes", nodes, "--groups", groups, "--sink", "none", "--backend", "threads", "--quiet",
                 "--report", report)
        return json.loads(report.read_text())["total_seconds"]


def films(machine, first_seed):
    """Seeds and files of films that take neither too little nor too long."""
    seed = first_seed
    while True:
        film = machine.write(seed)
        if SECONDS[0] <= machine.plan(film, 1)["seconds"] <= SECONDS[1]:
            yield seed, film
        film.unlink()
        seed += 1


class Tally:
    """Of one number of nodes."""

    def __init__(self, nodes):
        self.nodes = nodes
        self.below, self.above, self.widths, self.errors = [], [], [], []

    def add(self, seed, plan, seconds):
        low, high = plan["interval"]["low"], plan["interval"]["high"]
        self.widths.append(high / low)
        self.errors.append(abs(seconds / plan["seconds"] - 1))
        if seconds < low:
            self.below.append(seed)
        if seconds > high:
            self.above.append(seed)

    def text(self):
        count = len(self.widths)
        inside = count - len(self.below) - len(self.above)
        return (f"{self.nodes} nodes: {inside} of {count} in the 90 % interval, {len(self.below)} below, {len(self.above)} "
                f"above; interval's high / low {statistics.median(self.widths):.2f}, error of the forecast "
                f"{100 * statistics.median(self.errors):.0f} % in the middle")


def row(seed, nodes, plan, seconds):
    interval = plan["interval"]
    place = "below" if seconds < interval["low"] else "above" if seconds > interval["high"] else "in"
    return (f"{seed:6} {nodes:5} {plan['seconds']:9.3f} {interval['low']:9.3f} {interval['high']:9.3f} {seconds:9.3f} "
            f"{seconds / plan['seconds']:9.2f}  {place}")


def calibrated(machine, platform):
    """Of the platform file that is given, or of this machine as it is now. The reason why it is doubtful, or none."""
    if platform:
        machine.platform = platform
    else:
        print("mars calibrate measures this machine", flush=True)
        machine.calibrate()
    return json.loads(pathlib.Path(machine.platform).read_text()).get("doubt")


def compare(build, count, numbers, first_seed, platform):
    """Prints for `count` films and each of some numbers of nodes the forecast, its interval and the measured seconds."""
    tallies = [Tally(nodes) for nodes in numbers]
    with tempfile.TemporaryDirectory(prefix="mars-forecasts-") as folder:
        machine = Machine(build, folder)
        if (doubt := calibrated(machine, platform)) is not None:
            print(f"the calibration was noisy: {doubt}")
        print(f"{'film':>6} {'nodes':>5} {'forecast':>9} {'from':>9} {'to':>9} {'measured':>9} {'/forecast':>9}")
        for _, (seed, film) in zip(range(count), films(machine, first_seed)):
            for tally in tallies:
                plan = machine.plan(film, tally.nodes)
                if "interval" not in plan:
                    sys.exit(f"mars bench forecast: no interval is known for {tally.nodes} nodes on {machine.platform}")
                seconds = machine.seconds(film, tally.nodes, plan["groups"])
                tally.add(seed, plan, seconds)
                print(row(seed, tally.nodes, plan, seconds), flush=True)
    for tally in tallies:
        print(tally.text())
