"""The same pixels across the hosts of a cluster, however the film is started."""

import pathlib
import re
import shutil

from virtual_cluster import (HOSTS, PROGRAMS, SECONDS, SOURCES, TESTBED, ClusterTest, ProgramTest, events,
                             run_on_cluster, spinning_teapot, start_cluster, testbed, wait_until)

SLURM = SOURCES / "cluster/slurm"


class Rendering(ClusterTest):
    def setUp(self):
        super().setUp()
        self.film = self.write("film.json", spinning_teapot(8, [320, 180]))

    def assertRendered(self, output, nodes):
        """All hosts took part, and drew what one process draws."""
        booted = next((event for event in events(output) if event["event"] == "booted"), None)
        self.assertIsNotNone(booted, output)
        self.assertEqual(len(booted["nodes"]), nodes)
        self.assertEqual(booted["machines"], len(HOSTS))
        self.assertEqual({node["host"] for node in booted["nodes"]}, set(HOSTS))
        self.assertEqual(self.verified_hash("out"), self.alone(self.film))

    def assertShown(self, output, nodes):
        self.assertIn(f"{nodes} nodes on {len(HOSTS)} machines", output)
        self.assertEqual(self.verified_hash("out"), self.alone(self.film))

    def submit(self, script, *options):
        output = self.folder / "job.output"
        job = self.on("n0", "sbatch", "--parsable", "--nodes=4", f"--output={output}",
                      *options, SLURM / script,
                      self.film, "-o", "out").stdout.strip()
        ended = lambda: not self.on("n0", "squeue", "--noheader", f"--jobs={job}").stdout
        wait_until(ended, SECONDS, "the job still runs")
        return output.read_text()

    def mpirun(self, *words):
        """Programs by their paths: what ssh starts has a PATH of its own."""
        words = [PROGRAMS / word if str(word).startswith("mars-") else word for word in words]
        return self.on("n1", "mpirun", "--hostfile", self.hostfile, "--bind-to", "none", *words).stdout

    def test_mpirun_over_ssh(self):
        self.assertRendered(self.mpirun("-n", 1, "mars-host", self.film, "-o", "out", ":", "-n", 7, "mars-node"), 7)

    def test_16_nodes_on_4_hosts(self):
        self.assertRendered(self.mpirun("--oversubscribe", "-n", 1, "mars-host", self.film, "-o", "out", ":", "-n",
                                        16, "mars-node"), 16)

    def test_one_program_by_rank(self):
        self.assertRendered(self.mpirun("-n", 8, "mars-ranks", self.film, "-o", "out"), 7)

    def test_mars_with_a_hostfile(self):
        run = lambda *more: self.on("n1", "mars", "render", self.film, "-o", "out", "--hostfile", self.hostfile,
                                    *more).stdout
        self.assertShown(run(), 7)
        self.assertShown(run("--nodes", 16, "--overwrite"), 16)

    def test_files_of_nodes_on_all_hosts(self):
        run = lambda out, *more, **how: self.on("n1", "mars", "render", self.film, "-o", out, "--hostfile", self.hostfile,
                                                *more, **how)
        run("host")
        run("nodes", "--write", "nodes")
        files = [{path.name: path.read_bytes() for path in (self.folder / each).glob("*.png")} for each in ("host", "nodes")]
        self.assertEqual(len(files[0]), 8)
        self.assertEqual(*files)
        self.assertFalse((self.folder / "nodes/.runs").exists())

    def test_files_of_hosts_that_do_not_see_the_folder(self):
        """The host writes them: of n3, where another folder has the name, and of all hosts but n1."""
        film = self.write("many.json", spinning_teapot(24, [320, 180]))
        run = lambda out, *more: self.on("n1", "mars", "render", film, "-o", out, "--hostfile", self.hostfile,
                                         "--no-coherence", *more).stderr
        files = lambda out: {path.name: path.read_bytes() for path in (self.folder / out).glob("*.png")}
        run("host")
        (self.folder / "nodes").mkdir()
        self.on("n3", "mount", "-t", "tmpfs", "tmpfs", self.folder / "nodes")
        printed = run("nodes", "--write", "nodes", "--groups", 7)
        self.on("n3", "umount", self.folder / "nodes")
        self.assertIn("n3 does not see the folder of frames as the host does: the host composes and writes the frames "
                      "of 2 of the 7 groups", printed)
        self.assertEqual(len(files("host")), 24)
        self.assertEqual(files("nodes"), files("host"))
        printed = run("/tmp/of-each-host-its-own", "--write", "nodes", "--groups", 1)
        self.assertIn("n2, n3 and n4 do not see the folder of frames as the host does: the host composes and writes all "
                      "frames", printed)
        self.on("n1", "cp", "-r", "/tmp/of-each-host-its-own", "copy")
        self.assertEqual(files("copy"), files("host"))

    def test_sbatch_with_mpirun(self):
        self.assertRendered(self.submit("mpirun.sbatch", "--ntasks=8"), 7)

    def test_sbatch_with_srun(self):
        self.assertRendered(self.submit("srun.sbatch", "--ntasks=8"), 7)

    def test_sbatch_with_srun_16_nodes(self):
        self.assertRendered(self.submit("srun.sbatch", "--ntasks=17", "--overcommit"), 16)

    def test_sbatch_with_mars(self):
        self.assertShown(self.submit("render.sbatch", "--ntasks=8"), 7)

    def test_mars_in_an_allocation(self):
        run = lambda *more: self.on("n0", "salloc", "--quiet", "--nodes=4", "--ntasks=8", "mars", "render",
                                    self.film, "-o", "out", *more).stdout
        self.assertShown(run(), 7)
        self.assertShown(run("--nodes", 16, "--overwrite"), 16)

    def test_without_mpirun_no_machine_is_left_out_silently(self):
        render = ["env", "PATH=/without-modules", PROGRAMS / "mars", "render", self.film, "-o", "out"]
        done = self.on("n1", *render, "--hostfile", self.hostfile, code=1)
        self.assertClear(done.stderr, f"mpirun was not found, and {self.hostfile} names other machines")
        done = self.on("n0", "salloc", "--quiet", "--nodes=4", *render, code=1)
        self.assertClear(done.stderr, "mpirun was not found, and the Slurm job has 4 machines")
        self.assertFalse((self.folder / "out").exists())

    def hide(self, host, file):
        """For the rest of the test, nothing of the file can be read or run on the host."""
        self.on(host, "mount", "--bind", "/dev/null", file)
        self.addCleanup(testbed, "exec", host, "umount", file)

    def test_a_library_that_a_machine_lacks(self):
        needed = self.succeed("ldd", PROGRAMS / "mars-node")
        name, library = re.search(r"(libpng\S+) => (\S+)", needed).groups()
        self.hide("n3", pathlib.Path(library).resolve())
        start = ["mars", "render", self.film, "-o", "out", "--hostfile", self.hostfile]
        self.assertClear(self.on("n1", *start, code=1).stderr,
                         f"machine n3: {PROGRAMS}/mars-node cannot load the library ")
        (self.folder / "lib").mkdir()
        shutil.copy(library, self.folder / "lib" / name)
        printed = self.on("n1", "env", f"LD_LIBRARY_PATH={self.folder}/lib", *start).stdout
        self.assertShown(printed, 7)

    def test_a_program_that_a_machine_lacks(self):
        self.hide("n3", PROGRAMS / "mars-node")
        done = self.on("n1", "mars", "render", self.film, "-o", "out", "--hostfile", self.hostfile, code=1)
        self.assertClear(done.stderr, f"machine n3: there is no program {PROGRAMS}/mars-node that can be run")

    def test_the_doctor_sees_every_machine(self):
        look = lambda code: self.on("n0", "salloc", "--quiet", "--nodes=4", "--ntasks=8", "mars", "doctor",
                                    code=code).stdout
        output = look(0)
        self.assertIn("on n1-n4", output)
        self.assertIn("4 machines, 8 tasks", output)
        self.assertIn("ok ports all machines reach each other by TCP", " ".join(output.split()))
        self.assertIn("7 nodes on 4 machines (mpi)", " ".join(output.split()))
        testbed("exec", "n3", "mount", "-o", "remount,size=8m", "/dev/shm")
        self.addCleanup(testbed, "exec", "n3", "mount", "-o", "remount,size=1g", "/dev/shm")
        output = look(1)
        self.assertRegex(output, r"TROUBLE +/dev/shm +n3: 8 MiB")
        self.assertRegex(output, r"/dev/shm +n1,n2,n4: ")


class Checkout(ProgramTest):
    FOLDERS = "/tmp"  # of which every host has its own

    def test_every_host_sees_it_below_tmp(self):
        script = self.folder / "cluster/testbed/testbed.sh"
        script.parent.mkdir(parents=True)
        shutil.copy(TESTBED, script)
        start_cluster(script)
        self.addCleanup(testbed, "down")
        for host in HOSTS:
            seen = testbed("exec", host, "ls", "/tmp", script).stdout.split()
            self.assertEqual(seen, [str(script), "/tmp:", self.folder.name])


if __name__ == "__main__":
    run_on_cluster()
