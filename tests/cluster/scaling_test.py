"""Scaling studies on a cluster: by sbatch, and one that names the host that is slow."""

import json
import re
import subprocess

from virtual_cluster import CLUSTER, HOSTS, SECONDS, SOURCES, TESTBED, ClusterTest, run_on_cluster, wait_until

# On a host: lets its nodes run a sixteenth of the time, as long as the file SLOW is there.
HOLD = """
import os, signal, time
def send(what):
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            if open(f"/proc/{process}/comm").read() == "mars-node\\n":
                os.kill(int(process), what)
        except OSError:
            pass  # it has ended
while os.path.exists("SLOW"):
    send(signal.SIGSTOP)
    time.sleep(0.15)
    send(signal.SIGCONT)
    time.sleep(0.01)
"""
EXAMPLES = SOURCES / "examples"
SMALL = ["--study", "strong", "--backend", "mpi", "-o", "study"]


class Scaling(ClusterTest):
    def runs(self):
        """Of the study, those that count."""
        _, *lines = map(json.loads, (self.folder / "study/runs.jsonl").read_text().splitlines())
        return [line for line in lines if line["repeat"] > 0]

    def hosts_of(self, run):
        return {node["host"] for node in run["per_node"]}

    def test_a_study_by_sbatch(self):
        output = self.folder / "job.output"
        job = self.on("n0", "sbatch", "--parsable", "--nodes=4", "--ntasks=8", f"--output={output}",
                      SOURCES / "cluster/slurm/scaling.sbatch", EXAMPLES / "teapot.json", *SMALL, "--nodes", "1,7",
                      "--repeats", "2", "--", "--frames", "0-3").stdout.strip()
        ended = lambda: not self.on("n0", "squeue", "--noheader", f"--jobs={job}").stdout
        wait_until(ended, SECONDS, "the job still runs")
        runs = self.runs()
        self.assertEqual(len(runs), 4, output.read_text())
        for run in runs:
            self.assertEqual(self.hosts_of(run), set(HOSTS) if run["nodes"] == 7 else {"n1"})
            self.assertEqual(run["environment"]["variables"]["SLURM_JOB_ID"], job)
            self.assertEqual(run["environment"]["processors"], 8)

    def test_a_slow_host_is_named(self):
        slow = self.write("SLOW", "")
        holder = subprocess.Popen([TESTBED, "exec", "n3", "python3", "-c", HOLD], cwd=self.folder, env=CLUSTER)
        self.addCleanup(holder.wait)
        self.addCleanup(slow.unlink, missing_ok=True)
        hostfile = self.write("hosts", "n1 slots=2\nn2 slots=1\nn3 slots=1\nn4 slots=1\n")
        output = self.on("n1", "mars", "bench", "scaling", EXAMPLES / "s3.json", *SMALL, "--hostfile", hostfile,
                         "--nodes", "4", "--repeats", "6", "--warm-up", "0", "--size", "320x180", "--dice", "32", "--",
                         "--frames", "0-2", "--no-coherence").stdout
        slow.unlink()
        self.assertEqual([self.hosts_of(run) for run in self.runs()], [set(HOSTS)] * 6)
        # The slowest comes first. On a busy machine others may be slower than the rest, too, as the host's is.
        named = re.findall(r"\n(n\d) is slow: it takes \d+\.\d\d times as long as the others", output)
        self.assertEqual(named[:1], ["n3"], output)


if __name__ == "__main__":
    run_on_cluster()
