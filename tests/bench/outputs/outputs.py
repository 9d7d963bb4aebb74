#!/usr/bin/env python3
"""What each kind of output costs: a film is rendered to frames of each format, with and without alpha and layers, and
to videos of each kind and codec, and to nothing. For each output: seconds from start to end, frames a second, bytes
of all its files, processor seconds of all processes, and how many more than the rendering alone takes. The
best of all rounds counts, in which outputs take turns. Words after -- go to mars render."""
import argparse
import collections
import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
DEMO = HERE.parents[2] / "examples" / "demo.json"

Output = collections.namedtuple("Output", "name words")  # words of mars render, in a folder of its own
Run = collections.namedtuple("Run", "seconds processors bytes frames")

NOTHING = Output("nothing", ["--sink", "none"])
COMPRESSIONS = ["zip", "zips", "piz", "pxr24", "rle", "none"]
LAYERS = ["depth", "normal", "unshadowed", "motion", "ids", "all"]
VIDEOS = [("mp4", "h264"), ("mp4", "h265"), ("mp4", "av1"), ("mp4", "vp9"), ("mov", "h264"), ("mov", "prores"),
          ("mkv", "h264"), ("mkv", "ffv1"), ("webm", "vp9"), ("webm", "av1"), ("gif", "gif"), ("apng", "apng")]
OUTPUTS = [
    NOTHING,
    Output("png", ["-o", "out", "--format", "png"]),
    Output("png alpha", ["-o", "out", "--format", "png", "--alpha"]),
    Output("png16", ["-o", "out", "--format", "png16"]),
    *(Output(f"exr {each}", ["-o", "out", "--format", "exr", "--compression", each]) for each in COMPRESSIONS),
    Output("exr alpha", ["-o", "out", "--format", "exr", "--alpha"]),
    *(Output(f"exr {each}", ["-o", "out", "--format", "exr", "--layers", each]) for each in LAYERS),
    *(Output(f"{ending} {codec}", ["-o", f"out.{ending}", "--codec", codec]) for ending, codec in VIDEOS),
]


class Failed(Exception):
    pass


def run(mars, film, output, more):
    with tempfile.TemporaryDirectory(prefix="mars-outputs-") as folder:
        report = os.path.join(folder, "report.json")
        words = [mars, "render", film, *output.words, "--quiet", "--report", report, *more]
        with open(os.path.join(folder, "errors"), "w+") as errors:
            began = os.times().elapsed
            process = subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=errors)
            _, status, usage = os.wait4(process.pid, 0)
            seconds = os.times().elapsed - began
            process.returncode = os.waitstatus_to_exitcode(status)
            if process.returncode != 0:
                errors.seek(0)
                raise Failed(errors.read().strip())
        return Run(seconds, usage.ru_utime + usage.ru_stime, size_of(pathlib.Path(folder)), frames_of(report))


def size_of(folder):
    """Bytes of a video, or of all frames."""
    return sum(file.stat().st_size for file in [*folder.glob("out.*"), *folder.glob("out/frame-*")])


def frames_of(report):
    with open(report) as file:
        return len(json.load(file)["frames"])


def best(runs):
    return runs[0]._replace(seconds=min(run.seconds for run in runs), processors=min(run.processors for run in runs))


def show(runs):
    alone = best(runs[NOTHING.name]).processors
    print(f"{'output':14} {'seconds':>8} {'frames/s':>9} {'bytes':>12} {'bytes/frame':>12} {'processors':>11} {'beyond':>8}")
    for name, each in runs.items():
        seconds, processors, size, frames = best(each)
        print(f"{name:14} {seconds:8.2f} {frames / seconds:9.1f} {size:12} {size // frames:12} {processors:11.2f} "
              f"{processors - alone:8.2f}", flush=True)


def measure(wanted, outputs):
    """The runs of each output by its name, and what failed: an ffmpeg may lack an encoder."""
    runs, failures = collections.defaultdict(list), {}
    mars = os.path.join(os.path.abspath(wanted.build), "bin", "mars")
    for _ in range(wanted.rounds):
        for output in outputs:
            if output.name in failures:
                continue
            try:
                runs[output.name].append(run(mars, os.path.abspath(wanted.film), output, wanted.more))
            except Failed as failure:
                failures[output.name] = failure
    return runs, failures


def words_behind(words):
    """Those of the benchmark, and those after --."""
    at = words.index("--") if "--" in words else len(words)
    return words[:at], words[at + 1:]


def main():
    own, more = words_behind(sys.argv[1:])
    parser = argparse.ArgumentParser(prog="mars bench outputs", description=__doc__)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("film", metavar="FILM", nargs="?", default=DEMO, help="default: examples/demo.json")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", metavar="OUTPUT", nargs="+", choices=[output.name for output in OUTPUTS],
                        default=[output.name for output in OUTPUTS],
                        help="these outputs: " + ", ".join(f"'{output.name}'" for output in OUTPUTS[1:]))
    wanted = parser.parse_args(own)
    wanted.more = more
    outputs = [output for output in OUTPUTS if output is NOTHING or output.name in wanted.only]
    runs, failures = measure(wanted, outputs)
    if NOTHING.name in failures:
        sys.exit(str(failures[NOTHING.name]))
    show(runs)
    for name, failure in failures.items():
        print(f"{name}: {failure}", file=sys.stderr)


if __name__ == "__main__":
    main()
