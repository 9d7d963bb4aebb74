"""The rules of NX over simulated ranks, and simulated times against those that the platform's figures make.
Takes: cluster/platforms/simulate, the programs of the rules and of the times, and the one of the times over
hal/simulated."""

import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from cases import main  # noqa: E402

SIMULATE, RULES, TIMES, OWN_TIMES = sys.argv[1:5]
# What simulate says of an iPSC/2, in microseconds, with what MPI adds to a message.
SHORT, LONG, HOP, ENVELOPE = 2 * 175, 2 * 330, 30, 16
BYTE = 1 / 2.8


def simulate(nodes, program):
    done = subprocess.run([SIMULATE, str(nodes), program], capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def times_in(output):
    """By what was measured and its bytes, in microseconds."""
    times = {}
    for line in output.splitlines():
        what, bytes_, microseconds = line.rsplit(None, 2)
        times[what, int(bytes_)] = float(microseconds)
    return times


class Simulated(unittest.TestCase):
    def test_the_rules_hold(self):
        for nodes in [1, 3, 8]:
            with self.subTest(nodes=nodes):
                self.assertRegex(simulate(nodes, RULES), r"types/force_is_awaited, \d+ ms\n$")

    def test_times(self):
        output = simulate(8, TIMES)
        times = times_in(output)
        for what, hops, length, ends in [("to a neighbour", 1, 0, SHORT), ("to a neighbour", 1, 100, SHORT),
                                         ("to a neighbour", 1, 101, LONG), ("to a neighbour", 1, 10000, LONG),
                                         ("across the cube", 3, 0, SHORT)]:
            least = ends + hops * HOP + (length + ENVELOPE) * BYTE
            with self.subTest(what=what, bytes=length):
                self.assertGreaterEqual(times[what, length], 0.999 * least)
                self.assertLess(times[what, length], 1.1 * least)
        self.assertGreater(times["gsync", 0], 3 * times["to a neighbour", 0] * 0.9)  # a message a dimension
        self.assertEqual(simulate(8, TIMES), output)  # to the last digit

    def test_both_simulators_agree(self):
        own = subprocess.run([OWN_TIMES, "8"], capture_output=True, text=True, timeout=20, check=True).stdout
        simgrid, own = times_in(simulate(8, TIMES)), times_in(own)
        self.assertEqual(simgrid.keys(), own.keys())
        for key in simgrid:
            with self.subTest(measured=key):
                self.assertLess(abs(own[key] / simgrid[key] - 1), 0.08)


if __name__ == "__main__":
    main()
