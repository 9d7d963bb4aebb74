"""The faults of a soak, all of them decided by the seed before it begins."""
import random
from dataclasses import dataclass, field

NOW, START, END = "now", "start", "end"  # when a fault is made: at once, in a job that starts, in one that ends
SHARES = {  # how often each kind, of one another
    "kill": 40, "stop": 12, "cut": 6, "slow": 4, "disk": 3,
    "manifest": 10, "film": 6, "frame": 12, "runs": 6, "edit": 10,
}
MOMENTS = {"kill": {NOW: 55, START: 30, END: 15}, "stop": {NOW: 75, START: 25}}  # others: now
STARTING = (0.1, 0.5, 2)  # seconds from mpirun's fork, at most: each stage of a start is hit
ENDING = 0.4              # seconds from the last frame, at most


@dataclass
class Planned:
    number: int
    kind: str
    moment: str
    after: float      # seconds after the one before
    delay: float = 0  # seconds after the moment
    seed: str = field(default="", repr=False)

    def dice(self):
        """What decides the rest; the same each time that the fault is tried."""
        return random.Random(self.seed)


def chosen(dice, shares):
    return dice.choices(list(shares), list(shares.values()))[0]


def delay_after(moment, dice):
    if moment == START:
        return dice.random() * dice.choice(STARTING)
    return dice.random() * ENDING if moment == END else 0


def plan(seed, count, kinds, every):
    dice, planned = random.Random(seed), []
    for number in range(1, count + 1):
        kind = chosen(dice, {kind: SHARES[kind] for kind in kinds})
        moment = chosen(dice, MOMENTS.get(kind, {NOW: 1}))
        planned.append(Planned(number, kind, moment, dice.expovariate(1 / every), delay_after(moment, dice),
                               f"{seed}/{number}"))
    return planned
