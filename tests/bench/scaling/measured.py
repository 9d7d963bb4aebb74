"""Runs as a study would have measured them, for tests: made of known times and seeded noise."""
import numpy

PHASES = {"dice": 0.3, "sum": 0.05, "map": 0.01, "exchange": 0.04, "fill": 0.1, "scanline": 0.45,
          "depth": 0.03, "credit": 0.02}
WORK = {"vertices": 1000, "edge_boxes_diced": 1000, "edge_boxes": 1000, "samples": 3000, "bytes_to_nodes": 10,
        "bytes_to_host": 100}
NONE = {"frames": 0, "seconds": dict.fromkeys(PHASES, 0.0), "work": {}}


def noisy(chance, outliers):
    """A factor as shared machines give it: never much below 1, now and then far above."""
    return 1 + 0.02 * chance.exponential() + 0.3 * (chance.random() < outliers) * chance.exponential()


def run(nodes, repeat, chance, host_of=lambda node: "n1", times=lambda host, phase: 1.0, serial=0.05):
    """One run whose phases take `times(host, phase)` times as long as they should."""
    ideal = (serial + (1 - serial) / nodes) * noisy(chance, 0.1)
    per_node = []
    for node in range(nodes):
        host = host_of(node)
        seconds = {phase: ideal * share * times(host, phase) * noisy(chance, 0.01) for phase, share in PHASES.items()}
        per_node.append({"node": node, "host": host, "binding": "", "simd": "", "inbetween": NONE,
                         "keyframe": {"frames": 1, "seconds": seconds, "work": WORK}})
    slowest = max(sum(node["keyframe"]["seconds"].values()) for node in per_node)
    return {"series": {"film": "made.json", "kind": "strong", "settings": {}}, "film": "made.json", "nodes": nodes,
            "repeat": repeat, "load_average": 0.0, "backend": "made", "checksum": "0", "size": [64, 36],
            "seconds": slowest * 1.02, "frames": {"keyframe": 1, "inbetween": 0},
            "frame_seconds": {"keyframe": slowest, "inbetween": None}, "load_ratio": 1.0, "per_node": per_node,
            "environment": {"processors": 16, "processors_are": "made", "cores": 16}}


def study(seed, nodes=(1, 2, 4, 8), repeats=5, **how):
    chance = numpy.random.default_rng(seed)
    return {}, [run(count, repeat, chance, **how) for repeat in range(1, repeats + 1) for count in nodes]
