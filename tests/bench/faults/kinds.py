"""The faults: how each is made, what mars must say, and how the film comes to its end."""
import shutil
import signal
import threading
import time
from dataclasses import dataclass

from cluster import HEAD, HOSTS

KILL, STOP, CONT, SEGV = signal.SIGKILL, signal.SIGSTOP, signal.SIGCONT, signal.SIGSEGV
LOST = "n3"  # the machine that faults hit; neither the first nor the last
NO_COHERENCE = ["--nodes", 8, "--groups", 1, "--no-coherence"]


@dataclass
class Kind:
    name: str
    title: str          # as the table has it
    how: str
    says: str           # pattern of the line by which mars reports it
    make: object        # called with the scene when a third of the frames are stored
    code: int = 0       # mars's exit code
    again: bool = False  # it takes a person who starts the same command again
    words: tuple = ()   # of the command, in place of the usual ones
    batch: tuple = ()   # of sbatch, for a job of Slurm's
    plan: str = ""      # what nodes do at a frame (planted/noting_node.cpp)
    part: float = 1 / 3  # of the frames that are stored before
    goes_on: bool = False  # nodes draw all the time
    new_cluster: bool = False  # it does not survive this


def send(program, what, host=None):
    def make(scene):
        victim = scene.process(program, host)
        scene.happens()
        victim.send(what)
    return make


def in_the_sum(scene):
    """While one node is held, the others come to the global sum and wait there for it; there another is stopped."""
    held, victim = scene.process("mars-node", "n2"), scene.process("mars-node", LOST)
    held.send(STOP)
    time.sleep(2)
    scene.happens()
    victim.send(STOP)
    held.send(CONT)


def at_the_end(scene):
    """All frames are stored; the node is stopped before it can end."""
    victims = scene.cluster.processes("mars-node", host=LOST)
    while scene.stored() < scene.frames and scene.mars.code is None:
        time.sleep(0.001)
    scene.happens()
    for victim in victims:
        victim.send(STOP)


def all_stopped(scene):
    stopped = scene.cluster.ours()
    scene.happens()
    for process in stopped:
        process.send(STOP)
    scene.undo_after(45, lambda: [process.go_on() for process in stopped])


def machine_stopped(scene):
    """With all that runs on it, sshd too; its network still answers."""
    stopped = scene.cluster.processes(host=LOST)
    scene.happens()
    for process in stopped:
        process.send(STOP)
    scene.undo_at_end(lambda: [process.go_on() for process in stopped])


def cut(scene):
    scene.happens()
    scene.cluster.testbed("cut", LOST)
    scene.undo_at_end(lambda: scene.cluster.testbed("join", LOST))


def power_cut(scene):
    scene.happens()
    scene.cluster.testbed("kill", LOST)


def slow_link(scene):
    scene.happens()
    scene.cluster.testbed("slow", LOST, "5mbit")
    scene.undo_at_end(lambda: scene.cluster.testbed("slow", LOST, "full"))


def half_speed(scene):
    """Stopped for half of the time, in turns so short that it never seems to hang."""
    victim, ended = scene.process("mars-node", LOST), threading.Event()

    def pulse():
        while not ended.wait(0.04):
            victim.send(STOP)
            ended.wait(0.04)
            victim.send(CONT)

    scene.happens()
    threading.Thread(target=pulse, daemon=True).start()
    scene.undo_at_end(ended.set)


def disk_full(scene):
    scene.happens()
    scene.disk.fill()
    scene.undo_after(20, scene.disk.empty)


def read_only(scene):
    """On every host. Files that are open stay writable, as Linux has it."""
    scene.happens()
    for host in HOSTS:
        scene.cluster.testbed("exec", host, "sh", "-ec", 'mount --bind "$0" "$0"; mount -o remount,bind,ro "$0"',
                              str(scene.out))
    scene.undo_after(20, lambda: [scene.cluster.testbed("exec", host, "umount", "--lazy", str(scene.out))
                                  for host in HOSTS])


def hangs(scene):
    scene.happens()
    scene.disk.freeze()
    scene.undo_after(30, scene.disk.thaw)


def deleted(scene):
    scene.happens()
    shutil.rmtree(scene.out, ignore_errors=True)


def planned(scene):
    """The nodes do it; this waits until the first has begun the frame of their plan."""
    frame = int(scene.plan.split()[1])
    while not (begun := [line[0] for line in scene.notes.lines() if line[3] == frame]):
        time.sleep(0.02)
    scene.since = begun[0]


def power_loss(scene):
    """Of the machine that has the folder, and all others: what was not on the disk is gone."""
    stopped = scene.cluster.ours()
    for process in stopped:
        process.send(STOP)
    copy = scene.disk.image.with_suffix(".copy")
    scene.disk.copy_as_after_power_loss(copy)
    scene.happens()
    for process in stopped:
        process.send(KILL)
        process.go_on()
    scene.mars.wait(30)
    scene.cluster.testbed("down")
    scene.disk.unmount()
    copy.replace(scene.disk.image)
    scene.disk.mount()
    scene.cluster.up()


