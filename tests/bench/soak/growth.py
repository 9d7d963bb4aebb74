"""What grows while a film is rendered: memory and descriptors of the programs, looked at every few seconds."""
import statistics

import cluster as clusters

MEMORY = (1.25, 16 << 10)  # the last third's middle may be so many times the first third's, and so many kB more
DESCRIPTORS = (1.1, 8)


class Samples:
    def __init__(self, cluster):
        self.cluster = cluster
        self.of = {}  # by program: list of (kB, descriptors), each the most of any of its processes at a time

    def take(self):
        most = {}
        for process in self.cluster.processes(*clusters.OURS):
            memory, descriptors = most.get(process.program, (0, 0))
            most[process.program] = max(memory, process.field("VmRSS")), max(descriptors, process.descriptors())
        for program, sample in most.items():
            self.of.setdefault(program, []).append(sample)

    def growth(self):
        """By program: first and last third's middle of memory (kB) and descriptors, and whether either grew."""
        found = {}
        for program, samples in self.of.items():
            third = max(1, len(samples) // 3)
            middle = lambda part, column: statistics.median(sample[column] for sample in part)
            first, last = ([middle(part, column) for column in (0, 1)] for part in (samples[:third], samples[-third:]))
            grew = any(after > before * times + more
                       for before, after, (times, more) in zip(first, last, (MEMORY, DESCRIPTORS)))
            found[program] = {"samples": len(samples), "memory_kb": [first[0], last[0]],
                              "descriptors": [first[1], last[1]], "grew": grew}
        return found
