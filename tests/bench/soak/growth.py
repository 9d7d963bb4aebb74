"""What grows while a film is rendered: each process's own memory and descriptors, looked at every second in which its
job draws. Memory that processes share, pictures and triangles and the film, counts in each process that has looked at
it: it seems to grow for minutes, and is as large as what is rendered. A leak is in a process's own."""
import statistics

BEGINNING = 8        # of a process's samples are left out: it still makes its buffers
LEAST = 12           # samples of a process that can show growth
MEMORY = (1.1, 4 << 10)  # the last third's median may be the first third's times the first number, plus the second in kB
DESCRIPTORS = (1.1, 8)


class Samples:
    def __init__(self, machines):
        self.machines = machines
        self.of = {}  # by process: list of (kB, descriptors)

    def take(self):
        for process in self.machines.ours():
            sample = process.field("RssAnon"), process.descriptors()
            if all(sample):
                self.of.setdefault(process, []).append(sample)

    def growth(self):
        """By program: how many of its processes lived long enough, and of that which grew most, its first and last
        third's middle of memory (kB) and descriptors, and whether any grew."""
        found = {}
        for process, samples in self.of.items():
            found.setdefault(process.program, []).append(samples[BEGINNING:])
        return {program: self.most_grown([samples for samples in lives if len(samples) >= LEAST])
                for program, lives in found.items() if any(len(samples) >= LEAST for samples in lives)}

    @staticmethod
    def most_grown(lives):
        thirds = [first_and_last(samples) for samples in lives]
        first, last = max(thirds, key=lambda pair: pair[1][0] - pair[0][0])
        return {"processes": len(lives), "longest": max(map(len, lives)), "memory_kb": [first[0], last[0]],
                "descriptors": [first[1], last[1]], "grew": any(grew(*pair) for pair in thirds)}


def first_and_last(samples):
    """The middles of the first and last third, each (kB, descriptors)."""
    third = len(samples) // 3
    return [[statistics.median(column) for column in zip(*part)] for part in (samples[:third], samples[-third:])]


def grew(first, last):
    return any(after > before * times + more
               for before, after, (times, more) in zip(first, last, (MEMORY, DESCRIPTORS)))
