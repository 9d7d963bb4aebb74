"""The host, or nodes, compose frames and write their files. The files are the same byte for byte, also where
writers are killed, the film is edited and a run goes on with the other way."""

import json
import os
import random
import shutil
import signal
import subprocess

from harness import (ENVIRONMENT, EXAMPLES, OWN_MPIRUN, PROGRAMS, SECONDS, ProgramTest, SideBySide, complaints,
                     endless_film, family, kill, main, needs, needs_mpi, send, spinning_teapot, wait_until)

NODES = ["--write", "nodes"]
FRAMES = 20


def films():
    """A mover before what stands still; the same smoothly; everything moves; several intervals."""
    demo = json.loads((EXAMPLES / "demo.json").read_text())
    demo["size"] = [200, 120]
    yield "demo", demo, ["--frames", "0-9", "--samples", 1]
    yield "smooth", demo, ["--frames", "0-3", "--samples", 4]
    yield "teapot", spinning_teapot(FRAMES, [161, 97]), ["--frames", "0-9"]
    yield "long", spinning_teapot(FRAMES, [33, 2000]), ["--frames", "0-3"]


class Writers(SideBySide, ProgramTest):
    def files(self, folder):
        return {path.name: path.read_bytes() for path in (self.folder / folder).glob("frame-*")}

    def written(self, folder):
        return len(list((self.folder / folder).glob("frame-*")))

    def recorded(self):
        return sum(log.read_text().count("\n") for log in (self.folder / "out/.runs").glob("*.hashes"))

    def render(self, film, folder, *words, **more):
        return self.mars("render", film, "-o", folder, "--quiet", *words, **more)

    def write_film(self, name, film):
        copy = dict(film)
        if (EXAMPLES / "models").exists() and not (self.folder / "models").exists():
            os.symlink(EXAMPLES / "models", self.folder / "models")
        return self.write(f"{name}.json", copy)

    def test_files_are_the_same_for_every_division(self):
        chance = random.Random(29)
        forms = iter([["--alpha"], ["--format", "exr", "--alpha"], ["--format", "exr", "--compression", "piz"],
                      ["--format", "png16", "--alpha"]])
        for name, film, words in films():
            path = self.write_film(name, film)
            for form in (["--format", "png"], next(forms)):
                wanted = f"{name}-{''.join(form)}"
                alone = ["--backend", "threads", "--nodes", 1, *words, *form]
                self.assertEqual(self.render(path, wanted, *alone).returncode, 0)
                for nodes in (chance.choice([1, 2]), chance.choice([3, 4, 5])):
                    how = ["--backend", "threads", "--nodes", nodes, "--groups", chance.randint(1, nodes),
                           "--sharers", chance.randint(1, nodes), *chance.choice([[], ["--cut", 4]]), *words,
                           *form, *chance.choice([[], ["--no-coherence"]])]
                    done = self.render(path, "nodes", *NODES, *how, "--overwrite", "--report", "report.json")
                    self.assertEqual((done.returncode, complaints(done.stderr)), (0, ""), (name, how))
                    self.assertEqual(self.files("nodes"), self.files(wanted), (name, how))
                    host = json.loads((self.folder / "report.json").read_text())["host"]
                    self.assertEqual((host["files"], host["node_files"]), (0, len(self.files(wanted))))
                    self.assertIn("all there and whole", self.succeed("mars", "verify", "nodes"))
                    shutil.rmtree(self.folder / "nodes")

    @needs_mpi
    def test_over_mpi_with_little_memory(self):
        path = self.write_film("demo", {**next(films())[1], "size": [200, 60]})
        self.render(path, "wanted", "--backend", "threads", "--nodes", 1, "--frames", "0-3")
        done = self.render(path, "nodes", *NODES, "--backend", "mpi", "--nodes", 3, "--frames", "0-3", "--report",
                           "report.json", env=dict(ENVIRONMENT, MARS_MEMORY="1"))
        self.assertEqual((done.returncode, complaints(done.stderr)), (0, ""))
        self.assertEqual(self.files("nodes"), self.files("wanted"))
        frames = json.loads((self.folder / "report.json").read_text())["frames"]
        self.assertGreater(min(node["work"]["passes"] for frame in frames for node in frame["nodes"]), 1)

    @needs_mpi
    def test_groups_that_do_not_see_the_folder_leave_it_to_the_host(self):
        """A node in namespaces of its own, where another folder has the name."""
        apart = ["unshare", "--user", "--map-root-user", "--mount"]
        if self.run_program(*apart, "mount", "-t", "tmpfs", "none", "/mnt").returncode != 0:
            self.skipTest("no user namespaces here")
        path = self.write_film("demo", next(films())[1])
        self.render(path, "wanted", "--backend", "threads", "--nodes", 1, "--frames", "0-1")
        all_says = {2: "the frames of 1 of the 2 groups of nodes, which have nodes there",
                    1: "all frames, for every group of nodes has nodes there; see --groups"}
        for groups, says in all_says.items():
            out = self.folder / f"out{groups}"
            out.mkdir()
            hidden = ["sh", "-c", 'mount -t tmpfs none "$0" && exec "$1"', out, PROGRAMS / "mars-node"]
            words = [*OWN_MPIRUN, "-n", 1, PROGRAMS / "mars-host", path, "-o", out, *NODES, "--groups", groups, "--frames", "0-1",
                     "--no-coherence", "--report", f"report{groups}.json", ":", "-n", 1, PROGRAMS / "mars-node", ":", "-n", 1,
                     *apart, *hidden]
            # Ranks of other user namespaces may not copy from each other's memory: where Open MPI learns that only from a
            # copy that fails, senders of long messages may wait for ever on a busy machine.
            environment = dict(ENVIRONMENT, OMPI_MCA_btl_vader_single_copy_mechanism="none")
            run = subprocess.Popen(list(map(str, words)), cwd=self.folder, env=environment, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.addCleanup(self.end, run)
            printed, said = run.communicate(timeout=2 * SECONDS)  # bells do not reach the node: it looks for messages
            self.assertEqual(run.returncode, 0, said + printed)
            self.assertIn("does not see the folder of frames as the host does: the host composes and writes " + says, printed)
            self.assertEqual(self.files(f"out{groups}"), self.files("wanted"))
            self.assertFalse((self.folder / f"out{groups}/.runs").exists())
            self.assertIn("all there and whole", self.succeed("mars", "verify", f"out{groups}"))
            frames = json.loads((self.folder / f"report{groups}.json").read_text())["frames"]
            composed_by = {node["node"] for frame in frames for node in frame["nodes"] if node["seconds"]["compose"] > 0}
            self.assertEqual(composed_by, {0} if groups == 2 else set())

    @needs_mpi
    @needs("ffmpeg")
    def test_frames_in_a_folder_of_another_machine_are_said_to_be_there_and_give_no_video(self):
        """mars, and a job that runs where another folder has the name."""
        hidden, programs = self.folder / "hidden", self.folder / "programs"
        hidden.mkdir()
        programs.mkdir()
        apart = ["unshare", "--user", "--map-root-user", "--mount"]
        if self.run_program(*apart, "mount", "-t", "tmpfs", "none", hidden).returncode != 0:
            self.skipTest("no user namespaces here")
        for name in ["mpirun", "mpirun.openmpi", "mpirun.mpich"]:
            (programs / name).write_text(f"#!/bin/sh\nexec {' '.join(apart)} sh -c 'mount -t tmpfs none {hidden} && exec "
                                         f"{shutil.which(OWN_MPIRUN[0])} \"$@\"' sh \"$@\"\n")
            (programs / name).chmod(0o755)
        path = self.write("film.json", spinning_teapot(2, [16, 9]))
        command = [PROGRAMS / "mars", "render", path, "--backend", "mpi", "--nodes", 1]
        runs = [subprocess.Popen([*map(str, command), *map(str, outputs)], cwd=self.folder, text=True,
                                 env=dict(ENVIRONMENT, PATH=f"{programs}:{os.environ['PATH']}"),
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                for outputs in (["-o", hidden / "out"], ["-o", hidden / "more", "-o", "film.mp4"])]
        for run in runs:
            self.addCleanup(self.end, run)
        printed, said = runs[0].communicate(timeout=SECONDS)
        self.assertEqual((runs[0].returncode, complaints(said)), (0, ""), printed)
        self.assertRegex(printed, f"2 frames in {hidden}/out, .*; the folder {hidden}/out is on another machine, and this "
                                  r"machine does not see it\n$")
        said = runs[1].communicate(timeout=SECONDS)[1]
        self.assertEqual(runs[1].returncode, 1, said)
        self.assertClear(said, "this machine, which makes videos of them, does not see them")
        self.assertFalse((self.folder / "film.mp4").exists())

    def test_a_run_goes_on_the_other_way(self):
        path = self.write("film.json", spinning_teapot(FRAMES, [160, 90]))
        one = ["--backend", "threads", "--nodes", 2]
        self.render(path, "wanted", *one)
        self.render(path, "out", *one, "--frames", "0-7")
        self.render(path, "out", *one, *NODES, "--frames", "0-13")
        self.render(path, "out", *one)
        self.assertEqual(self.files("out"), self.files("wanted"))
        self.assertIn("20 frames, all there and whole", self.succeed("mars", "verify", "out"))

    def test_what_a_killed_run_has_written_counts(self):
        path = self.write("film.json", spinning_teapot(4000, [160, 90]))
        command = [PROGRAMS / "mars", "render", path, "-o", "out", "--quiet", "--backend", "threads", "--nodes", 2, *NODES]
        process = subprocess.Popen([str(word) for word in command], cwd=self.folder, env=ENVIRONMENT)
        self.addCleanup(process.kill)
        wait_until(lambda: self.written("out") > 30, SECONDS, "no frames")
        kill([process.pid, *family(process.pid)])
        process.wait()
        missing = self.succeed("mars", "verify", "out", "--missing").strip()
        self.assertRegex(missing, r"^\d+-3999$|,")
        self.render(path, "out", *NODES, "--backend", "threads", "--nodes", 2, "--frames", "0-99")
        self.render(path, "wanted", "--backend", "threads", "--nodes", 1, "--frames", "0-99")
        files = self.files("out")
        self.assertEqual({name: files[name] for name in self.files("wanted")}, self.files("wanted"))
        self.assertNothingTorn(self.folder / "out")

    @needs_mpi
    def test_a_stop_counts_what_the_host_has_not_heard_of(self):
        """The host stands still while its nodes write what they were given; then the job is stopped."""
        path = self.write("film.json", spinning_teapot(500, [160, 90]))
        command = [PROGRAMS / "mars", "render", path, "-o", "out", "--backend", "mpi", "--nodes", 2, *NODES]
        process = subprocess.Popen([str(word) for word in command], cwd=self.folder, env=ENVIRONMENT, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(self.end, process)
        wait_until(lambda: process.poll() is not None or self.written("out") > 0, SECONDS, "no frames")
        hosts = [each for each in family(process.pid) if b"mars-host" in cmdline(each).split(b"\0")[0]]
        send(hosts, signal.SIGSTOP)
        unheard = lambda: self.written("out") - self.recorded()
        wait_until(lambda: unheard() > 3, SECONDS, lambda: f"{unheard()} files that the host has not heard of")
        process.terminate()
        said = complaints(process.communicate(timeout=SECONDS)[1])
        written = self.written("out")
        self.assertIn(f"stopped by Terminated after {written} of 500 frames", said)
        self.assertFalse((self.folder / "out/.runs").exists())
        troubles = self.run_program("mars", "verify", "out").stdout
        self.assertEqual([line for line in troubles.splitlines() if not line.endswith(": missing")][:-1], [], troubles)
        self.assertIn(f"{500 - written} of 500 frames", troubles)

    @needs_mpi
    def test_films_survive_writers_that_are_killed(self):
        chance = random.Random(7)
        path = self.write("film.json", spinning_teapot(500, [160, 90]))
        command = [PROGRAMS / "mars", "render", path, "-o", "out", "--backend", "mpi", "--nodes", 3, *NODES]
        process = subprocess.Popen([str(word) for word in command], cwd=self.folder, env=ENVIRONMENT, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        for _ in range(2):
            enough = self.written("out") + chance.randint(5, 60)
            wait_until(lambda: process.poll() is not None or self.written("out") > enough, SECONDS, "no frames")
            nodes = [each for each in family(process.pid) if b"mars-node" in cmdline(each)]
            if nodes:
                kill([chance.choice(nodes)])
        printed = process.communicate(timeout=SECONDS)
        self.assertEqual((process.returncode, complaints(printed[1])), (0, ""), printed)
        self.assertIn("starting again", printed[0])
        self.assertIn("500 frames, all there and whole", self.succeed("mars", "verify", "out"))

    def test_a_run_that_loses_its_folder_ends(self):
        path = self.write("film.json", endless_film())
        for lose in (lambda: (self.folder / "out").rename(self.folder / "moved"),
                     lambda: (self.folder / "out/.runs").rename(self.folder / "lost")):
            command = [PROGRAMS / "mars", "render", path, "-o", "out", "--quiet", "--backend", "threads", "--nodes", 2, *NODES]
            process = subprocess.Popen([str(word) for word in command], cwd=self.folder, env=ENVIRONMENT, text=True,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.addCleanup(process.kill)
            wait_until(lambda: self.written("out") > 10, SECONDS, "no frames")
            lose()
            said = process.communicate(timeout=SECONDS)[1]
            self.assertEqual(process.returncode, 1)
            self.assertClear(said, "")
            self.assertRegex(said, "removed or renamed|is gone")
            shutil.rmtree(self.folder / "out", ignore_errors=True)

    def test_what_nodes_cannot_write(self):
        path = self.write("film.json", spinning_teapot(2, [16, 9]))
        self.fail_clearly(2, "render", path, "--sink", "none", *NODES, says="no files to write")
        for words, says in [(["--watch", "socket"], "use --write host"),
                            (["--backend", "simulated"], "simulated nodes write no files")]:
            done = self.render(path, "out", *NODES, *words)
            self.assertNotEqual(done.returncode, 0)
            self.assertClear(done.stderr, says)


def cmdline(process):
    try:
        with open(f"/proc/{process}/cmdline", "rb") as file:
            return file.read()
    except OSError:
        return b""


if __name__ == "__main__":
    main()
