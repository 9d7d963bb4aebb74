"""Nodes of one machine that take each other for nodes of other machines: each is in a user namespace of its own and so
sees no other's memory. A node dies, or stands still, when it is about to send a message to another: while still lines
or bands of backgrounds go round the ring of machines, while triangles are exchanged, or within a team."""
import pathlib
import shutil
import signal
import subprocess

import film
from death import SIGNALS, Death

NODES, FRAMES = 4, 24
APART = ["unshare", "--user", "--map-root-user"]
WRITERS = ["--write", "nodes"]
# Of each kind of message (planted/death.cpp): what makes nodes send it, and the latest one of which a node may die.
KINDS = {"triangles": ([], 3), "still": ([], 2), "background": (WRITERS, 2), "bands": ([*WRITERS, "--sharers", "2"], 4)}
STOPS = 0.1  # of all deaths: MARS waits 30 s for each


def is_possible():
    return subprocess.run([*APART, "true"], capture_output=True).returncode == 0


def copy_programs(build, folder):
    """A folder of programs whose node puts itself apart."""
    (folder / "real").mkdir(parents=True)
    for name in ("mars", "mars-host", "mars-threads", "mars-loopback.so"):
        shutil.copy(build / "bin" / name, folder)
    shutil.copy(build / "bin" / "mars-node", folder / "real")
    node = folder / "mars-node"
    node.write_text(f"#!/bin/sh\nexec {' '.join(APART)} '{folder}/real/mars-node' \"$@\"\n")
    node.chmod(0o755)
    return folder


def write_film(path):
    """Tall: each node has lines, bands and moving parts."""
    return film.write_film(path, FRAMES, size=(120, 400), dice=8)


def words_for(death):
    return ["--groups", "1", *KINDS[death.moment.partition(":")[0]][0]]


def random_death(chance):
    kind = chance.choice(tuple(KINDS))
    how = signal.SIGSTOP if chance.random() < STOPS else chance.choice(SIGNALS)
    return Death("mars-node", chance.randint(1, NODES), f"{kind}:{chance.randint(1, KINDS[kind][1])}", how)
