"""Tests on a virtual cluster of their own (cluster/testbed), and on what it needs."""

import json
import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "programs"))
from harness import (ENVIRONMENT, PROGRAMS, SECONDS, SOURCES, ProgramTest, complaints, main,  # noqa: E402,F401
                     spinning_teapot, wait_until)

TESTBED = SOURCES / "cluster/testbed/testbed.sh"
HOSTS = ["n1", "n2", "n3", "n4"]
CLUSTER = dict(ENVIRONMENT, TESTBED=f"test-{os.getpid()}", PATH=f"{PROGRAMS}:{os.environ['PATH']}",
               TMPDIR="/tmp")  # of which every host has its own
CANNOT = ["needs root", "not installed", "cannot make namespaces"]


def testbed(*words, script=TESTBED, **more):
    return subprocess.run([script, *map(str, words)], env=CLUSTER, capture_output=True, text=True,
                          **{"timeout": 120, **more})


def start_cluster(script=TESTBED):
    """The cluster that testbed() reaches; the test is skipped where there cannot be one."""
    started = testbed("up", script=script)
    if started.returncode != 0 and any(why in started.stderr for why in CANNOT):
        raise unittest.SkipTest(started.stderr.strip())
    assert started.returncode == 0, started.stderr


def events(output):
    return [json.loads(line) for line in output.splitlines() if line.startswith("{")]


class ClusterTest(ProgramTest):
    """A cluster for each test class; its hosts see each test's folder, which is not in /tmp."""

    FOLDERS = "/var/tmp"

    @classmethod
    def setUpClass(cls):
        start_cluster()
        cls.addClassCleanup(testbed, "down")
        cls.hostfile = f"/var/tmp/testbed-{CLUSTER['TESTBED']}/hostfile"

    def on(self, host, *words, **more):
        """A command on a host in the test's folder; it must end well unless `code` says otherwise."""
        code = more.pop("code", 0)
        done = testbed("exec", host, *words, cwd=self.folder, **more)
        self.assertEqual(done.returncode, code, f"{words}\n{done.stdout}\n{done.stderr}")
        return done

    def alone(self, film):
        """The film's pixels as one process draws them."""
        self.succeed("mars", "render", film, "-o", "alone", "--backend", "threads", "--nodes", 1, "--quiet")
        return self.verified_hash("alone")


def run_on_cluster():
    """Runs the tests. Who kills them leaves no cluster: what takes it down is nobody's child, for ctest kills those too."""
    subprocess.run(["sh", "-c", f"(while kill -0 {os.getpid()}; do sleep 1; done; exec {TESTBED} down) &"], env=CLUSTER,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True, check=True)
    main()
