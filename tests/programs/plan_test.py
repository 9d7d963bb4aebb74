"""mars plan says what a rendering takes, soon and without rendering; mars render shows the time that is left by it."""

import json
import re

from harness import ENVIRONMENT, EXAMPLES, SOURCES, ProgramTest, main, processor_seconds

CUBES = EXAMPLES / "cubes.json"


class Plans(ProgramTest):
    def test_a_plan_names_time_memory_bytes_and_nodes(self):
        printed = self.succeed("mars", "plan", CUBES, "--nodes", 4, "--platform", "fat-tree")
        for line in [r"platform +fat-tree", r"nodes +4 nodes in \d groups?", r"seconds +[\d.e-]+ \(.+\)", r"node hours +[\d.e-]+",
                     r"a node +[\d.]+ MB for a frame, [\d.]+ MB for strips", r"the host +[\d.]+ MB at most",
                     r"messages +[\d.]+ MB between nodes, [\d.]+ MB to the host", r"counted +\d+ of 96 frames",
                     r"best +\d nodes? in \d groups?, [\d.e-]+ seconds", r" +4 +\d +[\d.e-]+ +[\d.]+ +[\d.e-]+"]:
            self.assertRegex(printed, re.compile(f"^{line}$", re.MULTILINE))

    def test_programs_read_it_as_json(self):
        plan = json.loads(self.succeed("mars", "plan", CUBES, "--nodes", 4, "--platform", "fat-tree", "--json"))
        self.assertEqual([each["nodes"] for each in plan["by_nodes"]], [1, 2, 4])
        self.assertEqual(plan["seconds"], plan["by_nodes"][-1]["seconds"])
        self.assertLessEqual(plan["best"]["seconds"], 1.05 * min(each["seconds"] for each in plan["by_nodes"]))
        self.assertAlmostEqual(plan["node_hours"], 4 * plan["seconds"] / 3600)

    def test_all_frames_are_counted_once(self):
        counts = self.folder / "cubes.counts"
        words = ["mars", "plan", CUBES, "--nodes", 4, "--counted", counts, "--platform"]
        first = self.succeed(*words, "fat-tree")
        self.assertRegex(first, r"counted +96 of 96 frames")
        written = counts.read_bytes()
        self.assertEqual(self.succeed(*words, "fat-tree"), first)
        self.assertIn("counted     96 of 96 frames", self.succeed(*words, "ethernet"))
        self.assertEqual(counts.read_bytes(), written)

    def test_counts_of_another_film_or_damaged_ones_are_refused(self):
        counts = self.folder / "cubes.counts"
        words = ["plan", CUBES, "--nodes", 2, "--platform", "fat-tree", "--counted", counts]
        self.succeed("mars", *words)
        written = counts.read_bytes()
        other = self.mars(*words, "--frames", "0-9")
        self.assertEqual(other.returncode, 1)
        self.assertIn("has counts of another film, of other frames or for other files", other.stderr)
        self.assertIn("remove it, so that the film is counted again, or name another file", other.stderr)
        self.assertEqual(counts.read_bytes(), written)
        counts.write_bytes(written[:-1] + b"x")
        self.assertIn("is damaged", self.mars(*words).stderr)
        folder = self.mars("plan", CUBES, "--platform", "fat-tree", "--counted", self.folder / "none" / "cubes.counts")
        self.assertEqual(folder.returncode, 1)

    def test_the_first_forecast_calibrates_or_says_why_not(self):
        home = dict(ENVIRONMENT, HOME=str(self.folder), XDG_DATA_HOME="")
        first = self.mars("plan", CUBES, "--json", env=home)
        self.assertEqual(first.returncode, 0, first.stderr)
        kept = (self.folder / ".local/share/mars/here.json").exists()
        self.assertEqual(json.loads(first.stdout)["platform"], "here" if kept else "reference")
        if kept:
            self.assertIn("interval", json.loads(first.stdout))
            self.assertIn("this machine is not calibrated: it is measured now", first.stderr)
            self.assertEqual(self.succeed("mars", "plan", CUBES, "--json", env=home), first.stdout)
        else:
            self.assertIn("not calibrated, and cannot be now: ", first.stderr)

    def test_without_a_place_for_a_calibration_costs_are_the_reference(self):
        for home in ["", "/proc"]:
            planned = self.mars("plan", CUBES, "--platform", "fat-tree:here",
                                env=dict(ENVIRONMENT, HOME=home, XDG_DATA_HOME=""))
            self.assertEqual(planned.returncode, 0, planned.stderr)
            self.assertRegex(planned.stdout, "^platform    fat-tree:reference\n")
            self.assertClear(planned.stderr, "costs are those of the reference machine (run mars calibrate")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_what_was_measured_on_a_busy_machine_is_doubted(self):
        platform = json.loads((SOURCES / "cluster/platforms/reference.json").read_text())
        platform["doubt"] = "repeats took 34 % longer than the shortest"
        file = self.write("busy.json", platform)
        planned = self.mars("plan", CUBES, "--platform", file)
        self.assertEqual(planned.returncode, 0, planned.stderr)
        self.assertClear(planned.stderr, "too busy: repeats took 34 % longer than the shortest (run mars calibrate when")
        rendered = self.mars("render", CUBES, "--sink", "none", "--backend", "simulated", "--platform", file, "--size",
                             "16x9", "--frames", "0")
        self.assertEqual(rendered.returncode, 0, rendered.stderr)
        self.assertIn("too busy: repeats took 34 %", rendered.stderr)

    def tried(self, **more):
        platform = json.loads((SOURCES / "cluster/platforms/reference.json").read_text())
        bounds = {"low": 0.9, "middle": 1.2, "high": 1.5}
        platform["spread"] = [{"nodes": nodes, "files": files, **bounds} for nodes in (1, 4) for files in (False, True)]
        return self.write("tried.json", {**platform, **more})

    def test_a_forecast_has_the_interval_of_its_platforms_trials(self):
        words = ["plan", CUBES, "--nodes", 2, "--platform"]
        plain = json.loads(self.succeed("mars", *words, "reference", "--json"))
        plan = json.loads(self.succeed("mars", *words, self.tried(), "--json"))
        self.assertNotIn("interval", plain)
        self.assertEqual(plan["interval"]["within"], 0.9)
        for value, ratio in [(plan["interval"]["low"], 0.9), (plan["seconds"], 1.2), (plan["interval"]["high"], 1.5)]:
            self.assertAlmostEqual(value / plain["seconds"], ratio)
        self.assertIn("interval", plan["by_nodes"][0])
        self.assertRegex(self.succeed("mars", *words, self.tried()), r"\nseconds +[\d.]+ \(90 %: [\d.]+ to [\d.]+\)\n")

    def test_a_noisy_calibration_says_that_its_interval_is_wide(self):
        doubt = "repeats took 34 % longer than the shortest"
        file = self.tried(doubt=doubt)
        self.assertIn(f"the calibration was noisy: {doubt}\n", self.succeed("mars", "plan", CUBES, "--platform", file))
        self.assertEqual(json.loads(self.succeed("mars", "plan", CUBES, "--platform", file, "--json"))["doubt"], doubt)

    def test_without_trials_it_is_not_known_how_far_off_a_forecast_is(self):
        self.assertRegex(self.succeed("mars", "plan", CUBES, "--platform", "fat-tree"),
                         r"seconds +[\d.]+ \(it is not known how far off: none was tried on platform fat-tree\)")
        beyond = self.succeed("mars", "plan", CUBES, "--nodes", 8, "--platform", self.tried())
        self.assertRegex(beyond, r"\(it is not known how far off: tried were forecasts for 1 to 4 nodes\)")

    def test_it_says_what_binds(self):
        words = ["plan", CUBES, "--nodes", 4, "--platform", "fat-tree"]
        self.assertNotIn("walls", self.succeed("mars", *words))
        text = self.succeed("mars", *words, "--explain")
        self.assertRegex(text, r"\n +4   [a-z ]+ [\d.e-]+ s; without it [\d.e-]+ s; then [a-z ]+, without both ")
        self.assertRegex(text, r"\nwalls of 4 nodes in \d group")
        plan = json.loads(self.succeed("mars", *words, "--explain", "--json"))
        for each in plan["by_nodes"]:
            explained = each["explained"]
            self.assertEqual(explained["seconds"], each["seconds"])
            first = explained["walls"][0]
            self.assertEqual(first["wall"], explained["binding"])
            self.assertLess(first["without"], explained["seconds"])
            self.assertLessEqual(explained["without_both"], first["without"])

    def test_it_names_the_costs_of_the_film_that_are_not_identified(self):
        words = ["plan", CUBES, "--nodes", 2, "--frames", "0-9", "--platform"]
        platform = json.loads((SOURCES / "cluster/platforms/reference.json").read_text())
        sure = self.write("sure.json", dict(platform, not_identified=[]))
        doubted = self.write("doubted.json", dict(platform, not_identified=["pixel", "caster", "encoded_exr_byte"]))
        printed = self.succeed("mars", *words, doubted, "--explain")
        self.assertIn("apart from others: pixel; the seconds are less sure", printed.splitlines()[1], "no caster: the film has none")
        plan = json.loads(self.succeed("mars", *words, doubted, "--json"))
        self.assertIn("apart from others: pixel; the seconds", plan["not_identified"])
        self.assertIn("apart from others: pixel, encoded_exr_byte;", self.succeed("mars", *words, doubted, "--format", "exr"))
        self.assertNotIn("apart from others", self.succeed("mars", *words, sure, "--explain"))
        self.assertNotIn("not_identified", self.succeed("mars", *words, sure, "--json"))

    def test_messages_may_take_far_longer_than_work(self):
        platform = json.loads((SOURCES / "cluster/platforms/ethernet.json").read_text())
        platform.pop("spread", None)
        platform["network"]["latency"] = 0.1
        slow = self.write("slow.json", platform)
        printed = self.succeed("mars", "plan", EXAMPLES / "visit.json", "--size", "160x120", "--frames", "0-9",
                               "--platform", slow, "--nodes", 6, "--cut", 2)
        self.assertIn("6 nodes in", printed)

    def test_without_storage_a_wall_of_storage_is_gone(self):
        platform = json.loads((SOURCES / "cluster/platforms/fat-tree.json").read_text())
        platform["work"] = json.loads((SOURCES / "cluster/platforms/reference.json").read_text())["work"]
        slow = self.write("slow.json", dict(platform, storage={"openings": 50}))
        del platform["storage"]
        fast = self.write("fast.json", platform)
        words = ["plan", CUBES, "--nodes", 4, "--write", "nodes", "--groups", 1, "--json", "--platform"]
        explained = json.loads(self.succeed("mars", *words, slow, "--explain"))["by_nodes"][-1]["explained"]
        self.assertEqual(explained["binding"], "storage")
        # One node contributes to keyframes, or all do: whichever is shorter there.
        self.assertAlmostEqual(explained["walls"][0]["without"], json.loads(self.succeed("mars", *words, fast))["seconds"],
                               delta=0.1 * explained["seconds"])

    def test_it_is_the_same_every_time(self):
        plans = {self.succeed("mars", "plan", CUBES, "--nodes", 6, "--platform", "ethernet", "--json")
                 for _ in range(2)}
        self.assertEqual(len(plans), 1)

    def test_what_another_version_measured_is_refused(self):
        platform = json.loads((SOURCES / "cluster/platforms/reference.json").read_text())
        without_shadows = {kind: cost for kind, cost in platform["work"].items() if kind != "shadow_point"}
        home = self.folder / "home"
        (home / ".local/share/mars").mkdir(parents=True)
        for work in (dict(platform["work"], sink_frame=0.1), without_shadows):
            self.write("here.json", dict(platform, work=work)).rename(home / ".local/share/mars/here.json")
            run = self.mars("render", CUBES, "--sink", "none", "--backend", "simulated", "--platform", "here",
                            env=dict(ENVIRONMENT, HOME=str(home), XDG_DATA_HOME=""))
            self.assertEqual(run.returncode, 1)
            self.assertClear(run.stderr, "another version of MARS measured this machine")
            self.assertClear(run.stderr, "run mars calibrate")

    def plan_of_light(self, light, *words, **options):
        film = dict(json.loads(CUBES.read_text()), lights=[dict(light, direction=[-0.4, -0.7, 0.8])])
        return self.mars("plan", self.write("film.json", film), "--json", *words, **options)

    def test_soft_shadows_take_longer(self):
        seconds = [json.loads(self.plan_of_light(light, "--platform", "fat-tree").stdout)["seconds"]
                   for light in ({}, {"shadow": True}, {"shadow": True, "size": 0.53})]
        self.assertEqual(seconds, sorted(seconds))
        self.assertGreater(seconds[2], 1.1 * seconds[1])

    def test_it_says_what_memory_shadows_take(self):
        plans = [self.plan_of_light({"shadow": casts}, "--platform", "fat-tree") for casts in (False, True)]
        without, shadows = (json.loads(plan.stdout) for plan in plans)
        self.assertEqual(without["shadow_memory"], 0)
        self.assertGreater(shadows["shadow_memory"], 100e6)
        more = shadows["machine_memory"] - without["machine_memory"]
        self.assertGreaterEqual(more, shadows["shadow_memory"])

    def test_shadows_for_which_there_is_no_memory_are_refused(self):
        platform = json.loads((SOURCES / "cluster/platforms/reference.json").read_text())
        platform["computers"]["memory"] = 4 << 20
        small = self.plan_of_light({"shadow": True}, "--platform", self.write("small.json", platform))
        self.assertEqual(small.returncode, 1)
        self.assertClear(small.stderr, "set MARS_MEMORY to ")

    def test_it_foresees_who_should_write_files(self):
        words = ["plan", "s3", "--frames", "0-11", "--size", "640x360", "--nodes", 4, "--groups", 1, "--platform",
                 "fat-tree", "--json"]
        words[1] = SOURCES / "examples/s3.json"
        for writer in ("host", "nodes"):
            plan = json.loads(self.succeed("mars", *words, "--write", writer))
            report = self.folder / f"{writer}.json"
            self.succeed("mars", "render", *words[1:-1], "--backend", "simulated", "--sink", "none", "--write", writer,
                         "--report", report)
            simulated = json.loads(report.read_text())
            self.assertAlmostEqual(plan["seconds"] / simulated["total_seconds"], 1, delta=0.15)
            self.assertEqual(plan["host_memory"], simulated["host_memory"]["most_bytes"])
            if writer == "nodes":
                self.assertEqual(plan["host_memory"], 4 * 640 * 360)

    def test_a_host_apart_takes_nothing_of_the_nodes_machine(self):
        platform = json.loads((SOURCES / "cluster/platforms/fat-tree.json").read_text())
        words = ["mars", "plan", CUBES, "--nodes", 1, "--platform"]
        apart, beside = (json.loads(self.succeed(*words, self.platform_with_costs(platform, host), "--json"))
                         for host in ({"apart": True}, {"apart": False}))
        self.assertAlmostEqual(beside["machine_memory"] - apart["machine_memory"], beside["host_memory"] + (8 << 20), delta=1)
        self.assertRegex(self.succeed(*words, "fat-tree"), r"\na machine +[\d.]+ MB with its nodes\b(?!.*host)")

    def platform_with_costs(self, platform, host):
        costs = json.loads((SOURCES / "cluster/platforms/reference.json").read_text())["work"]
        return self.write("platform.json", dict(platform, work=costs, host=dict(host, processors=32)))

    def test_it_takes_who_writes_sooner(self):
        words = ["plan", CUBES, "--nodes", 64, "--platform", "fat-tree"]
        plans = {write: json.loads(self.succeed("mars", *words, "--write", write, "--json"))
                 for write in ("auto", "host", "nodes")}
        self.assertEqual(plans["auto"]["seconds"], min(plans[write]["seconds"] for write in ("host", "nodes")))
        self.assertEqual(plans["auto"]["write"], min(("host", "nodes"), key=lambda write: plans[write]["seconds"]))
        self.assertRegex(self.succeed("mars", *words), r"\nfiles +written by (the host|nodes) \(by .*group.*seconds\)\n")
        self.assertNotIn("write", json.loads(self.succeed("mars", *words, "--sink", "none", "--json")))
        one = json.loads(self.succeed("mars", "plan", CUBES, "--nodes", 2, "--platform", "reference", "--json"))
        self.assertEqual(one["write"], "host", "of one machine")

    def test_it_foresees_what_the_simulation_then_takes(self):
        words = [CUBES, "--frames", "40-60", "--size", "160x90", "--nodes", 2, "--platform", "fat-tree", "--sink", "none"]
        plan = json.loads(self.succeed("mars", "plan", *words, "--json"))
        self.succeed("mars", "render", *words, "--backend", "simulated", "--report", self.folder / "report.json")
        report = json.loads((self.folder / "report.json").read_text())
        self.assertAlmostEqual(plan["seconds"] / report["total_seconds"], 1, delta=0.15)
        groups = {(node["first_line"], node["last_line"]) for node in report["frames"][0]["nodes"]}
        self.assertEqual(len(groups), 2 // plan["groups"], "nodes of a group share the first frame's lines")

    def test_many_nodes_take_little_more_time(self):
        """1 and 4 seconds of a processor. What else the machine does makes both longer."""
        few, many = (self.seconds_of_plan(nodes) for nodes in (2, 256))
        self.assertLess(many, 10 * few)

    def seconds_of_plan(self, nodes):
        before = processor_seconds()
        self.succeed("mars", "plan", EXAMPLES / "demo.json", "--nodes", nodes, "--platform", "dragonfly")
        return processor_seconds() - before

    def test_films_and_platforms_that_are_not_there(self):
        self.fail_clearly(2, "plan", says="FILM is required")
        self.fail_clearly(1, "plan", "no.json", "--platform", "fat-tree", says="no.json")
        self.fail_clearly(1, "plan", CUBES, "--platform", "cray", says="there is no platform 'cray'")

    def test_the_time_left_is_known_before_the_first_frame(self):
        printed = self.succeed("mars-simulated", CUBES, "--sink", "none", "--nodes", 2, "--platform", "fat-tree",
                               "--frames", "0-9", "--size", "64x36")
        first = next(event for event in map(json.loads, printed.splitlines()) if event["event"] == "progress")
        self.assertEqual(first["inbetweens"]["done"], 0)
        self.assertGreater(first["left"]["inbetweens"], 0)

    def test_a_rendering_has_the_contributors_of_its_forecast(self):
        """Each message to the host takes a second: fewer nodes than all draw the keyframe."""
        platform = json.loads((SOURCES / "cluster/platforms/ipsc2.json").read_text())
        platform["network"]["host_end"] = [[0, 0], [101, 1]]
        self.succeed("mars", "render", EXAMPLES / "s3.json", "--frames", "0-11", "--size", "160x90", "--nodes", 32, "--groups",
                     1, "--sink", "none", "--backend", "simulated", "--platform", self.write("slow.json", platform),
                     "--report", "report.json")
        frames = json.loads((self.folder / "report.json").read_text())["frames"]
        self.assertLess(len(frames[0]["nodes"]), 32)


if __name__ == "__main__":
    main()
