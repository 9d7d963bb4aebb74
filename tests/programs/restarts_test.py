"""A rendering whose job dies goes on by itself, to the same pixels, even if the film's file has changed or is gone."""

import json
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from harness import (ENVIRONMENT, MPICH, OWN_MPIRUN, PROGRAMS, SECONDS, ProgramTest, SideBySide, complaints, kill,
                     living, main, needs_mpi, spinning_teapot)

FRAMES = 400
DEADLY = PROGRAMS.parent / "tests/programs/deadly"  # a mars-node that fails at a frame, if it was built


class Restarts(SideBySide, ProgramTest):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory(prefix="mars-test-") as folder:
            path = pathlib.Path(folder)
            (path / "film.json").write_text(json.dumps(spinning_teapot(FRAMES, [160, 90])))
            for words in ["render film.json -o whole --backend threads --quiet", "verify whole"]:
                done = subprocess.run([PROGRAMS / "mars", *words.split()], cwd=folder, env=ENVIRONMENT, check=True,
                                      capture_output=True, text=True, timeout=SECONDS)
        cls.undisturbed = done.stdout.split()[-1]
        super().setUpClass()

    def setUp(self):
        super().setUp()
        self.film = self.write("film.json", spinning_teapot(FRAMES, [160, 90]))
        self.text = self.film.read_text()

    def kill(self, backend, program, *words, at_once=lambda: None):
        """A process of a rendering that is half way; at once something else happens."""
        words = ["render", self.film, "-o", "out", "--nodes", 3, "--backend", backend, *words]
        with self.half_way(FRAMES, *words) as (self.process, self.family):
            kill([max(p for p, (_, _, executable) in self.family.items()
                      if executable.rsplit("/", 1)[-1].startswith(program))])
            at_once()

    def assertGoesOn(self, says):
        printed, said = self.process.communicate(timeout=SECONDS)
        self.assertEqual((self.process.returncode, complaints(said)), (0, ""), printed)
        self.assertRegex(printed, says)
        self.assertIn("starting again (1 of 5) with 3 nodes; ", printed)
        self.assertNotRegex(printed, "has changed|still")
        self.assertIn(f"{FRAMES} frames in out", printed)
        self.assertNothingTorn(self.folder / "out")
        self.assertEqual(living(self.family), [])
        self.assertEqual(self.verified_hash("out"), self.undisturbed)

    @needs_mpi
    def test_after_a_killed_node(self):
        self.kill("mpi", "mars-node")
        self.assertGoesOn("killed by signal 9")

    @needs_mpi
    def test_after_a_killed_host_whose_film_was_edited(self):
        other = dict(spinning_teapot(FRAMES, [160, 90]), background=[1, 0, 0])
        self.kill("mpi", "mars-host", at_once=lambda: self.write("film.json", other))
        self.assertGoesOn("was killed by signal 9")

    @needs_mpi
    def test_after_a_killed_mpirun_whose_film_is_half_saved(self):
        self.kill("mpi", "mpi" if MPICH else "orterun", at_once=lambda: self.film.write_text(self.text[:100]))
        self.assertGoesOn("was killed by signal 9")

    @needs_mpi
    def test_after_a_death_while_it_starts(self):
        """Of which mpirun may report nothing but 128 and the signal's number."""
        for name in ["mpirun", "mpirun.openmpi", "mpirun.mpich"]:
            mpirun = self.folder / name
            mpirun.write_text(f'#!/bin/sh\nmkdir {self.folder}/died 2>/dev/null && exit 137\n'
                              f'exec {shutil.which(OWN_MPIRUN[0])} "$@"\n')
            mpirun.chmod(0o755)
        film = self.write("short.json", spinning_teapot(4, [32, 18]))
        printed = self.succeed("mars", "render", film, "-o", "out", "--nodes", 2, "--backend", "mpi",
                               env=dict(ENVIRONMENT, PATH=f"{self.folder}:{ENVIRONMENT['PATH']}"))
        self.assertIn("the host or a node was killed by signal 9 (Killed)\nstarting again (1 of 5) with 2 nodes", printed)
        self.assertIn("4 frames in out", printed)

    def test_after_killed_threads_whose_film_was_deleted(self):
        self.kill("threads", "mars-threads", at_once=self.film.unlink)
        self.assertGoesOn("mars-threads was killed by signal 9")

    def test_not_without_restarts(self):
        self.kill("threads", "mars-threads", "--restarts", 0)
        _, said = self.process.communicate(timeout=SECONDS)
        self.assertEqual(self.process.returncode, 1)
        self.assertClear(said, "mars-threads was killed by signal 9")

    def test_a_signal_ends_the_pause(self):
        self.kill("threads", "mars-threads")
        time.sleep(0.5)
        self.process.send_signal(signal.SIGTERM)
        _, said = self.process.communicate(timeout=SECONDS)
        self.assertEqual(self.process.returncode, 1)
        self.assertClear(said, "stopped by Terminated")
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
