"""Films that Slurm's jobs draw to their end, whatever Slurm or the machines do meanwhile."""

import pathlib
import re

from virtual_cluster import (HOSTS, SECONDS, ClusterTest, run_on_cluster, spinning_teapot, testbed,
                             wait_until)

SLURM_SECONDS = 150  # until a job has ended and Slurm has begun it again
PAUSE = 0.3          # between questions, which take processors from the job
OUR_PROGRAMS = "mars-host|mars-node|orted"


def begins_again(facts):
    """More than once if it is ended again before anybody looks."""
    return facts["Restarts"] != "0"


class Jobs(ClusterTest):
    def setUp(self):
        super().setUp()
        film = spinning_teapot(120, [320, 180])
        actor = film["actors"][0]
        first, last = actor["keys"]
        actor["keys"] = [dict(first, frame=0), dict(last, frame=40), dict(first, frame=80), dict(last, frame=120)]
        self.film = self.write("film.json", film)
        self.text = self.film.read_text()
        self.intervals = ["--intervals", "keyframes"]

    def crawl(self, host):
        """Until `full_speed` no film ends whose host is on this machine."""
        testbed("slow", host, "1mbit")
        self.addCleanup(self.full_speed, host)

    def full_speed(self, host):
        testbed("slow", host, "full")

    def submit(self, folder, *options, machines=2, **environment):
        """The number of the job, whose film's file is half saved from then on."""
        self.film.write_text(self.text)
        settings = [f"{name}={value}" for name, value in environment.items()]
        done = self.on("n0", "env", *settings, "mars", "submit", self.film, "-o", folder, *self.intervals,
                       "--nodes", machines, "--tasks", 2 * machines, *options)
        self.film.write_text(self.text[:100])
        job = done.stdout.split()[1].strip(",;")
        self.addCleanup(testbed, "exec", "n0", "scancel", job)
        return job

    def facts(self, job):
        """What Slurm says of it: {"JobState": "RUNNING", "Restarts": "0", ...}."""
        words = self.on("n0", "scontrol", "--oneliner", "show", "job", job).stdout.split()
        return dict(word.split("=", 1) for word in words if "=" in word)

    def wait_for(self, job, holds, seconds=SLURM_SECONDS):
        """Until what Slurm says of the job holds."""
        wait_until(lambda: holds(self.facts(job)), seconds, lambda: f"job {job} is {self.facts(job)}; it wrote:\n"
                   + pathlib.Path(self.facts(job)["StdOut"]).read_text(), PAUSE)

    def wait_for_frames(self, folder):
        wait_until(lambda: list((self.folder / folder).glob("*.png")), SECONDS, f"no frame in {folder}")

    def assertCompletes(self, folder):
        """Its job goes on to the last frame, with the pixels that one process draws."""
        output = self.on("n0", "mars", "watch", folder).stdout
        self.assertIn("120 of 120 frames", output)
        self.assertEqual(self.verified_hash(folder), self.pixels())

    def pixels(self):
        if not (self.folder / "alone").exists():
            self.film.write_text(self.text)
            self.succeed("mars", "render", self.film, "-o", "alone", *self.intervals, "--backend", "threads",
                         "--nodes", 1, "--quiet")
        return self.verified_hash("alone")

    def test_a_time_limit_and_a_preemption(self):
        for host in ["n1", "n3"]:
            self.crawl(host)
        limited = self.submit("limited", "--time", 1, SBATCH_SIGNAL="B:USR1@50")
        preempted = self.submit("preempted")
        self.wait_for_frames("preempted")
        self.assertEqual(self.facts(preempted)["NodeList"], "n[3-4]")
        self.on("n0", "sbatch", "--partition=urgent", "--nodelist=n3,n4", "--nodes=2", "--output=/dev/null",
                "--wrap=true")
        self.wait_for(limited, begins_again)
        self.on("n0", "scontrol", "update", f"JobId={limited}", "TimeLimit=30")
        self.wait_for(preempted, begins_again)
        for host in ["n1", "n3"]:
            self.full_speed(host)
        for folder in ["limited", "preempted"]:
            self.assertCompletes(folder)
        self.assertIn("queued again", (self.folder / f"limited/.slurm/{limited}.out").read_text())
        self.assertEqual([self.facts(job)["JobState"] for job in (limited, preempted)], ["COMPLETED"] * 2)

    def test_an_array_while_a_machine_is_drained(self):
        for host in ["n1", "n3"]:
            self.crawl(host)
        job = self.submit("out", "--array", 2)
        self.wait_for_frames("out")
        self.on("n0", "scontrol", "update", "NodeName=n2", "State=DRAIN", "Reason=test")
        self.addCleanup(testbed, "exec", "n0", "scontrol", "update", "NodeName=n2", "State=RESUME")
        output = self.on("n0", "mars", "status", "out").stdout
        self.assertRegex(output, rf"job {job}_0: running on n\[(1-2|3-4)\] for ")
        self.assertRegex(output, r"run on n[13] \(process \d+\): ")
        for host in ["n1", "n3"]:
            self.full_speed(host)
        self.assertCompletes("out")
        script = (self.folder / "out/.slurm/job.sbatch").read_text()
        self.assertIn("frames=(0-59 60-119)", script)
        self.assertEqual(self.facts(f"{job}_0")["Restarts"], "0")

    def test_an_environment_that_is_not_handed_on(self):
        """Without PATH no step of a job starts; that is no loss of machines."""
        job = self.submit("out", "--sbatch", "--export=NONE")
        self.assertCompletes("out")
        self.wait_for(job, lambda facts: facts["JobState"] == "COMPLETED")
        self.assertEqual(self.facts(job)["Restarts"], "0")

    def test_starts_without_a_new_frame_end(self):
        self.write("stops.sh", "mars() { sleep 1; kill -USR1 $$; sleep 60; return 1; }\n")
        job = self.submit("out", "--restarts", 1, "--prologue", "stops.sh")
        self.wait_for(job, lambda facts: facts["JobState"] == "FAILED", 2 * SLURM_SECONDS)
        self.assertEqual(self.facts(job)["Restarts"], "1")
        self.assertIn("restarts in a row without one: 1;", (self.folder / f"out/.slurm/{job}.out").read_text())

    def test_cancel(self):
        self.crawl("n1")
        job = self.submit("out")
        self.wait_for_frames("out")
        output = self.on("n0", "mars", "cancel", "out").stdout
        self.assertIn(f"job {job} has ended\nout: ", output)
        self.assertRegex(output, r"out: \d+ of 120 frames of ")
        self.assertEqual(self.facts(job)["JobState"], "CANCELLED")
        for host in HOSTS:
            self.assertEqual(testbed("exec", host, "pgrep", "-f", OUR_PROGRAMS).stdout, "", host)
        self.assertEqual(self.on("n0", "mars", "cancel", "out").stdout.splitlines()[0], "no job is left to cancel")

    def test_y_a_lost_machine(self):
        """The last tests by their names: their machines are gone for good."""
        self.crawl("n1")
        job = self.submit("out")
        self.wait_for_frames("out")
        testbed("kill", "n2")
        self.wait_for(job, lambda facts: begins_again(facts) or self.left_out("n2"), SECONDS)
        self.full_speed("n1")
        self.assertCompletes("out")

    def left_out(self, host):
        """In an allocation that goes on."""
        return not re.search(rf"\b{host}\b", self.on("n0", "mars", "status", "out").stdout)

    def test_z_the_first_machine_is_lost(self):
        """The second one notices, without variables of a person's shell."""
        for host in HOSTS:
            self.crawl(host)
        job = self.submit("out", "--sbatch", "--export=NONE")
        self.wait_for_frames("out")
        lost = self.facts(job)["BatchHost"]
        testbed("kill", lost)
        self.wait_for(job, lambda facts: begins_again(facts) and facts["JobState"] == "RUNNING")
        self.assertNotEqual(self.facts(job)["BatchHost"], lost)
        self.full_speed(self.facts(job)["BatchHost"])
        self.assertCompletes("out")


if __name__ == "__main__":
    run_on_cluster()
