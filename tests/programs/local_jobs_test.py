"""An MPI job of this machine alone: nobody outside can connect to it, and what it left when it was killed goes with
the next start."""

import ipaddress
import os
import pathlib
import re
import socket
import subprocess
import unittest

from harness import (ENVIRONMENT, MPICH, SECONDS, SOURCES, ProgramTest, SideBySide, endless_film, family, kill, living,
                     main, needs, needs_mpi, spinning_teapot, wait_until)

SHARED = pathlib.Path("/dev/shm")
FOLDER_SETTINGS = ["OMPI_MCA_orte_tmpdir_base", "OMPI_MCA_btl_vader_backing_directory"]
NAMED = f"mars.{socket.gethostname()[:32]}."


def listeners(processes):
    """The addresses on which these processes listen."""
    sockets = set()
    for process in processes:
        try:
            for descriptor in os.scandir(f"/proc/{process}/fd"):
                sockets.update(re.findall(r"socket:\[(\d+)\]", os.readlink(descriptor.path)))
        except OSError:
            continue  # it has ended, or closed this one
    found = []
    for table in ["tcp", "tcp6"]:
        for line in pathlib.Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
            _, local, _, state, *_, inode = line.split()[:10]
            if state == "0A" and inode in sockets:
                words = bytes.fromhex(local.split(":")[0])
                found.append(ipaddress.ip_address(b"".join(words[i:i + 4][::-1] for i in range(0, len(words), 4))))
    return found


