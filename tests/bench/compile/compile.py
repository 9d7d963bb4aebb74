#!/usr/bin/env python3
"""How long a film of very many moving segments takes to be read and compiled, and
how much memory. Every joint of every figure turns all the time, keyed every 100
frames, and every figure walks, so that each segment has a T-matrix of its own
in each frame. Printed: seconds and gigabytes of `mars info`, which compiles and
writes nothing."""
import argparse
import math
import os
import resource
import subprocess
import sys
import tempfile
import time

KEY_EVERY = 100


def joint(number):
    place = "" if number == 0 else f', "parent": "j{number - 1}", "place": [0.2, 0, 0]'
    return f'{{"name": "j{number}"{place}, "segment": {{"shape": "box", "sbb": [[0, -0.1, -0.1], [0.2, 0.1, 0.1]]}}}}'


def key(figure, frame, joints, hinges):
    angle = lambda n: round(30 * math.sin(0.7 * n + figure + 0.01 * frame), 3)
    pose = ", ".join(f'"j{n}": [0, {angle(n)}, 0]' if hinges else f'"j{n}": [{angle(n)}, {angle(n + 1)}, {angle(n + 2)}]'
                     for n in range(joints))
    return f'{{"frame": {frame}, "place": [{figure}, {frame / 10}, 0], "pose": {{{pose}}}}}'


def write_film(path, figures, joints, frames, hinges):
    limits = ', "limits": {"y": [-90, 90]}' if hinges else ""
    chain = ",\n".join(joint(n)[:-1] + limits + "}" for n in range(joints))
    with open(path, "w") as file:
        file.write(f'{{"frames": {frames}, "camera": {{"eye": [0, -99, 9]}},\n"models": {{"chain": {{"joints": [{chain}]}}}},'
                   '\n"actors": [')
        for figure in range(figures):
            keys = ",\n".join(key(figure, frame, joints, hinges) for frame in range(0, frames + KEY_EVERY, KEY_EVERY))
            file.write((",\n" if figure else "") + f'{{"name": "f{figure}", "model": "chain", "keys": [{keys}]}}')
        file.write("]}\n")


def measure(mars, path):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    output = subprocess.run([mars, "info", path], check=True, stdout=subprocess.PIPE, text=True).stdout
    seconds = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    matrices = next(int(line.split()[1]) for line in output.splitlines() if line.startswith("matrices"))
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, processor, after.ru_maxrss / 1e6, matrices


def main():
    parser = argparse.ArgumentParser(prog="mars bench compile", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--segments", type=int, default=100_000)
    parser.add_argument("--joints", type=int, default=100, help="of one figure")
    parser.add_argument("--frames", type=int, nargs="+", default=[10, 100, 500],
                        help="lengths of the films; 1000 frames of 100000 segments need about 11 GB")
    parser.add_argument("--hinges", action="store_true", help="joints with one freedom")
    wanted = parser.parse_args()
    mars = os.path.join(wanted.build, "bin", "mars")
    print(f"{wanted.segments} segments, {wanted.joints} a figure\n frames   matrices   seconds  processor seconds      GB")
    with tempfile.TemporaryDirectory() as folder:
        for frames in sorted(wanted.frames):
            path = os.path.join(folder, "film.json")
            write_film(path, wanted.segments // wanted.joints, wanted.joints, frames, wanted.hinges)
            seconds, processor, gigabytes, matrices = measure(mars, path)
            print(f"{frames:7d} {matrices:10d} {seconds:9.2f} {processor:18.2f} {gigabytes:7.2f}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
