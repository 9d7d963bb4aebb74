"""One run: `mars render --report` of a configuration, and what of its report a study keeps. Files of runs are JSON
lines: a header, then one line a run, which says all of its own environment."""
import json
import os
import pathlib
import time

import environment
import usage
from study import Trouble

FORMAT = "mars-scaling 2"
PHASES = ("dice", "sum", "map", "exchange", "fill", "scanline", "shadow", "depth", "credit")
PEAKS = ("memory", "passes")  # of the work counts; all others are sums
KINDS = ("keyframe", "inbetween")

EVERY_RUN = {"series", "nodes", "repeat", "environment", "load_average", "load_average_after", "wall_seconds",
             "processor_seconds", "involuntary_switches", "others_seconds"}
REPORTED = {"film", "size", "checksum", "seconds", "frames", "frame_seconds", "per_node"}  # of a run that did not fail
NO_OPTIONS = ("size", "dice", "program")  # settings that are no option of mars render of the same name and value


class Runner:
    """Renders configurations with a program `mars`. Its files lie in `folder`, which the film's machine sees."""

    def __init__(self, mars, folder, hostfile=None, options=()):
        self.mars, self.folder, self.hostfile, self.options = mars, folder, hostfile, list(options)
        self.environment = environment.environment(mars, hostfile)

    def command(self, configuration, report):
        words = [self.mars, "render", self.film(configuration), "--nodes", str(configuration.nodes)]
        if configuration.size:
            words += ["--size", "x".join(map(str, configuration.size))]
        for axis, value in configuration.series.settings:
            words += [] if axis in NO_OPTIONS else [f"--{axis}", str(value)]
        words += ["--hostfile", self.hostfile] if self.hostfile else []
        frames_are_kept = any(word.startswith(("-o", "--output", "--sink")) for word in self.options)
        words += ["--overwrite"] if frames_are_kept else ["--sink", "none"]
        return words + ["--quiet", "--report", report, *self.options]

    def film(self, configuration):
        """The file to render; where dicing is varied, a copy that says how."""
        dice = configuration.setting("dice")
        return configuration.film if dice is None else diced(configuration.film, dice, self.folder)

    def run(self, configuration, repeat):
        """A run's line. One that fails is a line too, with the reason."""
        report = os.path.join(self.folder, "run.json")
        command = self.command(configuration, report)
        line = {"series": {"film": configuration.series.film, "kind": configuration.series.kind,
                           "settings": dict(configuration.series.settings)},
                "film": configuration.film, "nodes": configuration.nodes, "repeat": repeat, "command": command,
                "began": time.strftime("%Y-%m-%dT%H:%M:%S%z"), "load_average": environment.load_average()}
        used = usage.run(command)
        line.update(self.used(used), load_average_after=environment.load_average())
        if used.failure:
            line["failure"] = used.failure
        elif not os.path.exists(report):
            line["failure"] = f"{command[0]} ended well without a report: it is no mars"
        else:
            with open(report) as file:
                line.update(condensed(json.load(file)))
            os.remove(report)
        return {**line, "environment": self.environment}

    def used(self, used):
        """Processes on other machines, and those that Slurm starts, are not the command's own: nothing is known of them."""
        known = self.environment["processors_are"] == environment.OWN
        return {"wall_seconds": used.wall_seconds, "processor_seconds": used.processor_seconds if known else None,
                "involuntary_switches": used.involuntary_switches if known else None,
                "others_seconds": used.others_seconds if known else None}


def diced(film, dice, folder):
    """A copy of the film in `folder` with another dicing; its models are found as before."""
    try:
        with open(film) as file:
            content = json.load(file)
    except ValueError:
        raise Trouble(f"{film} is no JSON film: its dicing cannot be varied") from None
    here = os.path.dirname(os.path.abspath(film))
    models = content.get("models", {})
    content["models"] = {name: os.path.join(here, model) if isinstance(model, str) else model
                         for name, model in models.items()}
    content["dice"] = dice if dice == "adaptive" else int(dice)
    path = os.path.join(folder, f"{os.path.splitext(os.path.basename(film))[0]}-dice-{dice}.json")
    with open(path, "w") as file:
        json.dump(content, file)
    return path


def condensed(report):
    """What a study keeps of a report: sums over frames, for each node and kind of frame."""
    nodes = [{"node": node["node"], "host": node["host"], "binding": node["binding"], "simd": node["simd"]}
             for node in report["nodes"]]
    frames = report["frames"]
    for node in nodes:
        node.update({kind: sums_of([part for frame in frames if frame["kind"] == kind for part in frame["nodes"]
                                    if part["node"] == node["node"]]) for kind in KINDS})
    own = lambda frame: max(sum(part["seconds"].values()) for part in frame["nodes"])
    times = {kind: [own(frame) for frame in frames if frame["kind"] == kind and frame["nodes"]] for kind in KINDS}
    load = [frame["load_ratio"] for frame in frames if frame["kind"] == "keyframe"]
    return {"backend": report["backend"], "checksum": report["checksum"], "size": [report["width"], report["height"]],
            "seconds": report["render_seconds"], "load_seconds": report["load_seconds"],
            "total_seconds": report["total_seconds"], "frames": {kind: len(times[kind]) for kind in KINDS},
            "frame_seconds": {kind: sum(times[kind]) / len(times[kind]) if times[kind] else None for kind in KINDS},
            "load_ratio": sum(load) / len(load) if load else None, "per_node": nodes}


def seconds_of(part, phase):
    """0 for a phase that an older MARS does not have."""
    return part["seconds"].get(phase, 0.0)


def sums_of(parts):
    """Of a node's parts of frames."""
    seconds = {phase: sum(seconds_of(part, phase) for part in parts) for phase in PHASES}
    work = {}
    for part in parts:
        for name, count in part["work"].items():
            if name == "charged":  # by kind, for forecasts
                continue
            work[name] = max(work.get(name, 0), count) if name in PEAKS else work.get(name, 0) + count
    return {"frames": len(parts), "seconds": seconds, "work": work}


def read(path):
    """The header and the runs of a file, or of a study's folder."""
    path = pathlib.Path(path)
    path = path / "runs.jsonl" if path.is_dir() else path
    try:
        with open(path) as file:
            text = file.read()
    except (OSError, ValueError) as error:
        raise Trouble(f"{path} is no file of a scaling study ({getattr(error, 'strerror', None) or error})") from None
    header, *lines = parsed(path, text) or [{}]
    if not isinstance(header, dict) or header.get("format") != FORMAT:
        raise Trouble(f"{path} is no file of a scaling study of this version ({FORMAT})")
    return header, lines


def parsed(path, text):
    """The file's lines. Of a study that was killed the last one may be cut short: it is left out."""
    lines = []
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        try:
            lines += [json.loads(line)] if line.strip() else []
        except ValueError as error:
            if line.endswith("\n"):
                what = f"{path} is no file" if number == 1 else f"{path}:{number} is no line"
                raise Trouble(f"{what} of a scaling study ({error})") from None
        else:
            if len(lines) > 1 and not is_run(lines[-1]):
                raise Trouble(f"{path}:{number} is no run of a scaling study: leave this line out")
    return lines


def is_run(line):
    """Whether it says all that is reported of a run; one that took no time has no speed-up."""
    if not isinstance(line, dict) or not EVERY_RUN <= line.keys():
        return False
    seconds = line.get("seconds")
    took_time = isinstance(seconds, (int, float)) and seconds > 0
    return "failure" in line or (REPORTED <= line.keys() and took_time and bool(line["per_node"]))
