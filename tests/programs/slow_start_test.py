"""A start that takes long: it is explained and not disturbed, and a signal ends it at any moment."""

import resource
import shutil
import signal
import subprocess
import time

from harness import (ENVIRONMENT, EXAMPLES, OWN_MPIRUN, PROGRAMS, SECONDS, ProgramTest, family, living, main, needs_mpi,
                     wait_until)

TEAPOT = EXAMPLES / "teapot.json"
HINT_AFTER = 20  # seconds, as mars waits
SOON = 9         # seconds from a signal to the end, of what does not listen
ANSWERS_VERSION = "#!/bin/sh\ncase \"$*\" in *--version*) echo 'mpirun (Open MPI) 4.1.4'; exit;; esac\n"


@needs_mpi
class SlowStart(ProgramTest):
    def start(self, name, script, *words, files=None):
        """mars render with an mpirun that first does what `script` says; $real is the one it stands for. `files` are
        how many a process may open."""
        folder = self.folder / name
        folder.mkdir()
        for program in ["mpirun", "mpirun.openmpi", "mpirun.mpich"]:
            mpirun = folder / program
            mpirun.write_text(ANSWERS_VERSION + f"real={shutil.which(OWN_MPIRUN[0])}\n{script}\n")
            mpirun.chmod(0o755)
        limit = files and (lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (files, files)))
        process = subprocess.Popen(
            [PROGRAMS / "mars", "render", TEAPOT, "-o", folder / "out", "--nodes", "2", "--backend", "mpi", *words],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder, preexec_fn=limit,
            env=dict(ENVIRONMENT, PATH=f"{folder}:{ENVIRONMENT['PATH']}"))
        self.addCleanup(self.end, process)
        return process

    def assertStopped(self, process, sent, before):
        kin = family(process.pid)
        process.send_signal(sent)
        output, printed = process.communicate(timeout=SOON)
        self.assertEqual(process.returncode, 1, before)
        self.assertClear(printed, f"stopped by {signal.strsignal(sent)}")
        self.assertEqual(living(kin), [], before)
        return output

    def test_it_is_explained_and_goes_on(self):
        """All at once: none takes a processor while it waits."""
        late = 'sleep 22; exec "$real" "$@"'
        compiling = ('echo \'{"event":"loading","film":"long.json"}\'; sleep 22; '
                     'echo \'{"event":"loaded","seconds":22.0}\'; exec "$real" "$@"')
        runs = {name: self.start(name, script, "--frames", "0-3") for name, script in
                [("late", late), ("compiling", compiling)]}
        stopped = [self.start(f"stopped-{sent.name}", late, files=30) for sent in [signal.SIGTERM, signal.SIGINT]]
        began = time.monotonic()
        time.sleep(HINT_AFTER + 1)
        for process, sent in zip(stopped, [signal.SIGTERM, signal.SIGINT]):
            self.assertIn("open files: a process may have 30", self.assertStopped(process, sent, "the hint is there"))
        unended = self.start("unended", '"$real" "$@"; sleep 60', "--frames", "0-3")
        printed = {}
        for name, process in runs.items():
            printed[name], complaint = process.communicate(timeout=SECONDS)
            self.assertEqual((process.returncode, complaint), (0, ""), printed[name])
            self.assertIn("4 frames in ", printed[name])
        self.assertGreater(time.monotonic() - began, HINT_AFTER)
        self.assertIn("no node has answered for 20 seconds", printed["late"])
        self.assertIn("for more run mars doctor", printed["late"])
        self.assertNotIn("no node has answered", printed["compiling"])
        _, complaint = unended.communicate(timeout=SECONDS)
        self.assertEqual(unended.returncode, 0, complaint)
        self.assertClear(complaint, "warning: all frames are there, but the job has not ended 10 seconds after its last word")
        self.assertIn("loading long.json ...\nloaded in 0:22", printed["compiling"])

    def test_a_signal_ends_it_at_any_moment(self):
        for sent in [signal.SIGTERM, signal.SIGINT]:
            for seconds in [0, 0.01, 0.03, 0.1, 0.3, 1]:
                with self.subTest(signal=sent.name, seconds=seconds):
                    process = self.start(f"{sent.name}-{seconds}", 'sleep 30')
                    time.sleep(seconds)
                    kin = family(process.pid)
                    process.send_signal(sent)
                    process.communicate(timeout=SOON)
                    self.assertIn(process.returncode, [1, -sent])  # the latter before mpirun is started
                    wait_until(lambda: not living(kin), 1, "its processes live on")

    def test_a_signal_ends_it_under_a_stopped_mpirun(self):
        process = self.start("stopped", 'echo $$ >pid; kill -STOP $$; sleep 30')
        wait_until((self.folder / "pid").exists, 10, "mpirun has not begun")
        time.sleep(0.2)
        self.assertStopped(process, signal.SIGTERM, "mpirun is stopped")

    def test_a_signal_ends_it_under_an_mpirun_that_ignores_it(self):
        process = self.start("deaf", "trap '' TERM INT HUP; echo $$ >pid; while :; do sleep 0.1; done")
        wait_until((self.folder / "pid").exists, 10, "mpirun has not begun")
        self.assertStopped(process, signal.SIGTERM, "mpirun ignores it")

    def test_a_second_signal_ends_it_though_nobody_reads(self):
        """mars itself hangs: it writes more than the pipe takes."""
        backend = "x" * 100000
        process = self.start("unread", f'echo \'{{"event":"booted","backend":"{backend}","machines":1,"nodes":[]}}\'\n'
                                       'echo $$ >pid; exec sleep 60')
        wait_until((self.folder / "pid").exists, 10, "mpirun has not begun")
        time.sleep(0.3)
        kin = family(process.pid)
        process.send_signal(signal.SIGTERM)
        time.sleep(0.1)
        process.send_signal(signal.SIGTERM)
        process.wait(timeout=SOON)
        wait_until(lambda: not living(kin), 2, "its processes live on")


if __name__ == "__main__":
    main()
