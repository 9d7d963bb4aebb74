"""--trace FILE: a whole file in every backend, of a run that fails too, and printed before rendering if it cannot be."""

import json
import subprocess
import unittest

from harness import (ENVIRONMENT, EXAMPLES, OWN_MPIRUN, PROGRAMS, ProgramTest, SideBySide, complaints, main, needs_mpi,
                     spinning_teapot)

ARM = EXAMPLES / "robot-arm.json"


def may_shift_clocks():
    return subprocess.run(["unshare", "--time", "--monotonic", "5", "--fork", "true"],
                          capture_output=True).returncode == 0


class Traces(SideBySide, ProgramTest):
    def trace(self):
        return json.loads((self.folder / "trace.json").read_text())

    def test_every_rank_is_there(self):
        for backend in self.backends():
            with self.subTest(backend=backend):
                self.succeed("mars", "render", ARM, "-o", "out", "--size", "64x36", "--frames", "0-9", "--nodes", 2,
                             "--overwrite", "--backend", backend, "--trace", "trace.json", "--report", "report.json")
                trace = self.trace()
                self.assertEqual(trace["otherData"]["backend"], backend)
                self.assertEqual(trace["otherData"]["events_beyond_bound"], 0)
                slices = [event for event in trace["traceEvents"] if event["ph"] == "X"]
                self.assertEqual({event["pid"] for event in slices}, {0, 1, 2})
                frames = {event["name"] for event in slices if event["name"].split()[0] in ("keyframe", "inbetween")}
                self.assertEqual(sorted(int(name.split()[1]) for name in frames), list(range(10)))
                self.assertPhasesAreReported(slices)

    def assertPhasesAreReported(self, slices):
        report = json.loads((self.folder / "report.json").read_text())
        for frame in report["frames"]:
            for node in frame["nodes"]:
                for phase, seconds in node["seconds"].items():
                    traced = sum(each["dur"] for each in slices if each["pid"] == node["node"]
                                 and each["name"] == phase and each["args"].get("frame") == frame["frame"])
                    self.assertAlmostEqual(traced / 1e6, seconds, delta=1e-7)

    def test_of_a_run_that_fails(self):
        """A node whose memory is too short for one line of a large picture says so when it has diced."""
        for backend in self.backends():
            with self.subTest(backend=backend):
                self.fail_clearly(1, "render", EXAMPLES / "s2.json", "--sink", "none", "--size", "7680x4320", "--nodes", 2,
                                  "--backend", backend, "--trace", "trace.json", says="set MARS_MEMORY to more",
                                  env=dict(ENVIRONMENT, MARS_MEMORY="1"))
                trace = self.trace()
                self.assertIn("MARS_MEMORY", trace["otherData"]["fault"])
                instants = [event["name"] for event in trace["traceEvents"] if event["ph"] == "i"]
                self.assertEqual(len(instants), 1)
                self.assertIn("failed: node ", instants[0])
                self.assertIn("dice", {event["name"] for event in trace["traceEvents"]})
                (self.folder / "trace.json").unlink()

    @needs_mpi
    @unittest.skipUnless(may_shift_clocks(), "no time namespaces here")
    def test_clocks_of_their_own(self):
        """Nodes whose clocks differ, as on machines of a cluster, are brought to the host's time."""
        nodes = []
        for seconds in [12345, 777]:
            nodes += [":", "-n", 1, "unshare", "--time", "--monotonic", seconds, "--fork", PROGRAMS / "mars-node"]
        self.succeed(*OWN_MPIRUN, "-n", 1, PROGRAMS / "mars-host", ARM, "--sink", "none", "--frames", "0-9",
                     "--trace", "trace.json", *nodes)
        trace = self.trace()
        error = trace["otherData"]["clock_error_microseconds"]
        self.assertGreater(error, 0)
        events = trace["traceEvents"]
        sent = {event["id"]: event["ts"] for event in events if event["ph"] == "s"}
        self.assertGreater(len(sent), 20)
        for event in events:
            if event["ph"] == "f":
                self.assertGreater(event["ts"], sent[event["id"]] - 2 * error)
            self.assertLess(abs(event["ts"]), 700e6)  # the clocks differ by more

    def test_that_cannot_be_written(self):
        self.fail_clearly(1, "render", ARM, "-o", "out", "--trace", "none/trace.json", says="none/trace.json")
        self.assertEqual(list(self.folder.glob("out/*")), [])

    def test_of_a_film_too_long_for_it(self):
        film = self.write("film.json", spinning_teapot(2500, [8, 8]))
        done = self.mars("render", film, "--sink", "none", "--backend", "threads", "--nodes", 8, "--groups", 1,
                         "--no-coherence", "--trace", "trace.json")  # all nodes draw each frame, and say so
        self.assertEqual((done.returncode, complaints(done.stderr)), (0, ""))
        with open(self.folder / "trace.json") as file:  # its first line says what is in it
            head_of_file = json.loads(file.readline().removesuffix(',"traceEvents":[\n') + "}")
        lacks = head_of_file["otherData"]["events_beyond_bound"]
        self.assertGreater(lacks, 0)
        self.assertIn(f"the trace was full: it lacks {lacks} later events", done.stdout.splitlines()[-1])
        self.assertLess((self.folder / "trace.json").stat().st_size, 200e6)


if __name__ == "__main__":
    main()
