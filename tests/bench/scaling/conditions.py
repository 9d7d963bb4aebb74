"""How quiet the machine was while runs were measured."""
from dataclasses import dataclass

import numpy

from fits import spread
from results import computing

BUSY = 0.1     # of the machine's processors, taken by others
WAITED = 1.15  # seconds of computing by the clock for a second of a processor


@dataclass(frozen=True)
class Conditions:
    """Of a list of runs. None: not known, as processes on other machines are not seen."""
    load: tuple       # least and greatest load average
    cores: int
    others: float     # share of the machine's processors that others took
    switches: float   # involuntary ones, for a second of a processor
    waited: float     # seconds that nodes computed by the clock for a second of a processor; more than 1: they waited
    spread: float     # between a configuration's quartiles, of its median; the median over configurations

    @property
    def busy(self):
        return (self.others or 0) > BUSY or (self.waited or 0) > WAITED


def of(runs_by_configuration):
    runs = [run for own in runs_by_configuration for run in own]
    loads = [run[key] for run in runs for key in ("load_average", "load_average_after")]
    cores = runs[0]["environment"]["cores"]
    wall, own, others, switches = (total(runs, key) for key in ("wall_seconds", "processor_seconds", "others_seconds",
                                                                "involuntary_switches"))
    spreads = [spread([run["seconds"] for run in own]) for own in runs_by_configuration]
    return Conditions((min(loads), max(loads)), cores, None if others is None else others / (wall * cores),
                      None if switches is None else switches / own, waited(runs),
                      float(numpy.median([(each.upper - each.lower) / each.median for each in spreads])))


def total(runs, key):
    return None if any(run[key] is None for run in runs) else sum(run[key] for run in runs)


def waited(runs):
    """Of the runs whose nodes have a processor each."""
    alone = [run for run in runs if run["nodes"] <= run["environment"]["processors"]]
    own = total(alone, "processor_seconds")
    return sum(sum(computing(run)) for run in alone) / own if own else None
