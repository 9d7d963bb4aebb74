#!/usr/bin/env python3
"""Memory of the nodes of one machine: the greatest proportional set size, which divides a page by its users.

usage: node_memory.py BINARIES [--nodes 1,2,8] [--size WxH] [--shadows] [--frames N]

Renders s2 (keyframes alone) and s3 (thirty frames, one interval) with adaptive dicing over MPI, without files, and looks
at the processes in /proc while they run. Printed, in MB: the largest node, all nodes, the host.
With --shadows: s3s with 16 samples and three casting lights, a soft sun, a spot and a point; and as last figure what
mars plan says of the whole machine.
docs/floors.md has a table of the results."""
import argparse
import json
import os
import subprocess
import tempfile
import time

EXAMPLES = os.path.dirname(os.path.abspath(__file__))
PAUSE = 0.02  # seconds between two looks
LIGHTS = [{"direction": [-0.4, -0.7, 0.8], "color": [0.4, 0.4, 0.4], "shadow": True, "size": 0.53},
          {"place": [20, -50, 60], "at": [0, -10, 0], "cone": 80, "color": [0.3, 0.3, 0.3], "shadow": True},
          {"place": [-15, 10, 25], "color": [0.3, 0.3, 0.3], "shadow": True}]


def film(name, folder, frames):
    """The scene, diced adaptively, with `frames` frames."""
    with open(os.path.join(EXAMPLES, name + ".json")) as file:
        scene = json.load(file)
    del scene["dice"]
    scene["frames"] = frames
    if name == "s3s":
        scene["samples"] = 16
        scene["lights"] = LIGHTS
    path = os.path.join(folder, name + ".json")
    with open(path, "w") as file:
        json.dump(scene, file)
    return path


def descendants(root):
    """{process: its program} of all that `root` has started, itself among them."""
    parents = {}
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{entry}/stat") as file:
                name, rest = file.read().split("(", 1)[1].rsplit(")", 1)
        except OSError:
            continue
        parents[int(entry)] = (int(rest.split()[1]), name)
    family = {root}
    while any(parent in family and process not in family for process, (parent, _) in parents.items()):
        family |= {process for process, (parent, _) in parents.items() if parent in family}
    return {process: parents[process][1] for process in family if process in parents}


def proportional_bytes(process):
    try:
        with open(f"/proc/{process}/smaps_rollup") as file:
            return next(int(line.split()[1]) * 1024 for line in file if line.startswith("Pss:"))
    except (OSError, StopIteration):
        return 0


def measure(command):
    """The greatest of the largest node, of all nodes and of the host while the command runs."""
    job = subprocess.Popen(command)
    most = [0, 0, 0]
    while job.poll() is None:
        family = descendants(job.pid)
        nodes = [proportional_bytes(process) for process, name in family.items() if name == "mars-node"]
        host = [proportional_bytes(process) for process, name in family.items() if name == "mars-host"]
        most = [max(pair) for pair in zip(most, (max(nodes, default=0), sum(nodes), sum(host)))]
        time.sleep(PAUSE)
    if job.returncode != 0:
        raise SystemExit(f"{command[0]} failed")
    return most


def planned_bytes(binaries, words):
    done = subprocess.run([os.path.join(binaries, "mars"), "plan", *words, "--platform", "reference", "--json"],
                          check=True, capture_output=True)
    return json.loads(done.stdout)["machine_memory"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", metavar="BINARIES", help="folder of the programs, such as build/release/bin")
    parser.add_argument("--nodes", default="1,2,8")
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--frames", type=int, default=30)
    parser.add_argument("--shadows", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for name in ("s3s",) if options.shadows else ("s2", "s3"):
            for nodes in options.nodes.split(","):
                words = [film(name, folder, options.frames), "--nodes", nodes, "--groups", "1", "--sink", "none",
                         "--size", options.size]
                command = [os.path.join(options.binaries, "mars"), "render", *words, "--backend", "mpi", "--quiet"]
                figures = measure(command + (["--no-coherence"] if name == "s2" else []))
                if options.shadows:
                    figures.append(planned_bytes(options.binaries, words))
                print(f"{name}, {options.size}, {nodes} nodes:", *(f"{bytes / 1e6:.0f}" for bytes in figures), flush=True)


if __name__ == "__main__":
    main()
