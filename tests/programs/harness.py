"""What the tests of the programs share: starting a program as a person does, a folder of its own for each
test, and looking at what is left. Each test file is started as: FILE_test.py PROGRAMS_FOLDER SOURCES_FOLDER.
"""

import atexit
import contextlib
import fcntl
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from cases import SideBySide, main  # noqa: E402,F401

PROGRAMS = pathlib.Path(sys.argv[1]).resolve()
BUILD = PROGRAMS.parent
SOURCES = pathlib.Path(sys.argv[2]).resolve()
EXAMPLES = SOURCES / "examples"
HAVE_MPI = (PROGRAMS / "mars-host").exists()
MPICH = HAVE_MPI and b"libmpich" in (PROGRAMS / "mars-host").read_bytes()
SANITIZED = re.search(rb"__[at]san_init", (PROGRAMS / "mars-threads").read_bytes()) is not None
SECONDS = 600 if SANITIZED else 200  # for any one program, and for anything that must come, on a busy machine too
PROMPT = 600 if SANITIZED else 60  # for what a signal ends: far less than what does not hear the signal would last
TRIES = 20  # of what fails only where the test gets no processor for long

# Where tests and all that they start put temporary files: programs that are killed leave some. The folder is removed when
# the tests have ended.
TEMPORARY = tempfile.TemporaryDirectory(prefix="mars-test-", ignore_cleanup_errors=True)
os.environ["TMPDIR"] = tempfile.tempdir = TEMPORARY.name
os.environ.pop("XDG_RUNTIME_DIR", None)  # which programs prefer for sockets
# Two mpiruns that begin at once both make this folder, and one of them fails; the last to end would remove it.
SESSIONS = pathlib.Path(TEMPORARY.name, f"ompi.{os.uname().nodename.partition('.')[0]}.{os.geteuid()}")
SESSIONS.mkdir(mode=0o700)
(SESSIONS / "kept").touch()

# For a person's own mpirun line: the tests may run as root, with more ranks than cores.
OWN_MPIRUN = ["mpirun.mpich"] if MPICH else ["mpirun", "--oversubscribe", "--bind-to", "none"]
ENVIRONMENT = dict(
    os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
    # This part of hwloc asks X servers for their cards, also those of other tests; if such a server ends, so does the
    # program that asks.
    HWLOC_COMPONENTS="-gl")

# What mars says of itself on a busy machine: of nodes that share their processor with others, of a disk with much to do.
BUSY = re.compile("times as long as others for an inbetween|as fast as the others again|"
                  "storage has given no answer for 10 seconds|storage answers again")

needs_mpi = unittest.skipUnless(HAVE_MPI, "built without MPI")


def complaints(printed):
    """What a program wrote on standard error, but for what only says that the machine is busy. That goes to the test's
    output, where a person can see whether the machine was busy."""
    lines = printed.splitlines(keepends=True)
    for line in filter(BUSY.search, lines):
        print(f"not counted as a complaint: {line.rstrip()}", flush=True)
    return "".join(line for line in lines if not BUSY.search(line))


def needs(*tools):
    missing = [tool for tool in tools if not shutil.which(tool)]
    return unittest.skipIf(missing, f"not installed: {', '.join(missing)}")


def spinning_teapot(frames, size):
    """A film in which every frame differs from the one before."""
    film = json.loads((EXAMPLES / "teapot.json").read_text())
    film["frames"] = frames
    film["size"] = size
    film["actors"][0]["keys"][1]["frame"] = max(frames, 24)
    return film


def endless_film():
    """More than a few nodes render while a test looks on; and few enough frames that each run compiles them soon."""
    return spinning_teapot(8000, [480, 270])


def intact(png):
    """Whether a PNG file's chunks are all there with their checksums."""
    data = png.read_bytes()
    at, kind = 8, b""
    while at + 12 <= len(data) and kind != b"IEND":
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        checked = data[at + 4:at + 8 + length]
        if data[at + 8 + length:at + 12 + length] != struct.pack(">I", zlib.crc32(checked)):
            return False
        at += 12 + length
    return data[:8] == b"\x89PNG\r\n\x1a\n" and kind == b"IEND" and at == len(data)


def identity(process):
    """A process's parent, start time and program, which together no other has; None once it has ended."""
    try:
        stat = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        return None if stat[0] == "Z" else (int(stat[1]), stat[19], os.readlink(f"/proc/{process}/exe"))
    except OSError:
        return None


def state_of(process):
    """A letter: R, S, T, ...; None once it has ended."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return None


def family(ancestor):
    """All processes under `ancestor`: process to (parent, start time, program)."""
    everyone = {int(entry): identity(entry) for entry in os.listdir("/proc") if entry.isdigit()}
    found, grown = {ancestor: None}, True
    while grown:
        more = {p: i for p, i in everyone.items() if i and i[0] in found and p not in found}
        grown = bool(more)
        found.update(more)
    del found[ancestor]
    return found


def living(processes):
    """Those of a family that still run, whoever is their parent now."""
    return [p for p, before in processes.items() if (now := identity(p)) and now[1:] == before[1:]]


def send(processes, number):
    """A signal to all at once, but those that have ended meanwhile."""
    for each in processes:
        with contextlib.suppress(ProcessLookupError):
            os.kill(each, number)


def kill(processes):
    send(processes, signal.SIGKILL)


@contextlib.contextmanager
def stopped(processes):
    """While processes stand still: they go on however that ends."""
    known = {each: now for each in processes if (now := identity(each))}
    send(known, signal.SIGSTOP)
    try:
        yield
    finally:
        send(living(known), signal.SIGCONT)


def processor_seconds():
    """Of all processes that this one started and that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def wait_until(holds, seconds, what, pause=0.02):
    """`what` is missing then; a function says it as it is at the end. Sanitized programs have as long as any."""
    end = time.monotonic() + (SECONDS if SANITIZED else seconds)
    while not holds():
        if time.monotonic() > end:
            raise AssertionError(f"after {seconds} seconds: {what() if callable(what) else what}")
        time.sleep(pause)


