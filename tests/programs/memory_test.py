"""A node's memory: films with shadows have the same pixels with little of it, or are refused before nodes load them; and
what mars plan says covers what processes take."""

import json
import os
import subprocess
import sys
import time
import unittest

from harness import ENVIRONMENT, EXAMPLES, PROGRAMS, SANITIZED, ProgramTest, family, main

sys.path.append(str(EXAMPLES))
from node_memory import proportional_bytes  # noqa: E402

SIZE = ["--size", "480x270"]


class Memory(ProgramTest):
    def film(self):
        film = json.loads((EXAMPLES / "s3s.json").read_text())
        film.update(frames=4, samples=4)
        film["lights"].append({"place": [-15, 10, 25], "color": [0.3, 0.3, 0.3], "shadow": True})
        return self.write("film.json", film)

    def rendered(self, memory, *words):
        report = self.folder / "report.json"
        self.succeed("mars", "render", self.film(), *SIZE, "--nodes", 2, "--backend", "threads", "-o",
                     self.folder / "out", "--overwrite", "--report", report, "--quiet", *words,
                     env=dict(ENVIRONMENT, MARS_MEMORY=memory))
        frames = json.loads((self.folder / "out" / "frames.json").read_text())["frames"]
        return json.loads(report.read_text())["node_memory"], frames

    def test_pixels_do_not_depend_on_it(self):
        much, pixels = self.rendered("1024")
        little, same = self.rendered("25")
        self.assertEqual(pixels, same)
        self.assertLess(little["shadows"], 0.1 * much["shadows"])
        self.assertEqual(sum(little[part] for part in ("frames", "still", "shadows")), 25 << 20)

    def test_too_little_is_refused_before_nodes_load_the_film(self):
        for backend in self.backends():
            refused = self.mars("render", self.film(), *SIZE, "--nodes", 2, "--backend", backend, "--sink", "none",
                                env=dict(ENVIRONMENT, MARS_MEMORY="12"))
            self.assertEqual(refused.returncode, 1)
            self.assertIn("shadows of this film need", refused.stderr)
            self.assertIn("set MARS_MEMORY to ", refused.stderr)
            self.assertNotIn("node 0", refused.stderr)

    @unittest.skipIf(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") > 40 << 30, "the machine has so much")
    def test_pictures_that_the_host_cannot_keep_are_refused_with_what_helps(self):
        refused = self.mars("render", self.film(), "--size", "16384x16384", "--format", "exr", "--layers", "all", "-o",
                            "out", "--backend", "threads", "--nodes", 2)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("GB of memory, where there are", refused.stderr)
        self.assertIn("render a smaller picture (--size)", refused.stderr)
        self.assertIn("fewer layers (--layers)", refused.stderr)

    @unittest.skipIf(SANITIZED, "sanitizers have memory of their own")
    def test_the_plan_covers_what_processes_take(self):
        words = [self.film(), *SIZE, "--nodes", "2", "--groups", "1", "--sink", "none"]
        plan = json.loads(self.succeed("mars", "plan", *words, "--platform", "reference", "--json"))
        job = subprocess.Popen([PROGRAMS / "mars", "render", *map(str, words), "--backend", self.backends()[-1], "--quiet"],
                               env=ENVIRONMENT)
        most = 0
        while job.poll() is None:
            most = max(most, sum(map(proportional_bytes, family(job.pid))))
            time.sleep(0.02)
        self.assertEqual(job.returncode, 0)
        self.assertLess(most, plan["machine_memory"])
        self.assertGreater(most, plan["machine_memory"] / 10)


if __name__ == "__main__":
    main()
