"""mars calibrate: a platform that the simulator takes, by file and by name; simulated times are the same twice."""

import json

from harness import ENVIRONMENT, EXAMPLES, SOURCES, ProgramTest, main

KINDS = ["patch", "meshlet", "vertex", "mesh_vertex", "triangle_tested", "triangle", "edge_box_made", "edge_box",
         "sample", "shaded", "facet_light", "pixel"]  # whose units do not depend on the number of nodes
FEW = ["--sink", "none", "--size", "64x36", "--frames", "0-5"]


class Calibrations(ProgramTest):
    def simulate(self, platform, **more):
        self.succeed("mars", "render", EXAMPLES / "teapot.json", *FEW, "--backend", "simulated", "--nodes", 3,
                     "--platform", platform, "--report", "report.json", **more)
        return json.loads((self.folder / "report.json").read_text())

    def test_a_calibration_is_a_platform(self):
        home = dict(ENVIRONMENT, HOME=str(self.folder), XDG_DATA_HOME="")
        missing = self.mars("render", EXAMPLES / "teapot.json", *FEW, "--backend", "simulated", "--platform", "here",
                            env=home)
        self.assertEqual(missing.returncode, 1)
        self.assertIn("run mars calibrate", missing.stderr)
        file = self.folder / ".local/share/mars/here.json"
        printed = self.succeed("mars", "calibrate", "--repeats", 1, "--trials", 0, env=home)
        for word in ["edge_box", "nanoseconds", "scanline", "middle error"]:
            self.assertIn(word, printed)
        platform = json.loads(file.read_text())
        self.assertEqual("doubt" in platform, "too busy" in printed)
        platform.pop("doubt", None)
        file.write_text(json.dumps(platform))
        self.assertNotIn("spread", platform)
        self.assertEqual(len(platform["not_identified"]), printed.count("   not identified\n"))
        self.assertGreater(len(platform["not_identified"]), 0)
        costs = platform["work"]
        for kind in ["patch", "edge_box", "light", "encoded_byte"]:
            self.assertGreater(costs[kind] + costs["first_frame"], 0)
        calibrated = self.simulate("here", env=home)
        self.assertEqual(calibrated["total_seconds"], self.simulate(file)["total_seconds"])
        self.assertNotEqual(calibrated["total_seconds"], self.simulate("fat-tree:here", env=home)["total_seconds"])

    def test_simulated_digits_are_the_same_twice(self):
        first, second = self.simulate("fat-tree"), self.simulate("fat-tree")
        self.assertEqual(first["frames"], second["frames"])
        self.assertEqual(first["total_seconds"], second["total_seconds"])

    def test_noise_is_that_of_its_seed(self):
        def seconds(seed):
            platform = json.loads((SOURCES / "cluster/platforms/fat-tree.json").read_text())
            platform["noise"] = {"seed": seed, "stragglers": 0.5, "slowdown": [1.2, 2], "detours": 1000, "detour": 1e-4}
            return self.simulate(self.write("noisy.json", platform))["total_seconds"]

        self.assertEqual(seconds(1), seconds(1))
        self.assertNotEqual(seconds(1), seconds(2))
        self.assertGreater(seconds(1), self.simulate("fat-tree")["total_seconds"])

    def test_slow_computers_get_fewer_inbetweens(self):
        def report(**changed):
            platform = json.loads((SOURCES / "cluster/platforms/ipsc2.json").read_text())
            platform["computers"].update(changed)
            done = self.mars("render", EXAMPLES / "cubes.json", "--sink", "none", "--size", "64x36", "--samples", 1,
                             "--backend", "simulated", "--nodes", 4, "--groups", 1, "--report", "report.json",
                             "--platform", self.write("slow.json", platform))
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads((self.folder / "report.json").read_text())

        self.assertEqual(report()["slow"], [])
        self.assertEqual([time["node"] for time in report(speeds=[[3, 1], [1, 0.25]])["slow"]], [3])

    def test_nodes_together_count_what_one_counts(self):
        def charged(nodes):
            self.succeed("mars", "render", EXAMPLES / "stones.json", *FEW, "--backend", "threads", "--nodes", nodes,
                         "--report", "report.json")
            report = json.loads((self.folder / "report.json").read_text())
            parts = [node["work"]["charged"] for frame in report["frames"] for node in frame["nodes"]]
            return [{kind: sum(part.get(kind, 0) for part in parts) for kind in KINDS}, report["host"]["charged"]]

        one, three = charged(1), charged(3)
        self.assertEqual(one[0], three[0])
        self.assertGreater(min(one[0].values()), 0)
        self.assertEqual(one[1]["host_frame"], three[1]["host_frame"])

    def test_few_trials_are_refused(self):
        self.fail_clearly(2, "calibrate", "--trials", 18, says="is neither 0 nor a number from 19 to 1000")

    def test_nothing_is_measured_where_nothing_can_be_written(self):
        refused = self.mars("calibrate", "-o", "no/such/folder.json")
        self.assertEqual(refused.returncode, 1)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    main()
