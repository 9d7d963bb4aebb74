"""What stands out in a study, in plain sentences: for the terminal and the top of the report."""
import answers
import changes
import conditions
import machines
import results as of
from fits import karp_flatt
from table import seconds_text

WIDE = 0.5  # bounds of a fraction


def nodes_text(count):
    return "1 node" if count == 1 else f"{count} nodes"


def all_of(results):
    return [finding for kind in (failures, programs, busy, noise, oversubscription, slow, outcomes, laws) for finding in kind(results)]


def failures(results):
    for run in results.failures:
        why = run["failure"].splitlines()[0]
        yield f"A run of {run['film']} on {nodes_text(run['nodes'])} failed and does not count: {why}"


def programs(results):
    """What differs between two that took turns."""
    if results.compares:
        yield from answers.sentences(changes.of_programs(results))


def slow(results):
    """Names the machines, or what was needed to know."""
    doubt = " Other programs, which had part of the processors, may be why." if conditions_of(results).busy else ""
    for each in results.slow:
        steps = ", ".join(f"{step} {times:.2f}" for step, times in each.steps.items())
        yield (f"{each.name} is slow: it takes {each.times:.2f} times as long as the others for the same work ({steps}; "
               f"{each.runs} runs, probability by chance below {max(each.probability, 0.0002):.2g}).{doubt}")
    if results.slow or len(results.hosts) == 1:
        return
    if not machines.can_tell(results.runs, results.hosts):
        yield f"Too few runs on all of {', '.join(results.hosts)} to tell whether one is slow: take more repeats."
    else:
        yield (f"No machine of {', '.join(results.hosts)} is slower than the others by more than noise and "
               f"{100 * (machines.NOTABLE - 1):.0f} %.")


def outcomes(results):
    """How far each line comes with a processor for each node."""
    for line in results.lines:
        if line.nodes[0] != 1 or len(line.fitted) < 2:
            continue
        one, most = line.points[0], line.fitted[-1]
        took = f"{seconds_text(most.time.median)} instead of {seconds_text(one.time.median)}"
        efficiency = f"efficiency {100 * line.efficiency(most):.0f} %"
        if line.kind == "strong":
            yield (f"{line.title}: {nodes_text(most.nodes)} take {took}, {line.middle[most.nodes]:.2f} times as fast as one "
                   f"({efficiency}; best runs {line.best[most.nodes]:.2f}).")
        else:
            yield (f"{line.title}: {nodes_text(most.nodes)} with {line.work(most):.1f} times the work take {took} "
                   f"({efficiency}).")


def laws(results):
    for line in results.lines:
        if line.amdahl:
            yield from amdahl(line)


def amdahl(line):
    fraction, (low, high), _ = line.amdahl
    where = ", ".join(str(point.nodes) for point in line.fitted)
    if high - low > WIDE:
        yield (f"{line.title}: the runs on {where} nodes differ too much to tell a serial fraction by Amdahl's law (95 % "
               f"bounds {100 * low:.0f} to {100 * high:.0f} %).")
    elif fraction <= 0:
        yield f"{line.title}: on {where} nodes the film scales better than Amdahl's law allows: no serial part shows."
    else:
        yield (f"{line.title}: by Amdahl's law on {where} nodes {100 * fraction:.1f} % of the work is serial (95 % bounds "
               f"{100 * low:.1f} to {100 * high:.1f} %): however many nodes are at most {1 / fraction:.1f} times as fast as "
               f"one.")
    yield from trend(line)


def trend(line):
    """A serial part shows as the same fraction everywhere, an overhead that grows with the nodes as a growing one."""
    fractions = [karp_flatt(line.middle[point.nodes], point.nodes) for point in line.fitted if point.nodes > 1]
    if line.nodes[0] == 1 and len(fractions) > 2 and fractions[-1] > 1.5 * fractions[0] > 0:
        yield (f"{line.title}: Karp and Flatt's fraction grows from {100 * fractions[0]:.1f} to {100 * fractions[-1]:.1f} %: "
               f"what limits is an overhead that grows with the nodes, rather than a serial part.")


def oversubscription(results):
    counts = sorted({point.nodes for line in results.lines for point in line.points if point.oversubscribed})
    if counts:
        here = results.environments[0]
        yield (f"There are {here['processors']} processors ({here['processors_are']}): runs of "
               f"{', '.join(map(str, counts))} nodes share them. They show what more nodes cost, not how fast they would "
               f"be on processors of their own; no law is fitted to them. Their steps include the time in which other "
               f"nodes had the processor.")


def noise(results):
    noisy = [(line, point) for line in results.lines for point in line.points
             if point.time.upper - point.time.lower > of.NOISY * point.time.median]
    if noisy:
        line, point = max(noisy, key=lambda each: (each[1].time.upper - each[1].time.lower) / each[1].time.median)
        wide = 100 * (point.time.upper - point.time.lower) / point.time.median
        yield (f"{len(noisy)} of {sum(len(line.points) for line in results.lines)} configurations are noisy: their quartiles "
               f"lie more than {100 * of.NOISY:.0f} % of the median apart, at most {wide:.0f} % ({line.title}, "
               f"{nodes_text(point.nodes)}). More repeats or a quieter machine would help.")


def conditions_of(results):
    return conditions.of([point.runs for line in results.lines for point in line.points])


def busy(results):
    here = conditions_of(results)
    trust = "Trust the best times and ratios more than the medians."
    if here.busy:
        yield (f"The machine was busy: a load average up to {here.load[1]} on {here.cores} processors, of which other "
               f"programs took {100 * here.others:.0f} %. {trust}")
    elif here.others is None and results.before > 0.25 * here.cores:
        yield (f"The machine was busy before the study began: a load average of {results.before} on {here.cores} "
               f"processors. {trust}")
