"""Nodes that die or stand still in the middle of what they send each other: deaths_test.py BUILD."""
import concurrent.futures
import os
import pathlib
import signal
import sys
import tempfile
import time
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1])]
import apart  # noqa: E402
from cases import main  # noqa: E402
from death import Death  # noqa: E402
from deaths import Deaths, working_in  # noqa: E402

BUILD = pathlib.Path(sys.argv[1]).resolve()
MOST = 60  # seconds


def is_stopped(process):
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] == "T"
    except OSError:
        return False


@unittest.skipUnless(apart.is_possible(), "no user namespaces here")
class Apart(unittest.TestCase):
    def deaths(self):
        folder = self.enterContext(tempfile.TemporaryDirectory(prefix="mars-test-", ignore_cleanup_errors=True))
        return Deaths(BUILD, pathlib.Path(folder), is_apart=True)

    def killed(self, moment):
        """(what went wrong, whether a node died, how often the job was begun again)"""
        return self.deaths().render(Death("mars-node", 2, moment, signal.SIGKILL))[:3]

    def stopped(self, moment):
        """The same of a node that stands still for a moment."""
        deaths = self.deaths()
        with concurrent.futures.ThreadPoolExecutor() as beside:
            rendering = beside.submit(deaths.render, Death("mars-node", 3, moment, signal.SIGSTOP))
            end = time.monotonic() + MOST
            while not (stopped := [each for each in working_in(deaths.folder) if is_stopped(each)]):
                self.assertLess(time.monotonic(), end, "no node stands still")
                time.sleep(0.02)
            time.sleep(0.3)
            os.kill(stopped[0], signal.SIGCONT)
            return rendering.result()[:3]

    def test_a_node_that_ends_or_stops_while_others_await_its_pieces(self):
        """In the ring, within a team. The renderings run side by side, for they wait most of the time."""
        with concurrent.futures.ThreadPoolExecutor() as beside:
            killed = {moment: beside.submit(self.killed, moment) for moment in ("still:2", "bands:1")}
            stopped = beside.submit(self.stopped, "still:2")
        for moment, rendering in killed.items():
            self.assertEqual(rendering.result(), ("", True, 1), moment)
        self.assertEqual(stopped.result(), ("", True, 0))


if __name__ == "__main__":
    main()
