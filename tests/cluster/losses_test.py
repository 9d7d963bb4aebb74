"""A cluster that loses processes, hosts and cables in the middle of a film: the film goes on without them, to the same
pixels; without restarts, soon one clear end, on every host."""

import json
import subprocess

from virtual_cluster import (CLUSTER, HOSTS, PROGRAMS, SECONDS, TESTBED, ClusterTest, complaints, run_on_cluster,
                             spinning_teapot, testbed, wait_until)

ENDLESS = 100000  # frames
LONG = 2000
SOON = 15       # where the loss shows
SILENCE = 60    # where only silence shows it: 25 seconds until it is believed
OUR_PROGRAMS = ["mars-host", "mars-node", "orted"]


class Losses(ClusterTest):
    def start(self, frames, *options):
        self.film = self.write("film.json", spinning_teapot(frames, [160, 90]))
        command = ["mars", "render", self.film, "-o", "out", "--hostfile", self.hostfile, *options]
        self.process = subprocess.Popen([TESTBED, "exec", "n1", *map(str, command)], cwd=self.folder, env=CLUSTER, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(self.process.kill)
        out = self.folder / "out"
        begun = lambda: self.process.poll() is not None or len(list(out.glob("*.png"))) > 3
        wait_until(begun, SECONDS, "no frame")
        if self.process.poll() is not None:
            self.fail("it ended too soon: " + self.process.stderr.read())
        self.assertTrue(all(self.processes(host, "mars-node") for host in HOSTS))

    def processes(self, host, *programs):
        done = testbed("exec", host, "pgrep", "-d", " ", "-f", "|".join(programs))
        return [int(process) for process in done.stdout.split()]

    def assertEnds(self, says, seconds, hosts):
        """One clear message that holds `says`, given back; nothing of ours goes on on `hosts`, and no frame is torn."""
        _, output = self.process.communicate(timeout=seconds)
        self.assertEqual(self.process.returncode, 1, output)
        self.assertClear(output, says)
        for host in hosts:
            wait_until(lambda: not self.processes(host, *OUR_PROGRAMS), seconds, f"something still runs on {host}")
        self.assertNothingTorn(self.folder / "out")
        return output

    def assertGoesOn(self, says, hosts=HOSTS):
        """All frames with the pixels of one process; nothing of ours goes on on `hosts`."""
        printed, said = self.process.communicate(timeout=SILENCE + SECONDS)
        self.assertEqual((self.process.returncode, complaints(said)), (0, ""), printed)
        self.assertRegex(printed, says)
        for host in hosts:
            wait_until(lambda: not self.processes(host, *OUR_PROGRAMS), SOON, f"something still runs on {host}")
        self.assertEqual(self.verified_hash("out"), self.alone(self.film))

    def test_a_killed_node(self):
        self.start(ENDLESS, "--restarts", 0)
        testbed("exec", "n3", "kill", "-9", self.processes("n3", "mars-node")[0])
        self.assertEnds("machine n3: node 2 was killed by signal 9", SOON, HOSTS)

    def assertRefused(self, film, says):
        """At once, though Open MPI reports connections that broke."""
        done = testbed("exec", "n1", "mars", "render", film, "-o", "out", "--hostfile", self.hostfile, cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertNotIn("starting again", done.stdout)
        self.assertClear(done.stderr, says)
        self.assertNotIn("frames are there", done.stderr)

    def test_a_misspelt_key_is_no_loss(self):
        film = self.write("film.json", dict(spinning_teapot(8, [160, 90]), camrea=1))
        self.assertRefused(film, "camrea: is no key of a film (did you mean 'camera'?)")

    def test_a_folder_that_another_run_claims_is_no_loss(self):
        film = self.write("film.json", spinning_teapot(ENDLESS, [160, 90]))
        claims = ["mars", "render", film, "-o", "out", "--backend", "threads", "--nodes", "1"]
        claiming = subprocess.Popen([TESTBED, "exec", "n1", *map(str, claims)], cwd=self.folder, env=CLUSTER,
                                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(claiming.wait, SECONDS)
        self.addCleanup(testbed, "exec", "n1", "pkill", "-TERM", "-x", "mars")
        wait_until(lambda: list((self.folder / "out").glob("*.png")), SECONDS, "no frame")
        self.assertRefused(film, "another run, process")

    def test_goes_on_after_a_killed_node(self):
        self.start(LONG)
        testbed("exec", "n3", "kill", "-9", self.processes("n3", "mars-node")[0])
        self.assertGoesOn(r"machine n3: node 2 was killed by signal 9 .*\n"
                          r"starting again \(1 of 5\) with 7 nodes on 4 machines; ")

    def test_what_a_machine_kept_for_killed_processes_goes_with_the_next_job(self):
        kept = lambda: testbed("exec", "n3", "find", "/tmp", "/dev/shm", "(", "-name", "jf.*", "-o", "-name",
                               "vader_segment.*", ")").stdout.split()
        self.start(ENDLESS, "--restarts", 0)
        testbed("exec", "n3", "kill", "-9", *self.processes("n3", *OUR_PROGRAMS))
        self.process.communicate(timeout=SILENCE)
        left = kept()
        self.assertEqual({path.split("/")[-1].split(".")[0] for path in left}, {"jf", "vader_segment"})
        film = self.write("short.json", spinning_teapot(2, [160, 90]))
        self.on("n1", "mars", "render", film, "-o", "short", "--hostfile", self.hostfile)
        self.assertEqual([path for path in kept() if path in left], [])

    def test_a_stopped_film(self):
        self.start(ENDLESS)
        testbed("exec", "n1", "pkill", "-TERM", "-x", "mars")
        self.assertEnds("stopped by Terminated", SOON, HOSTS)

    def test_a_stop_counts_all_files_that_nodes_have_written(self):
        self.start(ENDLESS, "--write", "nodes", "--no-coherence", "--groups", 7)
        testbed("exec", "n1", "pkill", "-TERM", "-x", "mars")
        said = self.assertEnds("stopped by Terminated", SOON, HOSTS)
        files = len(list((self.folder / "out").glob("frame-*.png")))
        self.assertIn(f"after {files} of {ENDLESS} frames", said)
        checked = self.on("n1", "mars", "verify", "out", code=1).stdout
        self.assertIn(f"{ENDLESS - files} of {ENDLESS} frames are missing or wrong", checked)

    def test_a_killed_mars(self):
        self.start(ENDLESS)
        testbed("exec", "n1", "pkill", "-KILL", "-x", "mars")
        self.process.communicate(timeout=SOON)
        for host in HOSTS:
            wait_until(lambda: not self.processes(host, *OUR_PROGRAMS), SOON, f"something still runs on {host}")

    def test_goes_on_without_a_host_that_is_cut_off(self):
        self.start(LONG)
        testbed("cut", "n3")
        self.addCleanup(testbed, "join", "n3")
        self.assertGoesOn(r"machine n3: does not answer any more\n"
                          r"starting again \(1 of 5\) with 5 nodes on 3 machines, without n3; ")

    def test_z_goes_on_without_a_host_that_has_no_power(self):
        """The last test of the class by its name: the host is gone for good. Open MPI does not always tell which."""
        self.start(LONG)
        testbed("kill", "n4")
        self.assertGoesOn(r"starting again \(1 of 5\) with 5 nodes on 3 machines, without n4; ", HOSTS[:3])

    def test_a_firewall_is_found_and_named(self):
        """By mars doctor, and by a run that waits for its nodes, which would wait for two minutes."""
        says = "n1,n2,n4 cannot reach n3 by TCP: packets are dropped"
        testbed("firewall", "n3")
        self.addCleanup(testbed, "lift", "n3")
        printed = self.on("n1", "mars", "doctor", "--hostfile", self.hostfile, code=1).stdout
        self.assertIn(says, " ".join(printed.split()))
        output = self.folder / "printed.txt"
        film = self.write("film.json", spinning_teapot(8, [160, 90]))
        with output.open("w") as file:
            process = subprocess.Popen(
                [TESTBED, "exec", "n1", "mars", "render", film, "-o", "out", "--hostfile", self.hostfile],
                cwd=self.folder, env=CLUSTER, stdout=file, stderr=subprocess.STDOUT)
        self.addCleanup(process.kill)
        wait_until(lambda: says in output.read_text() or process.poll() is not None, SECONDS, output.read_text)
        self.assertIn(says, output.read_text())
        testbed("exec", "n1", "pkill", "-TERM", "-x", "mars")
        self.assertEqual(process.wait(timeout=SOON), 1, output.read_text())

    def test_a_film_on_a_slow_cable(self):
        film = self.write("film.json", spinning_teapot(8, [320, 180]))
        testbed("slow", "n3", "5mbit")
        self.on("n1", "mars", "render", film, "-o", "out", "--hostfile", self.hostfile)
        testbed("slow", "n3", "full")
        self.assertEqual(self.verified_hash("out"), self.alone(film))

    def test_a_node_that_sends_slowly_holds_up_no_other(self):
        """Each node draws whole frames for itself, and those of n3 take long to the host."""
        film = self.write("film.json", spinning_teapot(24, [640, 360]))
        limit = ["tc", "qdisc", "add", "dev", "eth0", "root", "tbf", "rate", "6mbit", "burst", "64kb", "latency", "400ms"]
        self.on("n3", *limit)
        self.on("n1", "mpirun", "--bind-to", "none", "--host", "n1,n2,n3", "--map-by", "node",
                "-n", 1, PROGRAMS / "mars-host", film, "-o", "out", "--no-coherence", "--groups", 2,
                "--report", "report.json", ":", "-n", 2, PROGRAMS / "mars-node")
        self.on("n3", "tc", "qdisc", "del", "dev", "eth0", "root")
        frames = json.loads((self.folder / "report.json").read_text())["frames"]
        slow = sum(frame["nodes"][0]["node"] == 1 for frame in frames)
        self.assertLessEqual(slow, 6, "the other node's frames waited for this one's")
        self.assertEqual(self.verified_hash("out"), self.alone(film))


if __name__ == "__main__":
    run_on_cluster()
