"""Storage that takes no files for a while: a rendering waits, says so, and goes on by itself; a signal ends it meanwhile."""

import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from harness import (ENVIRONMENT, PROGRAMS, PROMPT, SECONDS, ProgramTest, SideBySide, complaints, endless_film, family,
                     living, main, needs, spinning_teapot, wait_until)

FRAMES = 40
WITHIN_RIGHTS = ["setpriv", "--bounding-set=-dac_override"] if os.geteuid() == 0 else []


def runs(*words):
    return subprocess.run(words, capture_output=True, timeout=SECONDS).returncode == 0


class Mounts:
    """Mounts that only programs started here see, and that are gone with the last of them."""

    def __init__(self):
        self.holder = subprocess.Popen(["unshare", "--mount", "sh", "-c", "echo; exec sleep 600"], stdout=subprocess.PIPE)
        self.holder.stdout.readline()
        holder = f"/proc/{self.holder.pid}"
        # With its root: this system may be in a changed one.
        self.enter = ["nsenter", f"--mount={holder}/ns/mnt", f"--root={holder}/root", f"--wdns={os.getcwd()}"]

    def run(self, *words):
        subprocess.run([*self.enter, *map(str, words)], check=True, timeout=SECONDS)

    def runs(self, *words):
        return runs(*self.enter, *map(str, words))

    def thaws_at_last(self, disk):
        """However this test ends: what is frozen for ever could not even be unmounted."""
        return subprocess.Popen([*self.enter, "sh", "-c", f"sleep 500; exec fsfreeze -u '{disk}'"])

    def end(self):
        self.holder.kill()
        self.holder.communicate()


def can_mount():
    with tempfile.TemporaryDirectory(prefix="mars-test-") as folder:
        mounts = Mounts()
        try:
            return mounts.runs("mount", "-t", "tmpfs", "none", folder)
        finally:
            mounts.end()


needs_mounts = unittest.skipUnless(can_mount(), "may not mount a small disk")


