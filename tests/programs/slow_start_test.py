"""A start that takes long: it is explained and not disturbed, and a signal ends it at any moment."""

import fcntl
import shutil
import signal
import struct
import subprocess
import termios
import time

from harness import (ENVIRONMENT, EXAMPLES, OWN_MPIRUN, PROGRAMS, PROMPT, SECONDS, ProgramTest, SideBySide, complaints,
                     family, living, main, needs_mpi, state_of, wait_until)

TEAPOT = EXAMPLES / "teapot.json"
HINT_AFTER = 20  # seconds, as mars waits
DEAF = "sleep 1000"  # it does not end by itself while a test looks on
ANSWERS_VERSION = "#!/bin/sh\ncase \"$*\" in *--version*) echo 'mpirun (Open MPI) 4.1.4'; exit;; esac\n"


def unread(pipe):
    """The bytes in a pipe."""
    return struct.unpack("i", fcntl.ioctl(pipe, termios.FIONREAD, bytes(4)))[0]


@needs_mpi
class SlowStart(SideBySide, ProgramTest):
    def start(self, name, script, *words, files=None, printed=subprocess.PIPE):
        """mars render with an mpirun that first does what `script` says; $real is the one it stands for. `files` are
        how many a process may open; `printed` takes what it prints."""
        folder = self.folder / name
        folder.mkdir()
        for program in ["mpirun", "mpirun.openmpi", "mpirun.mpich"]:
            mpirun = folder / program
            mpirun.write_text(ANSWERS_VERSION + f"real={shutil.which(OWN_MPIRUN[0])}\n{script}\n")
            mpirun.chmod(0o755)
        limit = ["prlimit", f"--nofile={files}"] if files else []
        process = subprocess.Popen(
            [*limit, PROGRAMS / "mars", "render", TEAPOT, "-o", folder / "out", "--nodes", "2", "--backend", "mpi", *words],
            stdout=printed, stderr=subprocess.PIPE, text=True, cwd=self.folder,
            env=dict(ENVIRONMENT, PATH=f"{folder}:{ENVIRONMENT['PATH']}"))
        self.addCleanup(self.end, process)
        return process

    def assertStopped(self, process, sent, before):
        kin = family(process.pid)
        process.send_signal(sent)
        _, complaint = process.communicate(timeout=PROMPT)
        self.assertEqual(process.returncode, 1, before)
        self.assertClear(complaint, f"stopped by {signal.strsignal(sent)}")
        self.assertEqual(living(kin), [], before)

    def test_it_is_explained_and_goes_on(self):
        """All at once: none takes a processor while it waits."""
        go = "until [ -e go ]; do sleep 0.1; done"
        late = f'{go}; exec "$real" "$@"'
        compiling = (f'echo \'{{"event":"loading","film":"long.json"}}\'; {go}; '
                     'echo \'{"event":"loaded","seconds":22.0}\'; exec "$real" "$@"')
        runs, printed, began = {}, {}, time.monotonic()
        for name, script, files in [("compiling", compiling, None), ("SIGTERM", late, 30), ("SIGINT", late, 30),
                                    ("late", late, None), ("unended", f'"$real" "$@"; {DEAF}', None)]:
            with open(self.folder / f"{name}.txt", "w") as file:
                runs[name] = self.start(name, script, "--frames", "0-3", files=files, printed=file)
            printed[name] = (self.folder / f"{name}.txt").read_text
        wait_until(lambda: "for more run mars doctor" in printed["late"](), SECONDS, "no hint")
        self.assertGreater(time.monotonic() - began, HINT_AFTER)
        self.assertIn("no node has answered for 20 seconds", printed["late"]())
        for sent in [signal.SIGTERM, signal.SIGINT]:
            wait_until(lambda: "open files: a process may have 30" in printed[sent.name](), SECONDS, "no hint")
            self.assertStopped(runs[sent.name], sent, "the hint is there")
        (self.folder / "go").touch()
        for name in ["late", "compiling"]:
            _, complaint = runs[name].communicate(timeout=SECONDS)
            self.assertEqual((runs[name].returncode, complaints(complaint)), (0, ""), printed[name]())
            self.assertIn("4 frames in ", printed[name]())
        self.assertNotIn("no node has answered", printed["compiling"]())
        self.assertIn("loading long.json ...\nloaded in 0:22", printed["compiling"]())
        _, complaint = runs["unended"].communicate(timeout=SECONDS)
        self.assertEqual(runs["unended"].returncode, 0, complaint)
        self.assertClear(complaint, "warning: all frames are there, but the job has not ended 10 seconds after its last word")

    def test_a_signal_ends_it_at_any_moment(self):
        for sent in [signal.SIGTERM, signal.SIGINT]:
            for seconds in [0, 0.01, 0.03, 0.1, 0.3, 1]:
                with self.subTest(signal=sent.name, seconds=seconds):
                    process = self.start(f"{sent.name}-{seconds}", DEAF)
                    time.sleep(seconds)
                    kin = family(process.pid)
                    process.send_signal(sent)
                    process.communicate(timeout=PROMPT)
                    self.assertIn(process.returncode, [1, -sent])  # the latter before mpirun is started
                    wait_until(lambda: not living(kin), PROMPT, "its processes live on")

    def test_a_signal_ends_it_under_a_stopped_mpirun(self):
        process = self.start("stopped", f"echo $$ >pid; kill -STOP $$; {DEAF}")
        pid = self.folder / "pid"
        wait_until(lambda: pid.exists() and state_of(pid.read_text().strip()) == "T", SECONDS, "mpirun has not stopped")
        self.assertStopped(process, signal.SIGTERM, "mpirun is stopped")

    def test_a_signal_ends_it_under_an_mpirun_that_ignores_it(self):
        process = self.start("deaf", "trap '' TERM INT HUP; echo $$ >pid; while :; do sleep 0.1; done")
        wait_until((self.folder / "pid").exists, SECONDS, "mpirun has not begun")
        self.assertStopped(process, signal.SIGTERM, "mpirun ignores it")

    def test_a_second_signal_ends_it_though_nobody_reads(self):
        """mars itself hangs: it writes more than the pipe takes."""
        backend = "x" * 100000
        process = self.start("unread", f'echo \'{{"event":"booted","backend":"{backend}","machines":1,"nodes":[]}}\'\n'
                                       f'exec {DEAF}')
        capacity = fcntl.fcntl(process.stdout, fcntl.F_GETPIPE_SZ)
        wait_until(lambda: unread(process.stdout) > capacity // 2, SECONDS, "it does not write")
        wait_until(lambda: state_of(process.pid) == "S", SECONDS, "it does not hang")
        kin = family(process.pid)
        process.send_signal(signal.SIGTERM)
        time.sleep(0.1)
        process.send_signal(signal.SIGTERM)
        process.wait(timeout=PROMPT)
        wait_until(lambda: not living(kin), PROMPT, "its processes live on")


if __name__ == "__main__":
    main()
