"""`mars bench peers` on small pictures: all that were built compete and draw alike, and the JSON holds what is told.

Started as: peers_test.py BUILD_FOLDER. Exit code 77 (skipped) where no peer was built."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

BUILD = sys.argv[1]
PEERS = os.path.join(BUILD, "bench", "peers")
SKIPPED = 77


def bench(*words):
    return subprocess.run([os.path.join(BUILD, "bin", "mars"), "bench", "peers", *words], capture_output=True, text=True)


class Benchmark(unittest.TestCase):
    def test_all_compete_and_draw_alike(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "measured.json")
            run = bench("--scenes", "s1,s3", "--size", "384x216", "--dice", "4", "--rounds", "2", "--columns", "1",
                        "--adaptive", "-o", file)
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(file) as text:
                measured = json.load(text)
        self.assertEqual([result["course"] for result in measured["results"]], ["s1", "s3", "s3's inbetweens"])
        for result in measured["results"]:
            self.check_rows(result)

    def check_rows(self, result):
        rows = {row["name"]: row for row in result["competitors"]}
        self.assertIn("ours, threads", rows)
        self.assertIn(result["best_peer"], rows)
        fastest = min(row["best"] for name, row in rows.items() if not name.startswith("ours"))
        for name, row in rows.items():
            self.assertEqual(len(row["milliseconds"]), 2)
            self.assertEqual(row["best"], min(row["milliseconds"]))
            if "adaptive" not in name:
                self.assertLess(row["rms"], 2, f"{name}, {result['course']}")
            if name.startswith("ours"):
                self.assertAlmostEqual(row["ratio"], row["best"] / fastest)

    def test_pictures_that_differ_are_told(self):
        # Seen from both sides, the teapot shows its inside; the peers cull it.
        run = bench("--scenes", "s1", "--size", "384x216", "--dice", "4", "--rounds", "1", "--columns", "1",
                    "--both-sides")
        self.assertEqual(run.returncode, 1)
        self.assertIn("differs from", run.stderr)

    def test_what_a_competitor_says_at_its_end_is_told(self):
        run = bench("--scenes", "s1", "--dice", "300", "--rounds", "1", "--columns", "1")
        self.assertEqual(run.returncode, 1)
        self.assertIn("300", run.stderr)


if __name__ == "__main__":
    if not any(os.path.exists(os.path.join(PEERS, name)) for name in ("peer-embree", "peer-llvmpipe")):
        print("no peer was built: ./bootstrap bench installs their packages")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