class Storage(SideBySide, ProgramTest):
    FOLDERS = "/tmp"

    def setUp(self):
        super().setUp()
        self.folder.chmod(0o755)
        self.film = self.write("film.json", spinning_teapot(FRAMES, [160, 90]))
        self.disk = self.folder / "disk"
        self.disk.mkdir()
        self.out = self.disk / "out"
        self.before = []

    def mount(self, *words):
        self.mounts = Mounts()
        self.addCleanup(self.mounts.end)
        self.mounts.run("mount", *words, self.disk)
        self.before = self.mounts.enter

    def inside(self, script):
        """A line of shell where the mounts are, in the folder of the disk."""
        line = ["sh", "-c", f'cd "$0" && {script}', str(self.disk)]
        return subprocess.run([*self.before, *line], capture_output=True, text=True, timeout=SECONDS, check=True).stdout

    def start(self, *more, backend="threads", before=(), out=None):
        self.said = open(self.folder / "said.txt", "w+", encoding="utf-8")
        self.addCleanup(self.said.close)
        words = [PROGRAMS / "mars", "render", self.film, "-o", out or self.out, "--nodes", 2, "--backend", backend, *more]
        process = subprocess.Popen([*self.before, *before, *map(str, words)], stdout=subprocess.DEVNULL, stderr=self.said,
                                   env=ENVIRONMENT, cwd=self.folder)
        self.addCleanup(self.end, process)
        return process

    def words(self):
        self.said.seek(0)
        return self.said.read()

    def hears(self, process, what):
        wait_until(lambda: what in self.words() or process.poll() is not None, SECONDS, f"it says nothing of {what}")
        self.assertIn(what, self.words())
        self.assertIsNone(process.poll(), self.words())

    def assertGoesOnToItsEnd(self, process, lines=2):
        process.wait(timeout=SECONDS)
        words = complaints(self.words())
        self.assertEqual(process.returncode, 0, words)
        self.assertGreaterEqual(len(words.splitlines()), lines, words)
        self.assertTrue(words.splitlines()[-1].endswith("the run goes on"), words)
        printed = self.inside(f'"{PROGRAMS}/mars" verify out')
        self.assertIn(f"{FRAMES} frames, all there and whole", printed)
        self.succeed("mars", "render", self.film, "-o", "undisturbed", "--backend", "threads", "--nodes", 1)
        self.assertEqual(printed.split()[-1], self.verified_hash("undisturbed"))
        shutil.rmtree(self.folder / "undisturbed")
        self.assertEqual(self.inside("ls -A out | grep -v -e frame -e film.mars || true"), "", "what is not of the film is left")

    def assertStops(self, process):
        kin = family(process.pid)
        process.send_signal(signal.SIGTERM)
        process.wait(timeout=PROMPT)  # waiting for storage lasts 10 minutes
        self.assertEqual(process.returncode, 1)
        self.assertIn("stopped by Terminated", complaints(self.words()).splitlines()[-1])
        return kin

    @needs_mounts
    def test_a_full_disk(self):
        self.mount("-t", "tmpfs", "-o", "size=512k", "none")
        for backend in self.backends():
            with self.subTest(backend=backend):
                self.inside("rm -rf out; head -c 300000 /dev/zero > ballast")
                process = self.start(backend=backend)
                self.hears(process, "No space left on device; waiting up to 10 minutes: the run goes on by itself, and "
                                    "the same command goes on later")
                time.sleep(1.5)
                self.assertEqual(len(complaints(self.words()).splitlines()), 1, self.words())
                self.inside("mount -o remount,size=4M . && rm ballast")
                self.assertGoesOnToItsEnd(process)
                self.inside("rm -r out; mount -o remount,size=512k .")

    @needs_mounts
    def test_a_disk_that_is_full_from_the_start(self):
        self.mount("-t", "tmpfs", "-o", "size=4M", "none")
        self.inside("head -c 5000000 /dev/zero > ballast || true")
        process = self.start()
        self.hears(process, "No space left on device; waiting")
        time.sleep(2.5)
        self.assertEqual(len(complaints(self.words()).splitlines()), 1, self.words())
        self.inside("rm ballast")
        self.assertGoesOnToItsEnd(process)

    @needs_mounts
    @needs("ffmpeg", "ffprobe")
    def test_a_video_on_a_full_disk(self):
        """One message, and nothing under the video's name; what is encoded stays, and the same command goes on. ffmpeg ends
        well where there is no room for a file's end."""
        self.succeed("mars", "render", self.film, "-o", "out", "--size", "64x36", "--backend", "threads")
        self.mount("-t", "tmpfs", "-o", "size=8k", "none")
        play = lambda name: self.run_program(*self.before, PROGRAMS / "mars", "play", self.folder / "out", "-o", self.disk / name)
        for name, room in [("film.apng", 12), ("film.webm", 8), ("film.mp4", 8)]:
            with self.subTest(name, room=room):
                self.inside(f"mount -o remount,size={room}k .")
                failed = play(name)
                self.assertEqual(failed.returncode, 1, failed.stdout)
                self.assertClear(failed.stderr, f"{name}: cannot write: No space left on device (free some space")
                self.assertEqual(self.inside("find . -type f"), "")
        pieces = 0
        while pieces == 0:
            room += 4
            self.inside(f"mount -o remount,size={room}k .")
            self.assertEqual(play(name).returncode, 1, "the piece is there, but no video")
            pieces = len(self.inside("find . -name 'piece-*'").split())
        self.assertEqual(self.inside("ls -A").split(), [f"{name}.mars-work"])
        self.inside("mount -o remount,size=1M .")
        self.assertIn(f"{FRAMES} frames of {self.disk / name} are encoded already", play(name).stdout)
        self.assertEqual(self.inside("ls -A").split(), [name])
        self.assertIn(f"{FRAMES} frames", self.run_program(*self.before, PROGRAMS / "mars", "verify", self.disk / name).stdout)

    @needs_mounts
    def test_signals_while_it_waits(self):
        self.mount("-t", "tmpfs", "-o", "size=256k", "none")
        for backend in self.backends():
            with self.subTest(backend=backend):
                process = self.start(backend=backend)
                self.hears(process, "No space left on device; waiting")
                kin = self.assertStops(process)
                self.assertEqual(living(kin), [])
                self.inside("rm -r out")

    @needs_mounts
    def test_a_disk_that_cannot_be_written_for_a_while(self):
        self.mount("-t", "tmpfs", "-o", "size=4M", "none")
        self.film = self.write("film.json", spinning_teapot(3000, [160, 90]))
        process = self.start()
        wait_until(lambda: "frame-0003.png" in self.inside("ls out 2>/dev/null || true"), SECONDS, "no frame")
        # The kernel refuses while a file is open for writing.
        self.inside("mount --bind out out && until mount -o remount,ro,bind out 2>/dev/null; do sleep 0.01; done")
        self.hears(process, "Read-only file system; waiting")
        self.inside("umount out")
        self.hears(process, "the run goes on\n")
        self.assertStops(process)

    @needs("setpriv")
    def test_permissions_that_are_lacking_for_a_while(self):
        self.film = self.write("film.json", spinning_teapot(3000, [160, 90]))
        process = self.start(before=WITHIN_RIGHTS)
        wait_until(lambda: len(list(self.out.glob("*.png"))) > 3, SECONDS, "no frame")
        (self.out / ".runs").chmod(0o500)
        self.hears(process, "Permission denied; waiting")
        (self.out / ".runs").chmod(0o700)
        self.hears(process, "the run goes on\n")
        self.assertStops(process)
        self.assertNothingTorn(self.out)

    def test_a_folder_that_is_removed(self):
        self.film = self.write("film.json", endless_film())
        for backend in self.backends():
            with self.subTest(backend=backend):
                process = self.start(backend=backend)
                wait_until(lambda: len(list(self.out.glob("*.png"))) > 3, SECONDS, "no frame")
                self.out.rename(self.disk / "removed")
                self.assertEqual(process.wait(timeout=SECONDS), 1)
                shutil.rmtree(self.disk / "removed")  # not before: a file that was being made may still come into it
                self.assertClear(self.words(), f"{self.out}: the folder was removed or renamed while frames were rendered "
                                               "into it (the same command renders into a new one")
                self.assertFalse(self.out.exists())

    @needs_mounts
    def test_a_report_and_a_trace_wait_too(self):
        self.mount("-t", "tmpfs", "-o", "size=8M", "none")
        self.inside("head -c 9000000 /dev/zero > ballast || true; touch report.json trace.json")
        for option in ["report", "trace"]:
            with self.subTest(option=option):
                file = self.disk / f"{option}.json"
                process = self.start(f"--{option}", file, out=self.folder / option)
                self.hears(process, f"{file}: cannot write: No space left on device; waiting")
                self.inside("rm ballast")
                self.assertEqual(process.wait(timeout=SECONDS), 0, self.words())
                self.assertIn(f"{file} is written: the run goes on", self.words())
                self.inside("head -c 9000000 /dev/zero > ballast || true")

    @needs_mounts
    @needs("mkfs.ext4", "fsfreeze", "losetup")
    def test_a_disk_that_does_not_answer(self):
        """Frozen, it holds whoever writes within the kernel, where no signal ends it."""
        image = self.folder / "image"
        with open(image, "wb") as file:
            file.truncate(256 << 20)
        subprocess.run(["mkfs.ext4", "-q", image], check=True, timeout=SECONDS)
        self.mounts = Mounts()
        self.addCleanup(self.mounts.end)
        if not self.mounts.runs("mount", "-o", "loop", image, self.disk):
            self.skipTest("may not mount a disk image")
        self.before = self.mounts.enter
        self.film = self.write("film.json", endless_film())
        guard = self.mounts.thaws_at_last(self.disk)
        self.addCleanup(self.end, guard)
        self.addCleanup(self.mounts.runs, "fsfreeze", "-u", self.disk)
        process = self.start()
        wait_until(lambda: "0003.png" in self.inside("ls out 2>/dev/null || true"), SECONDS, "no frame")
        self.mounts.run("fsfreeze", "-f", self.disk)
        self.hears(process, "storage has given no answer for 10 seconds, or is slow; the run goes on by itself")
        self.mounts.run("fsfreeze", "-u", self.disk)
        self.hears(process, "storage answers again: the run goes on")
        self.mounts.run("fsfreeze", "-f", self.disk)
        time.sleep(1)
        kin = self.assertStops(process)
        self.mounts.run("fsfreeze", "-u", self.disk)
        wait_until(lambda: not living(kin), PROMPT, "what the kernel held lives on")

    def test_files_that_may_not_grow(self):
        done = self.run_program("prlimit", "--fsize=8000", PROGRAMS / "mars", "render", self.film, "-o", "out", "--backend", "threads")
        self.assertClear(done.stderr, "raise ulimit -f, which says how large files may grow")
        self.assertEqual(done.returncode, 1)
        self.assertNothingTorn(self.folder / "out")


if __name__ == "__main__":
    main()
