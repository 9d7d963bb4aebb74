"""A rendering whose job dies goes on by itself, to the same pixels."""

import os
import shutil
import signal
import subprocess
import time
import unittest

from harness import (ENVIRONMENT, MPICH, PROGRAMS, SECONDS, ProgramTest, family, living, main, needs_mpi,
                     spinning_teapot)

FRAMES = 400
DEADLY = PROGRAMS.parent / "tests/programs/deadly"  # a mars-node that fails at a frame, if it was built


class Restarts(ProgramTest):
    def setUp(self):
        super().setUp()
        self.film = self.write("film.json", spinning_teapot(FRAMES, [160, 90]))

    def start(self, backend, *words):
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        self.process = self.start_mars("render", self.film, "-o", "out", "--nodes", 3, "--backend", backend, *words)
        self.family = family(self.process.pid)

    def kill(self, program):
        kin = [p for p, (_, _, executable) in self.family.items() if executable.rsplit("/", 1)[-1].startswith(program)]
        os.kill(max(kin), signal.SIGKILL)

    def assertGoesOn(self, says):
        printed, complaints = self.process.communicate(timeout=SECONDS)
        self.assertEqual((self.process.returncode, complaints), (0, ""), printed)
        self.assertRegex(printed, says)
        self.assertIn("starting again (1 of 5) with 3 nodes; ", printed)
        self.assertIn(f"{FRAMES} frames in out", printed)
        self.assertNothingTorn(self.folder / "out")
        self.assertEqual(living(self.family), [])
        self.assertEqual(self.verified_hash("out"), self.undisturbed())

    def undisturbed(self):
        self.succeed("mars", "render", self.film, "-o", "whole", "--backend", "threads", "--quiet")
        return self.verified_hash("whole")

    @needs_mpi
    def test_after_a_killed_node(self):
        self.start("mpi")
        self.kill("mars-node")
        self.assertGoesOn("killed by signal 9")

    @needs_mpi
    def test_after_a_killed_host(self):
        self.start("mpi")
        self.kill("mars-host")
        self.assertGoesOn("was killed by signal 9")

    @needs_mpi
    def test_after_a_killed_mpirun(self):
        self.start("mpi")
        self.kill("mpi" if MPICH else "orterun")
        self.assertGoesOn("was killed by signal 9")

    def test_after_killed_threads(self):
        self.start("threads")
        self.kill("mars-threads")
        self.assertGoesOn("mars-threads was killed by signal 9")

    def test_not_without_restarts(self):
        self.start("threads", "--restarts", 0)
        self.kill("mars-threads")
        _, complaints = self.process.communicate(timeout=SECONDS)
        self.assertEqual(self.process.returncode, 1)
        self.assertClear(complaints, "mars-threads was killed by signal 9")

    def test_a_signal_ends_the_pause(self):
        self.start("threads")
        self.kill("mars-threads")
        time.sleep(0.5)
        self.process.send_signal(signal.SIGTERM)
        _, complaints = self.process.communicate(timeout=SECONDS)
        self.assertEqual(self.process.returncode, 1)
        self.assertClear(complaints, "stopped by Terminated")
        self.assertEqual(living(self.family), [])


@unittest.skipUnless((DEADLY / "mars-node").exists(), "built without MPI")
class DeadlyFrames(ProgramTest):
    """A frame that kills its nodes is set aside, and the rest is there."""

    def assertAllButOne(self, way):
        for program in ["mars", "mars-host", "mars-loopback.so"]:
            shutil.copy(PROGRAMS / program, self.folder)
        shutil.copy(DEADLY / "mars-node", self.folder)
        self.write("deadly", f"{way} 17")
        film = self.write("film.json", spinning_teapot(30, [160, 90]))
        done = subprocess.run([self.folder / "mars", "render", film, "-o", "out", "--nodes", "3", "--backend", "mpi"],
                              cwd=self.folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=SECONDS)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertClear(done.stderr, "out: the nodes that drew frame 17 were killed each time; 29 of 30 frames are there")
        self.assertIn("frame 17 killed the nodes that drew it: it is set aside", done.stdout)
        self.assertEqual(self.succeed("mars", "verify", "out", "--missing").strip(), "17")

    def test_by_a_failure(self):
        self.assertAllButOne("throw")


if __name__ == "__main__":
    main()
