"""One case of each kind of test that is not quick, for ./bootstrap test: what it stands for has a file of its own."""

import subprocess

from harness import (ENVIRONMENT, PROGRAMS, SECONDS, ProgramTest, complaints, kill, living, main, needs, needs_mpi,
                     spinning_teapot, wait_until)
from storage_test import Mounts, needs_mounts

FRAMES = 120


class Sentinels(ProgramTest):
    def setUp(self):
        super().setUp()
        self.film = self.write("film.json", spinning_teapot(FRAMES, [160, 90]))

    def undisturbed(self):
        self.succeed("mars", "render", self.film, "-o", "undisturbed", "--backend", "threads", "--nodes", 1, "--quiet")
        return self.verified_hash("undisturbed")

    @needs_mpi
    def test_a_killed_node(self):
        """restarts_test.py; ranks over MPI, backends_test.py."""
        words = ["render", self.film, "-o", "out", "--nodes", 2, "--backend", "mpi"]
        with self.half_way(FRAMES, *words) as (process, kin):
            kill([max(p for p, (_, _, program) in kin.items() if program.endswith("mars-node"))])
        printed, said = process.communicate(timeout=SECONDS)
        self.assertEqual((process.returncode, complaints(said)), (0, ""), printed)
        self.assertIn("starting again (1 of 5) with 2 nodes", printed)
        self.assertEqual(living(kin), [])
        self.assertNothingTorn(self.folder / "out")
        self.assertEqual(self.verified_hash("out"), self.undisturbed())

    @needs_mounts
    def test_a_full_disk(self):
        """storage_test.py."""
        disk = self.folder / "disk"
        disk.mkdir()
        mounts = Mounts()
        self.addCleanup(mounts.end)
        mounts.run("mount", "-t", "tmpfs", "-o", "size=128k", "none", disk)
        said = self.folder / "said.txt"
        with said.open("w") as errors:
            process = subprocess.Popen([*mounts.enter, PROGRAMS / "mars", "render", self.film, "-o", disk / "out",
                                        "--backend", "threads"], stdout=subprocess.DEVNULL, stderr=errors, env=ENVIRONMENT)
        self.addCleanup(self.end, process)
        waits = lambda: "No space left on device; waiting" in said.read_text() or process.poll() is not None
        wait_until(waits, SECONDS, "it says nothing of a full disk")
        self.assertIsNone(process.poll(), said.read_text())
        mounts.run("mount", "-o", "remount,size=8M", disk)
        self.assertEqual(process.wait(timeout=SECONDS), 0, said.read_text())
        whole = subprocess.run([*mounts.enter, PROGRAMS / "mars", "verify", disk / "out"], capture_output=True, text=True)
        self.assertEqual(whole.stdout.split()[-1], self.undisturbed())

    @needs("ffmpeg", "ffprobe")
    def test_a_video(self):
        """videos_test.py."""
        self.succeed("mars", "render", self.film, "-o", "film.mp4", "--frames", "0-5", "--backend", "threads", "--quiet")
        self.assertIn("6 frames of film.json (0-5), 160x90", self.succeed("mars", "verify", "film.mp4"))


if __name__ == "__main__":
    main()
