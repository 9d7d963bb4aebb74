"""A node or host that stands still: who says so, when, and that it goes on when they do."""

import json
import os
import queue
import signal
import subprocess
import threading
import time

from harness import (ENVIRONMENT, OWN_MPIRUN, PROGRAMS, SECONDS, ProgramTest, family, living, main, needs_mpi,
                     spinning_teapot, wait_until)

LONG = 30000  # frames


@needs_mpi
class Hanging(ProgramTest):
    def setUp(self):
        super().setUp()
        film = self.write("film.json", spinning_teapot(LONG, [160, 90]))
        self.job = subprocess.Popen(
            [*OWN_MPIRUN, "-n", "1", PROGRAMS / "mars-host", film, "--sink", "none", ":", "-n", "2",
             PROGRAMS / "mars-node"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
        self.addCleanup(self.end, self.job)
        self.events = queue.Queue()
        threading.Thread(target=self.read, daemon=True).start()
        self.next(lambda event: event["event"] == "frame")
        self.family = family(self.job.pid)

    def read(self):
        for line in self.job.stdout:
            self.events.put(json.loads(line))

    def next(self, wanted):
        """The next event that is wanted."""
        end = time.monotonic() + SECONDS
        while True:
            event = self.events.get(timeout=max(0.01, end - time.monotonic()))
            if wanted(event):
                return event

    def kin(self, program):
        return sorted(p for p, (_, _, executable) in self.family.items() if executable.endswith("/" + program))

    def test_a_node_that_stands_still_is_named_and_may_go_on(self):
        stopped = self.kin("mars-node")[-1]
        os.kill(stopped, signal.SIGSTOP)
        named = self.next(lambda event: event["event"] == "beat" and event["silent"])
        self.assertEqual(len(named["silent"]), 1, "the other waits for it, and says so")
        self.assertGreaterEqual(named["silent"][0]["silent"], 5)
        os.kill(stopped, signal.SIGCONT)
        self.next(lambda event: event["event"] == "beat" and not event["silent"])
        self.next(lambda event: event["event"] == "frame")
        os.kill(self.kin("mars-host")[0], signal.SIGTERM)
        drawing = self.next(lambda event: event["event"] == "drawing")
        self.assertTrue(drawing["nodes"])
        wait_until(lambda: not living(self.family), SECONDS, "its processes live on")


if __name__ == "__main__":
    main()
