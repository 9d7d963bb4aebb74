"""More nodes than processors: who waits sleeps."""

import os
import pathlib
import re
import signal
import time

import unittest

from harness import ENDLESS, MPICH, ProgramTest, family, main, needs_mpi, spinning_teapot


def sleeps(process):
    """Whether its main thread sleeps, rather than runs or is ready to."""
    return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] == "S"


def times_it_slept(process):
    """How often its threads have gone to sleep. A thread that spins or yields does not."""
    tasks = pathlib.Path(f"/proc/{process}/task").glob("*/status")
    return sum(int(re.search(r"^voluntary_ctxt_switches:\s*(\d+)", task.read_text(), re.M)[1]) for task in tasks)


@needs_mpi
@unittest.skipIf(MPICH, "MPICH spins while it starts, for seconds where ranks share processors")
class Oversubscription(ProgramTest):
    def start_many(self):
        film = self.write("film.json", spinning_teapot(ENDLESS, [160, 90]))
        process = self.start_mars("render", film, "-o", "out", "--nodes", 16, "--backend", "mpi")
        ours = {"mars-host": [], "mars-node": []}
        for each, (_, _, program) in family(process.pid).items():
            ours.get(os.path.basename(program), []).append(each)
        return ours["mars-host"], ours["mars-node"]

    def assert_sleeps_while_stopped(self, waiting, stopped):
        """Each of `waiting` looks at most 1000 times a second whether something came (a look that also moves a message
        of its own on), and sleeps between. What a look costs is the machine's, so the test asks at many moments who
        sleeps: a process that spins would never be found asleep."""
        for each in stopped:
            os.kill(each, signal.SIGSTOP)
        time.sleep(1)  # until they have nothing left to do
        start, slept = time.monotonic(), sum(map(times_it_slept, waiting))
        asleep = {process: [] for process in waiting}
        while time.monotonic() < start + 3:
            for process, moments in asleep.items():
                moments.append(sleeps(process))
            time.sleep(0.01)
        seconds = time.monotonic() - start
        self.assertEqual([process for process, moments in asleep.items() if not any(moments)], [], "these spin")
        moments = sum(asleep.values(), [])
        self.assertGreater(sum(moments) / len(moments), 0.3)
        self.assertLess((sum(map(times_it_slept, waiting)) - slept) / seconds, 1500 * len(waiting))

    def test_nodes_sleep_while_the_host_gives_nothing(self):
        host, nodes = self.start_many()
        self.assertEqual((len(host), len(nodes)), (1, 16))
        self.assert_sleeps_while_stopped(nodes, host)

    def test_the_host_sleeps_while_nodes_give_nothing(self):
        host, nodes = self.start_many()
        self.assert_sleeps_while_stopped(host, nodes)


if __name__ == "__main__":
    main()
