#!/usr/bin/env python3
"""Processor seconds that a film costs with more and more nodes on this machine: what waiting costs.

usage: processor_time.py BINARIES FILM [--nodes 1,2,4,8,16,32] [--repeat N] [mars render's options]

Of all processes together, as the system counts them. "start" is what a run of the first frame alone at 16x9
pixels costs, nearly all of it MPI's own start; "work" is the rest. Each is the least of the runs."""
import argparse
import os
import resource
import subprocess
import sys
import tempfile


def seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryDirectory() as folder:  # of this run alone: frames that are there would not be drawn again
        run = subprocess.run([*command, "-o", os.path.join(folder, "frames")])
    if run.returncode:
        sys.exit(run.returncode)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def least(repeat, command):
    return min(seconds(command) for _ in range(repeat))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries")
    parser.add_argument("film")
    parser.add_argument("--nodes", default="1,2,4,8,16,32")
    parser.add_argument("--repeat", type=int, default=3)
    wanted, options = parser.parse_known_args()
    print("nodes    whole    start     work   work / one node's")
    base = [os.path.join(wanted.binaries, "mars"), "render", wanted.film, "--quiet"]
    one = None
    for nodes in wanted.nodes.split(","):
        whole = least(wanted.repeat, base + ["--nodes", nodes, *options])
        start = least(wanted.repeat, base + ["--nodes", nodes, "--frames", "0", "--size", "16x9"])
        one = one or whole - start
        print(f"{nodes:>5} {whole:8.2f} {start:8.2f} {whole - start:8.2f} {(whole - start) / one:8.2f}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
