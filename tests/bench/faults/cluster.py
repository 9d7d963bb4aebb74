"""The virtual cluster (cluster/testbed) and what runs and lies on its hosts, seen from outside: each host's processes
are this machine's, in a namespace of their own."""
import os
import pathlib
import signal
import subprocess
import time
from dataclasses import dataclass

TESTBED = pathlib.Path(__file__).resolve().parents[3] / "cluster" / "testbed" / "testbed.sh"
HEAD = "n0"
HOSTS = ("n1", "n2", "n3", "n4")
OWN_FOLDERS = ("/tmp", "/dev/shm")  # of which every host has its own
OURS = ("mars", "mars-host", "mars-node", "mars-threads", "mpirun", "orted")


@dataclass(frozen=True)
class Process:
    number: int
    program: str
    host: str

    def send(self, what):
        try:
            os.kill(self.number, what)
        except ProcessLookupError:
            pass  # it has ended

    def go_on(self):
        """After a stop. An nsenter that started it on its host has stopped itself then, and is outside of the host."""
        parent = self.field("PPid")
        self.send(signal.SIGCONT)
        if (state_and_program(parent) or ("", ""))[1] == "nsenter":
            os.kill(parent, signal.SIGCONT)

    def is_stopped(self):
        return (state_and_program(self.number) or "")[:1] == ("T",)

    def field(self, name):
        """A number of /proc/N/status; 0 once it has ended."""
        try:
            lines = pathlib.Path(f"/proc/{self.number}/status").read_text().splitlines()
        except OSError:
            return 0
        return next((int(line.split()[1]) for line in lines if line.startswith(name + ":")), 0)

    def descriptors(self):
        try:
            return len(os.listdir(f"/proc/{self.number}/fd"))
        except OSError:
            return 0


def state_and_program(number):
    """As the kernel names them, mpirun.openmpi as mpirun; none once it has ended."""
    try:
        words, _, rest = pathlib.Path(f"/proc/{number}/stat").read_text().rpartition(")")
        return rest.split()[0], words.partition("(")[2].partition(".")[0]
    except OSError:
        return None


def namespace_of(number):
    try:
        return os.readlink(f"/proc/{number}/ns/pid")
    except OSError:
        return None


class Machines:
    """What is seen of a cluster and of one machine alike; `processes` and `left` differ."""

    def ours(self, host=None):
        return self.processes(*OURS, host=host)

    def wait_until_idle(self, seconds):
        """The processes that are left after `seconds`, and the seconds until they had ended."""
        began = time.monotonic()
        while (left := self.left()) and time.monotonic() - began < seconds:
            time.sleep(0.1)
        return left, time.monotonic() - began

    def end_what_is_left(self):
        for process in self.left():
            process.send(signal.SIGKILL)
        self.wait_until_idle(10)


class Cluster(Machines):
    """`environment`: of what runs on it."""

    def __init__(self, name, environment):
        self.environment = {**environment, "TESTBED": name}
        self.folder = pathlib.Path(f"/var/tmp/testbed-{name}")

    def __enter__(self):
        self.up()
        return self

    def __exit__(self, *_):
        self.testbed("down")

    def up(self):
        self.testbed("up")
        self.namespaces = {namespace_of(self.number_of(host)): host for host in (HEAD, *HOSTS)}
        self.idle = set(self.processes())

    def testbed(self, *words):
        done = subprocess.run([TESTBED, *words], env=self.environment, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip() or f"testbed.sh {' '.join(words)} failed")
        return done.stdout

    def on(self, host, *words):
        """The command that runs a command on a host."""
        return [str(TESTBED), "exec", host, *map(str, words)]

    def number_of(self, host):
        """The process that all others of the host descend from."""
        return int((self.folder / "pid" / host).read_text())

    def has_power(self, host):
        return (self.folder / "pid" / host).exists()

    def processes(self, *programs, host=None):
        """Living processes of `programs` or, without any, of all programs, on `host` or all hosts."""
        found = []
        for number in map(int, filter(str.isdigit, os.listdir("/proc"))):
            where = self.namespaces.get(namespace_of(number))
            seen = where and (host is None or where == host) and state_and_program(number)
            if seen and seen[0] not in "ZX" and (not programs or seen[1] in programs):
                found.append(Process(number, seen[1], where))
        return found

    def left(self):
        """Processes of ours, and of others that started since the cluster did and are no helper of its daemons."""
        daemons = {process.program for process in self.idle}
        return [process for process in self.processes() if process not in self.idle and process.program not in daemons]

    def own_files(self):
        """{host: names} of what lies in the folders that are the host's own."""
        return {host: sorted(self.files_of(host)) for host in HOSTS if self.has_power(host)}

    def files_of(self, host):
        root = f"/proc/{self.number_of(host)}/root"
        for folder in OWN_FOLDERS:
            device = os.stat(root + folder).st_dev
            for path, folders, names in os.walk(root + folder):
                folders[:] = [name for name in folders if os.lstat(os.path.join(path, name)).st_dev == device]
                yield from (os.path.join(path, name).removeprefix(root) for name in (*folders, *names))