def install(prefix, *words):
    """`cmake --install`, which writes nothing into the build folder."""
    subprocess.run(["cmake", "--install", BUILD, "--prefix", prefix, *words], check=True, capture_output=True)


@atexit.register
def remove_what_killed_jobs_left():
    """In the memory that all programs of the machine share: folders of ours, of whose jobs none lives. The next start of
    mars would remove them (host/shell/launch/session_folders.h)."""
    for folder in pathlib.Path("/dev/shm").glob(f"mars.{socket.gethostname()[:32]}.??????"):
        try:
            lock = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
        except OSError:
            continue  # it is gone, or is another user's
        with contextlib.suppress(BlockingIOError):
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.fstat(lock).st_uid == os.geteuid():
                shutil.rmtree(folder, ignore_errors=True)
        os.close(lock)


class ProgramTest(unittest.TestCase):
    FOLDERS = None  # where the tests' folders are made; none: where temporary files go

    def setUp(self):
        self.folder = self.temporary_folder()

    def temporary_folder(self):
        """Another folder of the test alone; it is removed with all it holds."""
        return pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(
            prefix="mars-test-", dir=self.FOLDERS, ignore_cleanup_errors=True)))

    def write(self, name, content):
        """A file of this test's folder: JSON of what is no text."""
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    def over_mpi(self, *values):
        """`values`; where MPI was not built none, and a subtest that is skipped says so."""
        if HAVE_MPI:
            return values
        with self.subTest(over="mpi"):
            self.skipTest("built without MPI")
        return ()

    def backends(self):
        return ["threads", *self.over_mpi("mpi")]

    def run_program(self, *words, **more):
        words = [str(word) for word in words]
        words[0] = str(PROGRAMS / words[0]) if (PROGRAMS / words[0]).exists() else words[0]
        more = {"env": ENVIRONMENT, "cwd": self.folder, "timeout": SECONDS, "text": True, **more}
        return subprocess.run(words, capture_output=True, **more)

    def mars(self, *words, **more):
        return self.run_program("mars", *words, **more)

    def succeed(self, *words, **more):
        """Runs a program that must end well without a word of complaint, but for those of a busy machine; gives its
        standard output."""
        done = self.run_program(*words, **more)
        self.assertEqual((done.returncode, complaints(done.stderr)), (0, ""), f"{words}\n{done.stdout}")
        return done.stdout

    def fail_clearly(self, code, *words, says="", **more):
        """Runs mars, which must fail with one plain message that holds `says`."""
        done = self.mars(*words, **more)
        self.assertClear(done.stderr, says)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def assertClear(self, message, says):
        """One line: the program, what is wrong and, in parentheses, what to do."""
        lines = complaints(message).splitlines()
        self.assertEqual(len(lines), 1, message)
        self.assertIn(says, lines[0])
        for noise in ["terminate called", "std::", "MPI_", "what():", "Sanitizer", "Segmentation", "json.exception",
                      "bad_alloc", "basic_string", "vector::", "filesystem error", "last read", "while parsing"]:
            self.assertNotIn(noise, message)

    def assertNothingTorn(self, folder):
        """Only whole frames, the manifest and the film are there, if the folder is there at all."""
        for path in folder.iterdir() if folder.exists() else []:
            if path.suffix == ".png":
                self.assertTrue(intact(path), path)
            else:
                self.assertIn(path.name, ["frames.json", "film.mars"])

    def verified_hash(self, folder):
        return self.succeed("mars", "verify", folder).split()[-1]

    def start_mars(self, *words, env=ENVIRONMENT):
        """mars, running until its first frames are there; its family is ended with the test."""
        process = self.launch_mars(*words, env=env)
        if process.poll() is not None:
            self.fail(f"it ended too soon: {process.communicate()[1]}")
        return process

    @contextlib.contextmanager
    def half_way(self, frames, *words):
        """A run of mars into the folder out, and the processes under it. All stand still within the block, with some of
        these many frames written, but at most half of them. A run that is further before this test gets a processor
        is followed by another."""
        out = self.folder / "out"
        for _ in range(TRIES):
            shutil.rmtree(out, ignore_errors=True)
            process = self.launch_mars(*words)
            kin = family(process.pid)
            with stopped([process.pid, *kin]):
                if process.poll() is None and len(list(out.glob("*.png"))) <= frames / 2:
                    yield process, kin
                    return
            said = process.communicate(timeout=SECONDS)[1]
            self.assertEqual((process.returncode, complaints(said)), (0, ""))
        self.fail(f"{TRIES} runs were at their end before they could be stopped")

    def launch_mars(self, *words, env=ENVIRONMENT):
        """mars, until its first frames are there or it has ended."""
        process = subprocess.Popen([str(PROGRAMS / "mars"), *map(str, words)], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, env=env, cwd=self.folder)
        self.addCleanup(self.end, process)
        out = self.folder / "out"
        begun = lambda: process.poll() is not None or len(list(out.glob("*.png"))) > 3
        wait_until(begun, SECONDS, "no frame")
        return process

    @staticmethod
    def end(process):
        left = family(process.pid) if process.poll() is None else {}  # its number may be another's once it has ended
        process.kill()
        kill(living(left))  # before the pipes are read to their ends, which what stands still may keep open
        process.communicate()
