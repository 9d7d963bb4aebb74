"""More nodes than processors: who waits sleeps."""

import os
import pathlib
import re
import subprocess
import sys
import time
import unittest

from harness import (ENVIRONMENT, EXAMPLES, MPICH, PROGRAMS, SECONDS, ProgramTest, endless_film, family, main, needs_mpi,
                     stopped, wait_until)

SLEEPS = 100  # of a process that looks at most 1000 times a second whether something came, and sleeps between


def tasks_of(process):
    return pathlib.Path(f"/proc/{process}/task").iterdir()


def times_it_slept(process):
    """How often its threads have gone to sleep. A thread that spins or yields does not."""
    return sum(int(re.search(r"^voluntary_ctxt_switches:\s*(\d+)", (task / "status").read_text(), re.M)[1])
               for task in tasks_of(process))


def seconds_it_ran(process):
    return sum(int((task / "schedstat").read_text().split()[0]) for task in tasks_of(process)) / 1e9


class ProcessorTime(ProgramTest):
    def measured(self, programs, film):
        return subprocess.run([sys.executable, EXAMPLES / "processor_time.py", programs, film, "--nodes", "1,2", "--repeat",
                               "2", "--frames", "0-3", "--size", "32x18"], capture_output=True, text=True, env=ENVIRONMENT)

    def test_every_run_draws_into_a_folder_of_its_own(self):
        programs, log = self.folder / "bin", self.folder / "log"
        programs.mkdir()
        (programs / "mars").write_text(f'#!/bin/sh\nfor word; do test "$last" = -o && ls -d "$word" >> {log} 2>&1; last=$word; '
                                       f'done\nexec {PROGRAMS}/mars "$@"\n')
        (programs / "mars").chmod(0o755)
        measured = self.measured(programs, EXAMPLES / "cubes.json")
        self.assertEqual((measured.returncode, measured.stderr), (0, ""))
        self.assertEqual([line.split()[0] for line in measured.stdout.splitlines()], ["nodes", "1", "2"])
        self.assertEqual(log.read_text().count("No such file"), 8)

    def test_what_mars_refuses_has_its_words_alone(self):
        refused = self.measured(PROGRAMS, self.folder / "none.json")
        self.assertEqual(refused.returncode, 1)
        self.assertRegex(refused.stderr, r"^mars: .*none.json: there is no such file.*\n$")


@needs_mpi
@unittest.skipIf(MPICH, "MPICH spins while it starts, for seconds where ranks share processors")
class Oversubscription(ProgramTest):
    def assert_sleep_between_looks(self, processes):
        """What a look costs is the machine's, and how soon the process runs again, too. But it takes little of a processor
        until it sleeps again, where a process that spins takes all that it gets."""
        began, before = time.monotonic(), {each: (times_it_slept(each), seconds_it_ran(each)) for each in processes}
        for each, (slept, ran) in before.items():
            wait_until(lambda: times_it_slept(each) >= slept + SLEEPS, SECONDS, "it spins", pause=0.1)
            sleeps = times_it_slept(each) - slept
            self.assertLess((seconds_it_ran(each) - ran) / sleeps, 0.001)
            self.assertLess(sleeps / (time.monotonic() - began), 1500)

    def test_who_waits_sleeps(self):
        film = self.write("film.json", endless_film())
        job = self.start_mars("render", film, "-o", "out", "--nodes", 16, "--backend", "mpi")
        ours = {"mars-host": [], "mars-node": []}
        for each, (_, _, program) in family(job.pid).items():
            ours.get(os.path.basename(program), []).append(each)
        self.assertEqual({program: len(processes) for program, processes in ours.items()}, {"mars-host": 1, "mars-node": 16})
        for waiting, still in [("mars-node", "mars-host"), ("mars-host", "mars-node")]:
            with self.subTest(waiting=waiting), stopped(ours[still]):
                time.sleep(1)  # until they have nothing left to do
                self.assert_sleep_between_looks(ours[waiting])


if __name__ == "__main__":
    main()
