#!/usr/bin/env python3
"""How close forecasts come: mars plan --platform here against renderings on this machine, which mars calibrate has
measured. Printed for each film and number of nodes: the median of several renderings' seconds, what was forecast, and
how far that is off, in seconds, memory and bytes; then how far off the remaining time is that mars render shows, and
that of frames done by frames.

With --random N: this machine is calibrated, and N random films (tests/bench/identity/random_film.py) are forecast by
that; each number of nodes renders each of them once, with frames that go nowhere. Films take 0.5 to 3 seconds on one
node by their forecasts; seeds of other films are left out. Printed are each forecast with its interval and the
measured seconds; then how many lie in their intervals. Nine of ten should: of 30 films 25 to 29, in nine of ten such
samples."""
import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time

import random_forecasts

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "examples")
FILMS = ["demo", "visit", "s3", "robot-arm", "bodies", "stones", "caterpillar", "teapot"]


def off(forecast, measured):
    return f"{100 * (forecast / measured - 1):+7.1f} %" if measured else "       -  "


def plan(programs, film, nodes, groups):
    words = [os.path.join(programs, "mars"), "plan", film, "--nodes", str(nodes), "--sink", "none", "--json"]
    begun = time.monotonic()
    printed = subprocess.run(words + groups, check=True, capture_output=True, text=True).stdout
    return json.loads(printed), time.monotonic() - begun


def rendering(programs, film, nodes, groups, folder, backend):
    """The report, and the events."""
    report = os.path.join(folder, "report.json")
    words = [os.path.join(programs, "mars"), "render", film, "--nodes", str(nodes), "--sink", "none", "--quiet"]
    subprocess.run(words + ["--backend", backend, "--groups", str(groups), "--report", report], check=True)
    with open(report) as file:
        return json.load(file)


def measured(report):
    work = [node["work"] for frame in report["frames"] for node in frame["nodes"]]
    total = lambda key: sum(each[key] for each in work)
    return {"seconds": report["total_seconds"], "memory": max(each["memory"] for each in work),
            "to_nodes": total("bytes_to_nodes"), "to_host": total("bytes_to_host")}


def compare(programs, names, numbers, repeats, folder, backend):
    print(f"{'film':<12} {'nodes':>5} {'groups':>6} {'seconds':>9} {'forecast':>9} {'off':>9} {'memory':>9} "
          f"{'to nodes':>9} {'to host':>9} {'planned in':>10}")
    for name in names:
        film = os.path.join(EXAMPLES, name + ".json")
        for nodes in numbers:
            forecast, planning = plan(programs, film, nodes, [])
            runs = [measured(rendering(programs, film, nodes, forecast["groups"], folder, backend))
                    for _ in range(repeats + 1)][1:]
            middle = {key: statistics.median(run[key] for run in runs) for key in runs[0]}
            print(f"{name:<12} {nodes:5} {forecast['groups']:6} {middle['seconds']:9.3f} {forecast['seconds']:9.3f} "
                  f"{off(forecast['seconds'], middle['seconds'])} {off(forecast['node_memory'], middle['memory'])} "
                  f"{off(forecast['bytes_to_nodes'], middle['to_nodes'])} "
                  f"{off(forecast['bytes_to_host'], middle['to_host'])} {planning:8.2f} s", flush=True)


def remaining(programs, name, nodes):
    """For each frame that came: seconds that were left, as shown, and by frames done."""
    words = [os.path.join(programs, "mars-threads"), os.path.join(EXAMPLES, name + ".json"), "--nodes", str(nodes),
             "--sink", "none"]
    printed = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    events = [json.loads(line) for line in printed.splitlines()]
    progress = [event for event in events if event["event"] == "progress"]
    kinds = ("keyframes", "inbetweens")
    seconds = [sum(event[kind]["seconds"] for kind in kinds) for event in progress]
    for event, at in list(zip(progress, seconds))[1:-1]:
        done, of = (sum(event[kind][key] for kind in kinds) for key in ("done", "of"))
        shown = sum(event["left"][kind] for kind in kinds) if "left" in event else None
        yield seconds[-1] - at, shown, at / done * (of - done), seconds[-1]


def compare_remaining(programs, nodes, repeats):
    print(f"\nRemaining time on {nodes} nodes: mean error, in % of the whole rendering\n"
          f"{'film':<12} {'shown':>8} {'by frames done':>15}")
    for name in ("demo", "visit"):
        rows = [row for _ in range(repeats) for row in remaining(programs, name, nodes)]
        if any(shown is None for _, shown, _, _ in rows):
            print(f"{name:<12} nothing is forecast")
            continue
        error = lambda at: 100 * statistics.mean(abs(row[at] - row[0]) / row[3] for row in rows)
        print(f"{name:<12} {error(1):6.1f} % {error(2):13.1f} %", flush=True)


def main():
    parser = argparse.ArgumentParser(prog="mars bench forecast", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--films", default=",".join(FILMS), help="of examples/; default: %(default)s")
    parser.add_argument("--nodes", default="1,2,4", help="default: %(default)s")
    parser.add_argument("--repeats", type=int, default=5, help="renderings after one to warm up; default: %(default)s")
    parser.add_argument("--backend", default="threads", help="default: %(default)s")
    parser.add_argument("--random", type=int, metavar="N", help="forecast N random films, and count how many take as long as "
                        "their intervals say")
    parser.add_argument("--seed", type=int, default=1, help="of the first random film; default: %(default)s")
    parser.add_argument("--platform", metavar="FILE", help="of random films; default: this machine is calibrated first")
    words = parser.parse_args()
    numbers = [int(nodes) for nodes in words.nodes.split(",")]
    if words.random:
        return random_forecasts.compare(words.build, words.random, numbers, words.seed, words.platform)
    programs = os.path.join(words.build, "bin")
    with tempfile.TemporaryDirectory() as folder:
        compare(programs, words.films.split(","), numbers, words.repeats, folder, words.backend)
    compare_remaining(programs, 2, words.repeats)


main()
