"""Runs as a study would have measured them, for tests: made of known times and seeded noise."""
import numpy

from study import in_pairs, strong, turns as turns_of

PHASES = {"dice": 0.3, "sum": 0.05, "map": 0.01, "exchange": 0.04, "fill": 0.1, "scanline": 0.45,
          "depth": 0.03, "credit": 0.02}
WORK = {"vertices": 1000, "edge_boxes_diced": 1000, "edge_boxes": 1000, "samples": 3000, "bytes_to_nodes": 10,
        "bytes_to_host": 100}
NONE = {"frames": 0, "seconds": dict.fromkeys(PHASES, 0.0), "work": {}}
CORES = 16


def noisy(chance, outliers):
    """A factor as shared machines give it: never much below 1, now and then far above."""
    return 1 + 0.02 * chance.exponential() + 0.3 * (chance.random() < outliers) * chance.exponential()


def run(nodes, repeat, chance, host_of=lambda node: "n1", times=lambda host, phase: 1.0, serial=0.05, moment=1.0,
        settings=(), outliers=0.1, load=0.5, others=0.0):
    """One run whose phases take `times(host, phase)` times as long as they should, and by the clock `moment` times that;
    others take the share `others` of the machine."""
    ideal = (serial + (1 - serial) / nodes) * noisy(chance, outliers)
    per_node = []
    for node in range(nodes):
        host = host_of(node)
        seconds = {phase: moment * ideal * share * times(host, phase) * noisy(chance, 0.01)
                   for phase, share in PHASES.items()}
        per_node.append({"node": node, "host": host, "binding": "", "simd": "", "inbetween": NONE,
                         "keyframe": {"frames": 1, "seconds": seconds, "work": WORK}})
    slowest = max(sum(node["keyframe"]["seconds"].values()) for node in per_node)
    work = (serial * nodes + 1 - serial) * sum(share * times(host_of(0), phase) for phase, share in PHASES.items())
    return {"series": {"film": "made.json", "kind": "strong", "settings": dict(settings)}, "film": "made.json",
            "nodes": nodes, "repeat": repeat, "load_average": load, "load_average_after": load, "backend": "made",
            "checksum": "0", "size": [64, 36], "seconds": slowest * 1.02, "frames": {"keyframe": 1, "inbetween": 0},
            "frame_seconds": {"keyframe": slowest, "inbetween": None}, "load_ratio": 1.0, "per_node": per_node,
            "wall_seconds": slowest * 1.1, "processor_seconds": work * noisy(chance, outliers / 2), "involuntary_switches": 9,
            "others_seconds": others * CORES * slowest * 1.1,
            "environment": {"machine": "made", "processors": CORES, "processors_are": "made", "cores": CORES}}


def quiet(chance, count):
    """How many times as long each run takes by the clock, for a number of runs one after the other; as do the next three."""
    return numpy.ones(count)


def heavy_tailed(chance, count):
    return 1 + 0.5 * (chance.random(count) < 0.15) * chance.standard_cauchy(count)**2


def drifting(chance, count):
    return numpy.exp(numpy.cumsum(0.03 * chance.normal(size=count)))


def busy(chance, count):
    """With eight busy loops on two processors: for a while more, for a while less."""
    waves = numpy.convolve(chance.normal(size=count + 9), numpy.full(10, 0.1**0.5), "valid")
    return 4 * numpy.exp(0.2 * waves + 0.1 * chance.normal(size=count))


def study(seed, nodes=(1, 2, 4, 8), repeats=5, moments=quiet, **how):
    chance = numpy.random.default_rng(seed)
    turns = [(count, repeat) for repeat in range(1, repeats + 1) for count in nodes]
    return {}, [run(*turn, chance, moment=moment, **how) for turn, moment in zip(turns, moments(chance, len(turns)))]


def against(seed, nodes=(1,), repeats=20, moments=quiet, times_of_b=lambda host, phase: 1.0, second=1.0, **how):
    """A study of two programs. Of each pair's runs the second takes `second` times as long by the clock."""
    chance = numpy.random.default_rng(seed)
    turns = list(in_pairs(turns_of(list(strong(["made.json"], nodes, {})), 0, repeats, seed), seed))
    lengths = moments(chance, len(turns)) * numpy.resize([1.0, second], len(turns))
    times = {"A": lambda host, phase: 1.0, "B": times_of_b}
    return {}, [run(configuration.nodes, repeat, chance, moment=moment, settings=configuration.series.settings,
                    times=times[configuration.setting("program")], **how)
                for (configuration, repeat), moment in zip(turns, lengths)]