class LocalJobs(SideBySide, ProgramTest):
    def setUp(self):
        super().setUp()
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        self.film = self.write("film.json", spinning_teapot(2, [16, 9]))
        self.environment = dict(ENVIRONMENT, TMPDIR=str(self.temporary))

    def start(self, *words):
        film = self.write("long.json", endless_film())
        return self.start_mars("render", film, "-o", "out", "--nodes", 2, *words, env=self.environment)

    @staticmethod
    def folders_of(processes):
        """Those that were made for this job: others run beside it."""
        found = set()
        for process in processes:
            try:
                lines = pathlib.Path(f"/proc/{process}/environ").read_text().split("\0")
            except OSError:
                continue  # it has ended
            settings = dict(line.split("=", 1) for line in lines if "=" in line)
            found.update(pathlib.Path(settings[name]) for name in FOLDER_SETTINGS if name in settings)
        return sorted(found)

    def processes(self):
        """Those with this test's environment, whoever is their parent."""
        mine = f"TMPDIR={self.temporary}".encode()
        found = []
        for entry in filter(str.isdigit, os.listdir("/proc")):
            try:
                if mine in pathlib.Path(f"/proc/{entry}/environ").read_bytes().split(b"\0"):
                    found.append(entry)
            except OSError:
                continue  # it has ended, or is another user's
        return found

    def render_a_frame(self):
        self.succeed("mars", "render", self.film, "--sink", "none", "--frames", "0", "--nodes", 1,
                     env=self.environment)

    @needs_mpi
    def test_listens_on_the_loopback_interface_only(self):
        process = self.start()
        found = listeners(family(process.pid))
        self.assertNotEqual(found, [], "mpirun listens, or the test does not see it")
        self.assertEqual([str(address) for address in found if not address.is_loopback], [])

    def test_threads_do_not_listen(self):
        process = self.start("--backend", "threads")
        self.assertEqual(listeners(family(process.pid)), [])

    @needs_mpi
    @unittest.skipIf(MPICH, "MPICH leaves nothing")
    def test_what_a_killed_job_left_is_removed(self):
        process = self.start()
        everyone = family(process.pid)
        left = self.folders_of(everyone)
        self.assertEqual([path.parent for path in left], [SHARED, self.temporary])
        self.assertTrue(all(any(path.iterdir()) for path in left), left)
        kill([process.pid, *everyone])
        wait_until(lambda: not living(everyone), SECONDS, "they live on")
        self.assertTrue(any(left[1].iterdir()), left)  # the other may be gone: any start on this machine removes it
        self.render_a_frame()
        self.assertEqual([path for path in left if path.exists()], [])
        self.assertEqual(list(self.temporary.iterdir()), [])

    @needs_mpi
    @unittest.skipIf(MPICH, "MPICH leaves nothing")
    def test_what_others_have_stays(self):
        victim = self.write("victim", "precious")
        process = self.start()
        living_job = self.folders_of(family(process.pid))
        self.assertEqual(len(living_job), 2)
        planted = self.temporary / (NAMED + "abcdef")
        planted.symlink_to(self.folder)
        (self.temporary / (NAMED + "ghijkl")).write_text("a file")
        (self.temporary / (NAMED + "longer-than-ours")).mkdir()
        others = set(self.temporary.iterdir())
        if os.geteuid() == 0:
            foreign = self.temporary / (NAMED + "mnopqr")
            foreign.mkdir()
            os.chown(foreign, 65534, 65534)
            others.add(foreign)
        self.render_a_frame()
        self.assertTrue(others <= set(self.temporary.iterdir()))
        self.assertTrue(victim.exists())
        self.assertTrue(all(path.exists() for path in living_job))
        self.assertIsNone(process.poll())

    @needs_mpi
    def test_mars_nx_leaves_nothing(self):
        program = self.folder / "sleeper"
        program.write_text("#!/bin/sh\n" + "".join(f'echo "${name}"\n' for name in FOLDER_SETTINGS))
        program.chmod(0o755)
        named = self.succeed("mars-nx", "run", "--over", "mpi", "--nodes", 2, program, env=self.environment).split()
        named = sorted(map(pathlib.Path, set(named)))
        if not MPICH:
            self.assertEqual([path.parent for path in named], [SHARED, self.temporary])
            self.assertTrue(all(re.fullmatch(re.escape(NAMED) + ".{6}", path.name) for path in named), named)
        self.assertFalse([path for path in named if path.exists()], "its folders stay")
        wait_until(lambda: not self.processes(), SECONDS, "its processes stay")
        done = self.run_program("mars-nx", "run", "--over", "mpi", "--nodes", 2, program, "--", ":")
        self.assertClear(done.stderr, "mpirun takes : for the end of a program's arguments")

    @needs("pgrep")
    @unittest.skipIf(os.geteuid() != 0, "needs root, as Slurm has it")
    def test_the_epilog_removes_what_a_user_left_after_the_last_process(self):
        user = 2_000_000_000 + os.getpid()  # nobody's
        left = [SHARED / f"vader_segment.here.{user}.1.0", SHARED / f"mars.here.{user % 10 ** 6:06}",
                pathlib.Path("/tmp", f"ompi.here.{user}")]
        kept = [SHARED / f"other.{user}", SHARED / f"vader_segment.here.root.{user}.0"]
        for path in left + kept:
            path.touch()
            self.addCleanup(path.unlink, missing_ok=True)
        for path in left + kept[:1]:
            os.chown(path, user, user)
        epilog = lambda: self.succeed(SOURCES / "cluster/slurm/epilog.sh", env=dict(ENVIRONMENT, SLURM_JOB_UID=str(user)))
        process = subprocess.Popen(["sleep", "1000"], user=user, cwd="/")
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        epilog()
        self.assertEqual([path for path in left if not path.exists()], [])
        process.kill()
        process.wait()
        epilog()
        self.assertEqual([path for path in left + kept if path.exists()], kept)

    def test_an_empty_tmpdir_is_none(self):
        for backend in self.backends():
            self.succeed("mars", "render", self.film, "--sink", "none", "--frames", "0", "--nodes", 1,
                         "--backend", backend, env=dict(ENVIRONMENT, TMPDIR=""))

    def test_a_film_of_any_name(self):
        film = self.film.read_text()
        for name in [":", "-q", "a b", "line\nbreak"]:
            self.write(name, film)
            with self.subTest(name=name):
                self.succeed("mars", "render", "-o", f"{name} out", "--report", f"./{name}.report", "--frames", "0",
                             "--nodes", 1, "--", name)
                self.succeed("mars", "verify", "--", f"{name} out")
        (self.folder / ":").unlink()
        self.succeed("mars", "render", self.film, "-o", ":", "--frames", "0", "--nodes", 1)
        self.succeed("mars", "verify", ":")


main()
