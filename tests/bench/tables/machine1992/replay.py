"""How long a recorded job of the 1992 program takes on the iPSC/2: the rules of hal/simulated in short, so that a fit
can try many costs. simulate.py compares both."""
import json
import math
import os

import numpy

from costs import WORKS, seconds

IPSC2 = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../../cluster/platforms/ipsc2.json")


class Network:
    def __init__(self, path=IPSC2):
        with open(path) as file:
            network = json.load(file)["network"]
        self.byte = 1 / network["rate"]
        self.hop = network["hop"]
        (_, send), (_, self.send) = network["send"]
        (_, receive), (_, self.receive) = network["receive"]
        self.short = send + receive + self.hop
        self.long = self.send + self.receive + self.hop


class Costs:
    """The fitted ones; times in seconds."""
    NAMES = ("speed", "host_byte", "host_message", "depth")

    def __init__(self, speed, host_byte, host_message, depth):
        self.speed, self.host_byte, self.host_message, self.depth = speed, host_byte, host_message, depth
        self.work = numpy.array(seconds(speed, depth))

    def of(self, work):
        """Of a unit."""
        return self.work[WORKS.index(work)]


LINES = 480
FLAGS = 512 * LINES / 16  # of the host's blocks (host.cpp)


def keyframe(job, costs, network):
    """Seconds until host and nodes are through."""
    steps = math.ceil(math.log2(job.nodes))
    summed = (job.lists @ costs.work).max() + steps * (network.long + 8 * LINES * network.byte)
    passed = network.byte * numpy.maximum(job.sent.sum(0), job.sent.sum(1)) + (job.nodes - 1) * network.long
    ready = summed + passed + job.lines @ costs.work
    shown, sent, busy = host_shows(job, ready, costs, network)
    gathered = gather(job.depths, sent, busy, network) + job.depth @ costs.work
    return max(shown, gathered.max() if job.nodes > 1 else 0)


def gather(parts, times, busy, network):
    """When each node has all parts, by dimension exchange, if it begins at its time and its channel towards node 0 is
    busy until then. A large part is passed on at every step."""
    times, nodes, bit = numpy.array(times), numpy.arange(len(parts)), 1
    totals = numpy.concatenate([[0], numpy.cumsum(parts)])
    while bit < len(parts):
        other = nodes ^ bit
        first = other & ~(bit - 1)
        begun = numpy.where(nodes & -nodes == bit, numpy.maximum(times + network.send, busy), times + network.send)
        came = begun[other] + network.hop + network.byte * (totals[first + bit] - totals[first])
        times = numpy.maximum(times + network.send, came) + network.receive
        bit *= 2
    return times


def host_shows(job, ready, costs, network):
    """When the host has taken all strips of a keyframe, when each node had begun to send its last, and until when its
    channel towards node 0 is busy. The host takes one after the other; a node's next comes behind those that wait."""
    work = (job.host[0] @ costs.work) / job.strips.sum()
    queue = sorted((time, node, 0) for node, time in enumerate(ready))
    clock, last_sent, busy = 0.0, numpy.array(ready), numpy.zeros(job.nodes)
    while queue:
        time, node, number = queue.pop(0)
        size = job.strips[node, number]
        sent = max(clock, time + network.short / 2) + network.short / 2 + network.send
        came = sent + size * wire(node, costs, network)
        clock = came + size * work + costs.host_message
        last_sent[node] = sent
        for at in route(node):
            busy[at] = came
        if number + 1 < job.strips.shape[1]:
            queue.append((sent, node, number + 1))
            queue.sort()
    return clock, last_sent, busy


def route(node):
    """The nodes on the way to node 0, before it: each clears its lowest bit."""
    while node:
        yield node
        node &= node - 1


def wire(node, costs, network):
    """Seconds a byte to the host, at the rate of the slowest channel on the way."""
    return costs.host_byte if node == 0 else max(costs.host_byte, network.byte)


def inbetween(job, nodes, costs, network, rounds=1):
    """Seconds a frame: each node draws one in each round, and the host shows them in order."""
    clock, free = 0.0, [0.0] * nodes
    for number in range(rounds * nodes):
        node, k = number % nodes, number % len(job.moving)
        drawn = free[node] + job.inbetweens[k] @ costs.work + network.short / 2
        free[node] = max(clock, drawn) + network.short / 2 + network.send
        clock = free[node] + sum(host_takes(job, node, k, costs, network).values())
    return clock / (rounds * nodes)


def host_takes(job, node, k, costs, network):
    """Seconds of the host for the kth inbetween when `node` sends it: the strip on its link, what a message costs, flags
    of blocks looked at, pixels looked at, written and restored."""
    flags = FLAGS * costs.of("look")
    return {"link": job.moving[k] * wire(node, costs, network), "message": costs.host_message, "flags": flags,
            "pixels": job.host[1 + k] @ costs.work - flags}
