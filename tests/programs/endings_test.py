"""A rendering that is stopped, or loses a process and is not started again: one message, soon, nothing left running,
nothing torn."""

import os
import shutil
import signal
import time

from harness import (MPICH, PROGRAMS, PROMPT, ProgramTest, SideBySide, endless_film, family, living, main, needs_mpi,
                     spinning_teapot, wait_until)


class Endings(SideBySide, ProgramTest):
    def start(self, backend):
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        film = self.write("film.json", endless_film())
        self.process = self.start_mars("render", film, "-o", "out", "--nodes", 3, "--backend", backend, "--restarts", 0)
        self.family = family(self.process.pid)

    def kin(self, program):
        return [p for p, (_, _, executable) in self.family.items() if executable.endswith("/" + program)]

    def assertEndsClearly(self, says):
        _, printed = self.process.communicate(timeout=PROMPT)
        self.assertEqual(self.process.returncode, 1, printed)
        self.assertClear(printed, says)
        self.assertEqual(living(self.family), [])
        self.assertNothingTorn(self.folder / "out")

    def assertStopped(self, sent, says):
        for backend in self.backends():
            with self.subTest(backend=backend):
                self.start(backend)
                self.process.send_signal(sent)
                self.assertEndsClearly(says)

    def test_interrupted(self):
        self.assertStopped(signal.SIGINT, "stopped by Interrupt")

    def test_terminated(self):
        self.assertStopped(signal.SIGTERM, "stopped by Terminated")

    def test_hung_up(self):
        self.assertStopped(signal.SIGHUP, "stopped by Hangup")

    @needs_mpi
    def test_killed_node(self):
        self.start("mpi")
        os.kill(max(self.kin("mars-node")), signal.SIGKILL)
        self.assertEndsClearly("killed by signal 9")

    @needs_mpi
    def test_killed_host(self):
        self.start("mpi")
        os.kill(self.kin("mars-host")[0], signal.SIGKILL)
        self.assertEndsClearly("a node was killed by signal 9" if MPICH else "the host was killed by signal 9")

    @needs_mpi
    def test_killed_mpirun(self):
        self.start("mpi")
        mpirun = next(p for p, (parent, _, _) in self.family.items() if parent == self.process.pid)
        os.kill(mpirun, signal.SIGKILL)
        self.assertEndsClearly("mpirun was killed by signal 9")

    def test_killed_threads(self):
        self.start("threads")
        os.kill(self.kin("mars-threads")[0], signal.SIGKILL)
        self.assertEndsClearly("mars-threads was killed by signal 9")

    def test_killed_mars(self):
        for backend in self.backends():
            with self.subTest(backend=backend):
                self.start(backend)
                self.process.kill()
                wait_until(lambda: not living(self.family), PROMPT, "its processes live on")

    def test_closed_streams(self):
        """Files that are opened later do not get their numbers."""
        self.write("film.json", spinning_teapot(2, [16, 9]))
        for backend in self.backends():
            for closed in [">&-", "<&- >&-", "<&- >&- 2>&-"]:
                with self.subTest(backend=backend, closed=closed):
                    line = f'"$0" render film.json -o out --nodes 2 --backend {backend} {closed}'
                    self.succeed("bash", "-c", line, PROGRAMS / "mars")
                    self.succeed("mars", "verify", "out")
                    shutil.rmtree(self.folder / "out")

    def test_a_reader_that_leaves(self):
        """As any program does whose output goes to `head`, mars ends by SIGPIPE; all else ends with it."""
        self.start(self.backends()[-1])
        self.process.stdout.close()
        self.assertEqual(self.process.wait(PROMPT), -signal.SIGPIPE)
        wait_until(lambda: not living(self.family), PROMPT, "its processes live on")

    @needs_mpi
    def test_frozen_node(self):
        """Who stops a job whose node hangs is not kept waiting."""
        self.start("mpi")
        os.kill(self.kin("mars-node")[0], signal.SIGSTOP)
        time.sleep(0.5)
        self.process.send_signal(signal.SIGINT)
        self.assertEndsClearly("stopped by Interrupt")


if __name__ == "__main__":
    main()
