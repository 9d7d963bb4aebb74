#!/usr/bin/env python3
"""What a killed node costs: a film rendered undisturbed, and with one node killed when half of the frames are there; by
one job of two groups, and by two jobs of one group each, which share the folder. Seconds from start to end, megabytes of
all processes together (proportional set size), messages, and how long a job takes to be there again. With --cluster on
the four hosts of a virtual cluster (cluster/testbed, as root). All processes share this machine's processors: what is
left after a death has as many as before, so the ideal is the undisturbed run."""
import argparse
import collections
import glob
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [os.path.join(HERE, "..", folder) for folder in ("peers", "traffic", "hosts")]
import films  # noqa: E402
import hosts  # noqa: E402
import messages_sent  # noqa: E402

Run = collections.namedtuple("Run", "seconds megabytes again")  # again: from the death until the first frame after it


def processes(folder, programs=None):
    """Those that work in the folder, on whichever host of this machine."""
    for path in glob.glob("/proc/[0-9]*"):
        try:
            program = os.path.basename(os.readlink(path + "/exe"))
            if os.readlink(path + "/cwd") == folder and (not programs or program in programs):
                yield int(path[len("/proc/"):])
        except OSError:
            continue


def megabytes(process):
    try:
        with open(f"/proc/{process}/smaps_rollup") as rollup:
            return sum(int(line.split()[1]) for line in rollup if line.startswith("Pss:")) / 1024
    except (OSError, ProcessLookupError):
        return 0


def frame_times(out):
    times = []
    for entry in os.scandir(out) if os.path.isdir(out) else []:
        if entry.name.endswith(".png"):
            times.append(entry.stat().st_mtime)
    return times


class Bench:
    def __init__(self, wanted, folder, cluster):
        self.mars = os.path.join(wanted.build, "bin", "mars")
        self.folder, self.cluster, self.wanted = folder, cluster, wanted
        self.out = os.path.join(folder, "out")

    def jobs(self, count):
        """The command lines: one job of all nodes, or one for each half of the film."""
        half, nodes = self.wanted.frames // 2, self.wanted.nodes
        lines = [(f"0-{self.wanted.frames - 1}", nodes, "2", hosts.HOSTS)]
        if count == 2:
            lines = [(f"0-{half - 1}", nodes // 2, "1", hosts.HOSTS[:2]),
                     (f"{half}-{self.wanted.frames - 1}", nodes // 2, "1", hosts.HOSTS[2:])]
        for frames, nodes, groups, machines in lines:
            words = [self.mars, "render", "film.json", "-o", "out", "--frames", frames, "--nodes", str(nodes), "--groups",
                     groups, "--backend", "mpi"]
            if self.cluster:
                file = os.path.join(self.folder, f"hosts-{machines[0]}")
                with open(file, "w") as hostfile:
                    hostfile.writelines(f"{machine} slots={nodes // len(machines) + 1}\n" for machine in machines)
                words = [hosts.TESTBED, "exec", machines[0], *words, "--hostfile", file]
            yield words

    def start(self, count, *more):
        environment = {**os.environ, "TESTBED": hosts.NAME}
        return [subprocess.Popen([*words, *more], cwd=self.folder, env=environment, stdout=subprocess.DEVNULL)
                for words in self.jobs(count)]

    def run(self, count, kill):
        shutil.rmtree(self.out, ignore_errors=True)
        began, died, most = time.time(), None, 0.0
        jobs = self.start(count)
        while any(job.poll() is None for job in jobs):
            time.sleep(0.1)
            if died is None:
                most = max(most, sum(megabytes(process) for process in processes(self.folder)))
            if kill and died is None and len(frame_times(self.out)) >= self.wanted.frames // 2:
                os.kill(max(processes(self.folder, ["mars-node"])), 9)
                died = time.time()
        seconds = time.time() - began
        if any(job.returncode for job in jobs):
            raise SystemExit("a rendering failed")
        subprocess.run([self.mars, "verify", "out"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        return Run(seconds, most, self.gap(died) if died else 0)

    def gap(self, died):
        """The longest time without a frame from the death on."""
        times = [died] + sorted(at for at in frame_times(self.out) if at > died)
        return max((b - a for a, b in zip(times, times[1:])), default=0)

    def messages(self, count):
        shutil.rmtree(self.out, ignore_errors=True)
        sent = 0
        for number, words in enumerate(self.jobs(count)):
            trace = os.path.join(self.folder, f"trace-{number}.json")
            subprocess.run([*words, "--trace", trace], cwd=self.folder, check=True, stdout=subprocess.DEVNULL,
                           env={**os.environ, "TESTBED": hosts.NAME})
            sent += sum(each.messages for each in messages_sent.traced(trace).values())
        return sent


def show(name, runs):
    seconds = [run.seconds for run in runs]
    line = f"  {name:34} {min(seconds):6.1f} s ({statistics.median(seconds):.1f})"
    if any(run.again for run in runs):
        line += f"   without a frame {min(run.again for run in runs):.1f} s ({statistics.median(run.again for run in runs):.1f})"
    else:
        line += f"   {statistics.median(run.megabytes for run in runs):.0f} MB"
    print(line, flush=True)


def measure(bench, wanted):
    kinds = [(1, False), (1, True), (2, False), (2, True)]
    runs = {kind: [] for kind in kinds}
    for _ in range(wanted.rounds):
        for count, kill in kinds:
            runs[count, kill].append(bench.run(count, kill))
    for count in (1, 2):
        name = "one job of two groups" if count == 1 else "a job for each group"
        show(name, runs[count, False])
        show(name + ", a node killed", runs[count, True])
        ratios = [killed.seconds / whole.seconds for whole, killed in zip(runs[count, False], runs[count, True])]
        print(f"  {'':34} {min(ratios):6.2f} ({statistics.median(ratios):.2f}) of the ideal", flush=True)
        print(f"  {'':34} {bench.messages(count)} messages", flush=True)


def main():
    parser = argparse.ArgumentParser(prog="mars bench restarts", description=__doc__)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--cluster", action="store_true", help="on a virtual cluster, as root")
    parser.add_argument("--scene", default="s3")
    parser.add_argument("--frames", type=int, default=480)
    parser.add_argument("--nodes", type=int, default=8)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--size", type=int, nargs=2, default=[960, 540], metavar=("WIDTH", "HEIGHT"))
    wanted = parser.parse_args()
    film = films.lengthened(films.load(wanted.scene, wanted.size), wanted.frames)
    where = "four virtual hosts" if wanted.cluster else "one machine"
    print(f"{wanted.scene}, {wanted.frames} frames, {wanted.nodes} nodes on {where}; best (middle) of {wanted.rounds}")
    if wanted.cluster:
        with hosts.Cluster() as cluster:
            films.save(film, cluster.path("film.json"))
            measure(Bench(wanted, cluster.folder.name, True), wanted)
        return
    with tempfile.TemporaryDirectory() as folder:
        films.save(film, os.path.join(folder, "film.json"))
        measure(Bench(wanted, folder, False), wanted)


if __name__ == "__main__":
    sys.exit(main())
