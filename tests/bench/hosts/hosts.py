#!/usr/bin/env python3
"""Keyframes on 1, 2 and 4 hosts of a virtual cluster (cluster/testbed, as root), one node a host: milliseconds a
keyframe, best and middle, and what a node sends in one. All hosts share this machine's processors, so only ratios of
one run mean something: builds take turns."""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [os.path.join(HERE, "..", "peers"), os.path.join(HERE, "..", "traffic")]
import films  # noqa: E402
import messages_sent  # noqa: E402
import traffic  # noqa: E402

TESTBED = os.path.join(HERE, "..", "..", "..", "cluster", "testbed", "testbed.sh")
HOSTS = ("n1", "n2", "n3", "n4")  # beside the head, n0
NAME = f"bench-{os.getpid()}"
WARM = 3  # keyframes of each run that do not count


def testbed(*words, **more):
    subprocess.run([TESTBED, *words], env={**os.environ, "TESTBED": NAME}, check=True, **more)


class Cluster:
    """The hosts, whose folder is seen by all: each has a /tmp of its own. Each receives at `rate`; None: at any."""

    def __init__(self, rate):
        self.rate = rate

    def __enter__(self):
        testbed("up", stdout=subprocess.DEVNULL)
        for host in HOSTS if self.rate else ():
            testbed("slow", host, self.rate)
        self.folder = tempfile.TemporaryDirectory(dir="/var/tmp")
        return self

    def __exit__(self, *_):
        testbed("down")
        self.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def render(self, build, film, hosts, *options):
        """The first host has the host process too."""
        with open(self.path("hostfile"), "w") as file:
            file.writelines(f"{host} slots={2 if host == HOSTS[0] else 1}\n" for host in HOSTS[:hosts])
        testbed("exec", HOSTS[0], os.path.join(build, "bin", "mars"), "render", film, "--hostfile",
                self.path("hostfile"), "--nodes", str(hosts), "--groups", "1", "--no-coherence", "--sink", "none",
                "--quiet", *options, cwd=self.folder.name)


def keyframe_times(cluster, build, film, hosts):
    """Milliseconds from each keyframe's arrival to the next one's."""
    report = cluster.path("report.json")
    cluster.render(build, film, hosts, "--report", report)
    with open(report) as file:
        arrivals = sorted(frame["seconds"] for frame in json.load(file)["frames"])
    return [1000 * (b - a) for a, b in zip(arrivals[WARM - 1:], arrivals[WARM:])]


def messages_of(cluster, build, pair, hosts):
    traces = []
    for film in pair:
        cluster.render(build, film, hosts, "--trace", cluster.path("trace.json"))
        traces.append(messages_sent.traced(cluster.path("trace.json")))
    return messages_sent.in_between(*traces, keyframes=1)


def measure(cluster, scene, wanted, builds):
    film = films.load(scene)
    save = lambda frames: films.save(films.lengthened(film, frames), cluster.path(f"{scene}-{frames}.json"))
    long, pair = save(WARM + wanted.keyframes), (save(1), save(2))
    times = {(hosts, name): [] for hosts in wanted.hosts for name in builds}
    for _ in range(wanted.rounds):
        for hosts, name in times:
            times[hosts, name] += keyframe_times(cluster, builds[name], long, hosts)
    for hosts in wanted.hosts:
        shown = "   ".join(f"{name}: {min(times[hosts, name]):.1f} ({statistics.median(times[hosts, name]):.1f})"
                           for name in builds)
        print(f"{scene}, {hosts} {'host' if hosts == 1 else 'hosts'}, ms a keyframe   {shown}")
        messages_sent.show("  a keyframe, a node:", {name: messages_of(cluster, build, pair, hosts)
                                                     for name, build in builds.items()}, hosts)


def main():
    parser = argparse.ArgumentParser(prog="mars bench hosts", description=__doc__)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--against", metavar="BUILD", help="the folder of another build, to be measured in turn")
    parser.add_argument("--scenes", nargs="+", default=["s2"], choices=["s1", "s1m", "s2"])
    parser.add_argument("--hosts", type=int, nargs="+", default=[1, 2, 4], choices=range(1, len(HOSTS) + 1))
    parser.add_argument("--rate", help="at which each host receives, for example 100mbit; default: no limit")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--keyframes", type=int, default=20, help="counted in each run")
    wanted = parser.parse_args()
    builds = traffic.builds_of(wanted)
    with Cluster(wanted.rate) as cluster:
        for scene in wanted.scenes:
            measure(cluster, scene, wanted, builds)


if __name__ == "__main__":
    sys.exit(main())