def said(pattern):
    """Slurm does it; this waits until mars says so."""
    def make(scene):
        while not (line := scene.mars.first_line(pattern, 0)) and scene.mars.code is None:
            time.sleep(0.05)
        scene.since = line[0] if line else time.monotonic()
    return make


def machine_of_batch_script(scene):
    host = scene.mars.fact("BatchHost")
    scene.happens()
    scene.cluster.testbed("kill", host)


def preempt(scene):
    """A job of a partition that comes before others takes all machines for 5 seconds."""
    words = ("sbatch", "--partition=urgent", "--nodes=4", "--output=/dev/null", "--wrap=sleep 5")
    scene.happens()
    scene.cluster.testbed("exec", HEAD, *words)


BATCH = ("--nodes=4", "--ntasks=8")
DIED = "killed by signal"
SILENT = r"nothing from|silent|has said nothing|hangs"
GONE = "does not answer"

KINDS = [
    Kind("kill-node", "a node dies (KILL)", "`kill -9` of a mars-node", DIED, send("mars-node", KILL, LOST)),
    Kind("crash-node", "a node dies (SEGV)", "`kill -SEGV` of a mars-node", DIED, send("mars-node", SEGV, LOST)),
    Kind("kill-host", "the host dies", "`kill -9` of mars-host", DIED, send("mars-host", KILL)),
    Kind("kill-mpirun", "mpirun dies", "`kill -9` of mpirun", DIED, send("mpirun", KILL)),
    Kind("kill-mars", "mars dies", "`kill -9` of mars; the same command again at once", "", send("mars", KILL),
         code=137, again=True),
    Kind("stop-node", "a node hangs while it draws", "`kill -STOP` of a mars-node", SILENT,
         send("mars-node", STOP, LOST)),
    Kind("stop-in-sum", "a node hangs in a global sum", "`kill -STOP` while all wait in it", SILENT, in_the_sum,
         words=tuple(NO_COHERENCE)),
    Kind("stop-at-end", "nodes hang in MPI_Finalize", "`kill -STOP` once all frames are stored", "end|hang",
         at_the_end),
    Kind("stop-host", "the host hangs", "`kill -STOP` of mars-host", SILENT, send("mars-host", STOP)),
    Kind("suspend", "the whole job is suspended for 45 s", "STOP and CONT of all its processes", "", all_stopped),
    Kind("stop-machine", "a machine hangs", "`kill -STOP` of all on it, sshd too", SILENT, machine_stopped),
    Kind("cut", "a network cable is pulled", "`testbed.sh cut`", SILENT + "|" + GONE, cut),
    Kind("power", "a machine loses power", "`testbed.sh kill`", SILENT + "|" + GONE, power_cut, new_cluster=True),
    Kind("slow-link", "a link of 5 Mbit/s", "`testbed.sh slow`", "slow", slow_link, goes_on=True),
    Kind("half-speed", "a node at half speed", "STOP and CONT 12 times a second", "slow", half_speed, part=1 / 5,
         goes_on=True),
    Kind("disk-full", "the disk is full for 20 s", "the folder's file system filled", "No space left", disk_full),
    Kind("read-only", "the disk is read-only for 20 s", "`mount -o remount,bind,ro`", "Read-only", read_only),
    Kind("hang", "storage hangs for 30 s", "`fsfreeze`", "storage|sink|cannot write|has not answered", hangs),
    Kind("delete", "the folder is deleted", "`rm -r`; the same command again", "was removed or renamed",
         deleted, code=1, again=True),
    Kind("bad-frame", "a frame kills its nodes", "a node that dies when it begins frame 200; later the same "
         "command, with sound nodes", "set aside|left out", planned, code=1, again=True, plan="die 200"),
    Kind("noise", "a node sends noise", "a node that once sends 5000 random bytes as a strip", "strip|node", planned,
         plan="garble 200"),
    Kind("power-loss", "all machines lose power, the folder's too", "a copy of the disk without what "
         "Linux has not written yet; the same command on it", "", power_loss, code=137, again=True),
    Kind("slurm-limit", "Slurm: the time limit", "`--time=1 --signal=B:USR1@50`; counted from mars's last word",
         "queued again", said("stopped by"), batch=(*BATCH, "--time=1", "--signal=B:USR1@50"), part=0),
    Kind("slurm-machine", "Slurm: a machine loses power", "`testbed.sh kill`", GONE, power_cut, batch=BATCH,
         new_cluster=True),
    Kind("slurm-first", "Slurm: the script's machine loses power", "`testbed.sh kill`", "", machine_of_batch_script,
         batch=BATCH, new_cluster=True),
    Kind("slurm-preempt", "Slurm: preemption", "a job of a partition of higher `PriorityTier`", "stopped by", preempt,
         batch=BATCH),
]
