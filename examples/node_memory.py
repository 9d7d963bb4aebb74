#!/usr/bin/env python3
"""Memory of the nodes of one machine: the greatest proportional set size, which divides a page by its users.

usage: node_memory.py BINARIES [--nodes 1,2,8] [--size WxH]

Renders s2 (keyframes alone) and s3 (thirty frames, one interval) with adaptive dicing over MPI, without files, and looks
at the processes in /proc while they run. Printed, in MB: the largest node, all nodes, the host.
docs/floors.md has a table of the results."""
import argparse
import json
import os
import subprocess
import tempfile
import time

EXAMPLES = os.path.dirname(os.path.abspath(__file__))
PAUSE = 0.02  # seconds between two looks


def film(name, folder):
    """The scene, diced adaptively, with thirty frames."""
    with open(os.path.join(EXAMPLES, name + ".json")) as file:
        scene = json.load(file)
    del scene["dice"]
    scene["frames"] = 30
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", metavar="BINARIES", help="folder of the programs, such as build/release/bin")
    parser.add_argument("--nodes", default="1,2,8")
    parser.add_argument("--size", default="1920x1080")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for name in ("s2", "s3"):
            for nodes in options.nodes.split(","):
                command = [os.path.join(options.binaries, "mars"), "render", film(name, folder), "--nodes", nodes,
                           "--backend", "mpi", "--groups", "1", "--sink", "none", "--size", options.size, "--quiet"]
                figures = measure(command + (["--no-coherence"] if name == "s2" else []))
                print(f"{name}, {options.size}, {nodes} nodes:", *(f"{bytes / 1e6:.0f}" for bytes in figures), flush=True)


if __name__ == "__main__":
    main()
