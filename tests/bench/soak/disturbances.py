"""Makes the faults of a soak: whom each hits, and how. A fault that lasts is undone by `undo` after some seconds."""
import signal
from dataclasses import dataclass

import cluster as clusters
from damage import OF_FRAMES, OF_RECORDS, damage
from disk import fill
from rendering import frames_in

SIGNALS = (signal.SIGKILL, signal.SIGSEGV, signal.SIGTERM, signal.SIGABRT)
ON_A_CLUSTER = ("cut", "slow", "disk")  # kinds that one machine without root has not
FOR_GOOD = 1 / 6       # of the stops, nobody continues
STOPPED = (0.3, 6)     # seconds of the others
EDITED = (1, 15)       # seconds until a person has put the film back


@dataclass
class Fault:
    what: str          # for people: "SIGKILL of mars-node 4711 on n3"
    lasts: float = 0   # seconds until it is undone
    undo: object = None
    place: str = ""    # what stays broken so long, and is not broken a second time
    kills: str = ""    # a program


class Disturber:
    """`machines`: a cluster or one machine; `source`: of the film. `lasting`: faults that are not undone yet."""

    def __init__(self, machines, folder, source):
        self.machines, self.folder, self.source = machines, folder, source
        self.lasting = []
        self.drawing = False  # the job that runs has brought a frame
        self.film = None      # what the folder's film.mars was, sound

    def make(self, planned):
        """The fault that was made; none if there is nothing to hit now."""
        return KINDS[planned.kind](self, planned.dice())

    # ---- processes

    def victim(self, dice, stopped=True):
        """Of a program of the job, each as likely, whichever of its processes; one that is stopped, too?"""
        found = {}
        for process in sorted(self.machines.ours(), key=lambda process: process.number):
            if stopped or not process.is_stopped():
                found.setdefault(process.program, []).append(process)
        return dice.choice(found[dice.choice(sorted(found))]) if found else None

    def kill(self, dice):
        what, victim = dice.choice(SIGNALS), self.victim(dice)
        if victim is None:
            return None
        victim.send(what)
        return Fault(f"{what.name} of {victim.program} {victim.number} on {victim.host}",
                     kills=victim.program)

    def stop(self, dice):
        """For good only what MARS watches, once it draws: before, MARS gives it two minutes."""
        for_good, seconds, victim = dice.random() < FOR_GOOD, dice.uniform(*STOPPED), self.victim(dice, stopped=False)
        if victim is None:
            return None
        victim.send(signal.SIGSTOP)
        what = f"SIGSTOP of {victim.program} {victim.number} on {victim.host}"
        if for_good and self.drawing and victim.program != "mars":
            return Fault(what + " for good")
        return self.lasts(what, f"process {victim.number}", seconds, victim.go_on)

    # ---- links and the disk

    def on_a_link(self, what, undo, seconds, dice):
        hosts = self.intact(*clusters.HOSTS)
        if not hosts:
            return None
        host = dice.choice(hosts)
        self.machines.testbed(*what(host))
        return self.lasts(" ".join(what(host)), host, dice.uniform(*seconds),
                          lambda: self.machines.testbed(*undo(host)))

    def cut(self, dice):
        return self.on_a_link(lambda host: ("cut", host), lambda host: ("join", host), (3, 25), dice)

    def slow(self, dice):
        rate = dice.choice(("1mbit", "5mbit", "20mbit"))
        return self.on_a_link(lambda host: ("slow", host, rate), lambda host: ("slow", host, "full"), (5, 20), dice)

    def fill(self, dice):
        if not self.intact("disk"):
            return None
        filler = self.folder.parent / "filler"
        fill(self.folder.parent, filler)
        return self.lasts("the folder's disk is full", "disk", dice.uniform(3, 15),
                          lambda: filler.unlink(missing_ok=True))

    # ---- files

    def manifest(self, dice):
        return self.damaged(self.folder / "frames.json", OF_RECORDS, dice)

    def compiled_film(self, dice):
        """Not while the source is no help either."""
        return self.damaged(self.folder / "film.mars", OF_RECORDS, dice) if self.intact("source") else None

    def frame(self, dice):
        frames = sorted(frames_in(self.folder))
        if not frames:
            return None
        return self.damaged(self.folder / f"frame-{dice.choice(frames):04}.png", OF_FRAMES, dice)

    def runs(self, dice):
        runs = self.folder / ".runs"
        files = sorted(runs.iterdir()) if runs.is_dir() else []
        return self.damaged(dice.choice(files), OF_RECORDS, dice) if files else None

    def damaged(self, path, ways, dice):
        what = damage(path, ways, dice)
        return Fault(what) if what else None

    def edit(self, dice):
        """Of a film that mars has taken up, and that the folder has."""
        if not self.drawing or not self.intact("source") or not self.film_is_sound():
            return None
        return self.lasts(self.source.change(dice), "source", dice.uniform(*EDITED), self.source.put_back)

    def film_is_sound(self):
        try:
            return (self.folder / "film.mars").read_bytes() == self.film
        except OSError:
            return False

    # ---- faults that last

    def intact(self, *places):
        return [place for place in places if place not in (fault.place for fault in self.lasting)]

    def lasts(self, what, place, seconds, undo):
        fault = Fault(what, seconds, undo, place)
        self.lasting.append(fault)
        return fault

    def undo(self, fault):
        self.lasting.remove(fault)
        fault.undo()


KINDS = {
    "kill": Disturber.kill, "stop": Disturber.stop, "cut": Disturber.cut, "slow": Disturber.slow,
    "disk": Disturber.fill, "manifest": Disturber.manifest, "film": Disturber.compiled_film,
    "frame": Disturber.frame, "runs": Disturber.runs, "edit": Disturber.edit,
}
