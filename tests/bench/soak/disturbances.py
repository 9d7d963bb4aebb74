"""What goes wrong in a soak, at random: the kinds of faults, and whom each hits. A fault that lasts is undone by `undo`
after some seconds."""
import signal
from dataclasses import dataclass

import cluster as clusters
from disk import fill


@dataclass
class Fault:
    what: str          # for people: "KILL of mars-node 4711 on n3"
    lasts: float = 0   # seconds until it is undone
    undo: object = None
    place: str = ""    # what stays broken so long, and is not broken a second time


class Disturber:
    """Makes faults on a cluster, of which `random` decides all. `lasting`: those that are not undone yet."""

    def __init__(self, cluster, folder, random):
        self.cluster, self.folder, self.random = cluster, folder, random
        self.lasting = []

    def intact(self, *places):
        return [place for place in places if place not in (fault.place for fault in self.lasting)]

    def make(self, kind):
        """The fault that was made; none if there is nothing to hit now."""
        return KINDS[kind](self)

    def signalled(self, program, what, name):
        victims = sorted(self.cluster.processes(program), key=lambda process: process.number)
        if not victims:
            return None
        victim = self.random.choice(victims)
        victim.send(what)
        return Fault(f"{name} of {program} {victim.number} on {victim.host}")

    def on_a_link(self, what, undo, seconds):
        hosts = self.intact(*clusters.HOSTS)
        if not hosts:
            return None
        host = self.random.choice(hosts)
        self.cluster.testbed(*what(host))
        return self.lasts(" ".join(what(host)), host, seconds, lambda: self.cluster.testbed(*undo(host)))

    def lasts(self, what, place, seconds, undo):
        fault = Fault(what, self.random.uniform(*seconds), undo, place)
        self.lasting.append(fault)
        return fault

    def undo(self, fault):
        self.lasting.remove(fault)
        fault.undo()

    def cut(self):
        return self.on_a_link(lambda host: ("cut", host), lambda host: ("join", host), (5, 50))

    def slow(self):
        rate = self.random.choice(("1mbit", "5mbit", "20mbit"))
        return self.on_a_link(lambda host: ("slow", host, rate), lambda host: ("slow", host, "full"), (5, 30))

    def fill(self):
        if not self.intact("disk"):
            return None
        filler = self.folder.parent / "filler"
        fill(self.folder.parent, filler)
        return self.lasts("the folder's disk is full", "disk", (5, 20), lambda: filler.unlink(missing_ok=True))


KINDS = {
    "kill-node": lambda self: self.signalled("mars-node", signal.SIGKILL, "KILL"),
    "kill-host": lambda self: self.signalled("mars-host", signal.SIGKILL, "KILL"),
    "kill-mpirun": lambda self: self.signalled("mpirun", signal.SIGKILL, "KILL"),
    "kill-mars": lambda self: self.signalled("mars", signal.SIGKILL, "KILL"),
    "stop-node": lambda self: self.signalled("mars-node", signal.SIGSTOP, "STOP"),
    "stop-host": lambda self: self.signalled("mars-host", signal.SIGSTOP, "STOP"),
    "cut": Disturber.cut,
    "slow": Disturber.slow,
    "disk": Disturber.fill,
}
EVERY = 20      # seconds from a fault to the next, on average
AFTER_CUT = 60  # seconds from a cut to the next fault, at least
