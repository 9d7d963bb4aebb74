"""`mars bench scaling` and `compare` on a small film: runs, table, report; and planted slowdowns, which they find.

Started as: benchmark_test.py BUILD_FOLDER."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", ".."))
import cases  # noqa: E402
import scaling  # noqa: E402

if scaling.PLOTTED:
    import findings
    import results
    import verdicts

BUILD = os.path.abspath(sys.argv[1])
TEAPOT = os.path.join(HERE, "..", "..", "..", "examples", "teapot.json")
SMALL = ["--size", "160x90", "--backend", "threads"]
WHOLE = ["--", "--frames", "0-4", "--no-coherence"]  # every frame is a keyframe
NAMESPACES = {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"}  # of SVG: names, which nothing loads
needs_matplotlib = unittest.skipUnless(scaling.PLOTTED, "Matplotlib is not installed")


class Study(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory(prefix="mars-test-"))

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def bench(self, *words, code=0):
        done = subprocess.run([os.path.join(BUILD, "bin", "mars"), "bench", *words], capture_output=True, text=True,
                              cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def runs(self, folder):
        with open(self.path(folder, "runs.jsonl")) as file:
            header, *lines = map(json.loads, file)
        return header, lines


    def page(self, folder):
        with open(self.path(folder, "report.html")) as file:
            return file.read()


def program_of(run):
    return run["series"]["settings"].get("program")


class Command(Study):
    @needs_matplotlib
    def test_a_study_and_its_report(self):
        printed = self.bench("scaling", TEAPOT, *SMALL, "--nodes", "1,2", "--mapping", "cost,greedy", "--dice", "4",
                          "--repeats", "2", "-o", "study", *WHOLE)
        header, runs = self.runs("study")
        self.assertEqual((header["repeats"], header["seed"]), (2, 1))
        self.assertIn("--mapping cost,greedy", header["command"])
        self.assertEqual(len(runs), 3 * 2 * 2 * 2)
        self.assertEqual([run["repeat"] for run in runs], sorted(run["repeat"] for run in runs))
        for run in runs:
            self.check(run)
        for title in ("teapot, strong, mapping cost\n", "teapot, weak, mapping greedy\n"):
            self.assertIn(title, printed)
        self.check_page(self.page("study"))
        self.bench("scaling", "--read", "study/runs.jsonl", "-o", "again")
        self.assertEqual(self.page("again"), self.page("study"))
        pictures = [name for name in os.listdir(self.path("study")) if name.endswith(".svg")]
        self.assertEqual(len(pictures), 4)
        for picture in pictures:
            ElementTree.parse(self.path("study", picture))

    def check(self, run):
        self.assertEqual(len(run["per_node"]), run["nodes"])
        self.assertEqual(run["frames"], {"keyframe": 5, "inbetween": 0})
        self.assertEqual(run["size"], [226, 127] if run["series"]["kind"] == "weak" and run["nodes"] == 2 else [160, 90])
        self.assertEqual(sum(node["keyframe"]["work"]["patches"] for node in run["per_node"]), 5 * 32)
        computed = max(sum(node["keyframe"]["seconds"].values()) for node in run["per_node"])
        self.assertLessEqual(computed, run["seconds"])
        self.assertTrue(run["environment"]["cpu"] and run["environment"]["mars"]["version"])
        self.assertGreater(run["processor_seconds"], 0)
        self.assertGreaterEqual(min(run["involuntary_switches"], run["others_seconds"]), 0)

    def check_page(self, page):
        self.assertEqual(set(re.findall(r"\w+://[^\s\"'<>]*", page)), NAMESPACES)
        self.assertEqual(page.count("<svg"), 4)
        for part in ("What it shows", "teapot, strong scaling", "To repeat it", "Environment", "mars bench scaling"):
            self.assertIn(part, page)

    def test_a_film_for_each_number_of_nodes(self):
        shutil.copy(TEAPOT, self.path("one.json"))
        shutil.copy(TEAPOT, self.path("two.json"))
        self.bench("scaling", "2:two.json", "1:one.json", *SMALL, "--repeats", "1", "--warm-up", "0", *WHOLE)
        _, runs = self.runs("scaling")
        self.assertEqual({(run["film"], run["nodes"]) for run in runs}, {("one.json", 1), ("two.json", 2)})
        self.assertEqual({run["series"]["kind"] for run in runs}, {"weak"})

    @needs_matplotlib
    def test_two_programs_take_turns(self):
        mars = os.path.join(BUILD, "bin", "mars")
        printed = self.bench("scaling", TEAPOT, *SMALL, "--nodes", "1,2", "--against", mars, "--repeats", "2", "-o", "turns",
                             *WHOLE)
        _, runs = self.runs("turns")
        self.assertEqual(len(runs), 3 * 2 * 2)
        for first, second in zip(runs[::2], runs[1::2]):
            self.assertEqual({program_of(first), program_of(second)}, {"A", "B"})
            self.assertEqual((first["repeat"], first["nodes"]), (second["repeat"], second["nodes"]))
        for text in (printed, self.bench("compare", "turns", code=3)):
            self.assertIn("Film's time: cannot tell; 2 repeats are too few at level 0.001: take 13.", text)
            self.assertRegex(text, r"B.*: load average [\d.]+ to [\d.]+ on \d+ cores, other programs took \d+ %")
        self.assertIn("a study of two programs is compared alone", self.bench("compare", "turns", "turns", code=2))

    @needs_matplotlib
    def test_wrong_answers_are_counted(self):
        printed = self.bench("verdicts", "--equal", "1", "--planted", "1", "--repeats", "1", "--load", "1", code=1)
        self.assertRegex(printed, r"equal 1 of 1: film's time none, cannot tell; processors' seconds none, cannot tell; load")
        self.assertIn("0 of 1 pairs of equals were called different, 0 of 1 with a tenth more were", printed)
        printed = self.bench("verdicts", "--apart", "--equal", "1", "--planted", "0", "--repeats", "1")
        self.assertIn("0 of 1 pairs of equals were called different, 0 of 0 with a tenth more were", printed)

    def test_what_cannot_be_done(self):
        one = ["--nodes", "1", "--repeats", "1", "--warm-up", "0", "--study", "strong"]
        self.assertIn("no run succeeded", self.bench("scaling", "missing.json", *one, "-o", "failed", code=1))
        self.assertIn("missing.json", self.runs("failed")[1][0]["failure"])
        self.assertIn("has a study already", self.bench("scaling", TEAPOT, *one, "-o", "failed", code=1))
        self.assertIn("leave --nodes out", self.bench("scaling", "1:" + TEAPOT, *one, code=1))
        self.assertIn("960x540", self.bench("scaling", TEAPOT, *one, "--size", "large", code=1))
        self.assertIn("no file of a scaling study", self.bench("compare", TEAPOT, TEAPOT, code=2))
        self.assertIn("there is none at", self.bench("scaling", TEAPOT, *one, "--against", "missing", code=2))


@needs_matplotlib
class Planted(Study):
    """Slowdowns in copies of mars-threads that no option could make."""

    def planted(self, name):
        return verdicts.planted(BUILD, name, self.folder)

    def test_a_sleep_in_a_phase_is_found_and_named(self):
        for phase in ("dice", "exchange"):
            slow = os.path.join(self.planted(f"slow-{phase}"), "bin", "mars")
            self.bench("scaling", TEAPOT, *SMALL, "--nodes", "2", "--against", slow, "--repeats", "15", "-o", phase, *WHOLE)
            # Weaker than by default: the test shall find it on a busy machine too.
            printed = self.bench("compare", phase, "--level", "0.05")
            self.assertIn("Film's time: B is faster than A, by", printed)
            self.assertIn(f"Step: {phase}, faster by", printed)

    @unittest.skipUnless(len(os.sched_getaffinity(0)) > 1, "one processor, which nodes share")
    def test_a_slow_node_is_named_by_the_report(self):
        slow = os.path.join(self.planted("slow-node"), "bin", "mars")
        self.bench("scaling", TEAPOT, *SMALL, "--nodes", "2", "--against", slow, "--repeats", "8", "-o", "study", *WHOLE)
        header, runs = self.runs("study")
        printed = " ".join(findings.all_of(results.Results([(header, [run for run in runs if program_of(run) == "A"])])))
        self.assertRegex(printed, r"node 1 on \S+ is slow: it takes \d+\.\d\d times as long")
        self.assertNotIn("node 0 on", printed)


if __name__ == "__main__":
    cases.main()
