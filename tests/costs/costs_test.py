"""What building and testing cost: records of processes, and the table made of them."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import costs  # noqa: E402
from cases import main  # noqa: E402


class Record(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.log = pathlib.Path(folder.name) / "log"

    def record(self, name, script):
        return subprocess.run([HERE / "record", self.log, "test", name, "bash", "-c", script], capture_output=True,
                              text=True)

    def test_what_a_command_prints_and_how_it_ends_stay_its_own(self):
        done = self.record("some_test", "echo out; echo err >&2; exit 3")
        self.assertEqual((done.stdout, done.stderr, done.returncode), ("out\n", "err\n", 3))
        [(kind, name, _, _, code)] = costs.read_records(self.log)
        self.assertEqual((kind, name, code), ("test", "some_test", 3))

    def test_processes_of_a_command_count(self):
        self.record("idle", "sleep 0.3")
        self.record("busy", "(for ((i = 0; i < 300000; ++i)); do :; done)")
        (_, _, idle_passed, idle, _), (_, _, _, busy, _) = costs.read_records(self.log)
        self.assertGreaterEqual(idle_passed, 0.3)
        self.assertGreater(busy, idle)


def some_costs(factor):
    made = {"stages": {}, "targets": {}, "tests": {}}
    costs.add_records(made, "picture", [("compile", "mars_keys", 3, 2 * factor, 0), ("link", "mars_keys", 1, 0.5, 0),
                                        ("compile", "mars_cli", 1, factor, 0)], 4, {})
    costs.add_records(made, "quick", [("test", "keys_test", 2, factor, 0)], 2, {"keys_test": "unit"})
    return made


class Table(unittest.TestCase):
    def test_targets_add_up_and_stages_hold_their_own(self):
        made = some_costs(2)
        self.assertEqual(made["targets"]["mars_keys"], {"stage": "picture", "processors": 4.5})
        self.assertEqual(made["stages"]["picture"], {"passed": 4, "processors": 6.5})
        self.assertEqual(made["tests"]["keys_test"], {"tier": "unit", "passed": 2, "processors": 2, "code": 0})

    def test_two_runs_stand_beside_each_other(self):
        rows = costs.report([some_costs(2), some_costs(1)]).splitlines()
        self.assertIn("| `mars_keys` | 4.5 | 2.5 |", rows)
        self.assertIn("| unit | 2.0 | 2.0 | 1.0 | 2.0 |", rows)
        self.assertIn("| building what renders the first picture | 6.5 | 4.0 | 3.5 | 4.0 |", rows)

    def test_one_run_stands_alone(self):
        self.assertIn("| `keys_test` | 2.0 | 2.0 |", costs.report([some_costs(2)]))

    def test_a_test_that_left_no_record_counts_as_failed(self):
        made = some_costs(2)
        costs.add_tests_without_record(made, {"keys_test": "unit", "slow_test": "unit"})
        self.assertEqual([made["tests"][name]["code"] for name in ["keys_test", "slow_test"]], [0, costs.NO_RECORD])

    def test_files_that_hold_no_costs_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "costs.json"
            for text in ["", "[]", "{}", '{"stages": {}']:
                file.write_text(text)
                with self.assertRaisesRegex(SystemExit, f"{file} is not a whole costs.json"):
                    costs.read_costs(file)
            with self.assertRaisesRegex(SystemExit, "cannot be read: Is a directory"):
                costs.read_costs(folder)

    def test_costs_to_compare_with_are_read_before_their_folder_is_cleared(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "costs.json").write_text("torn")
            words = [sys.executable, HERE / "costs.py", folder, "--against", f"{folder}/costs.json"]
            done = subprocess.run(words, capture_output=True, text=True)
            self.assertIn("is not a whole costs.json", done.stderr)
            self.assertTrue((pathlib.Path(folder) / "costs.json").exists())

    def test_the_tiers_are_those_of_the_build(self):
        text = (HERE.parent / "CMakeLists.txt").read_text()
        quick = re.search(r"set\(MARS_QUICK_TIERS (.*?) CACHE", text).group(1).split()
        self.assertEqual(quick, costs.QUICK)
        described = re.findall(r"^#   (\w+) {2,}\S", text, re.M)
        self.assertEqual(described, costs.QUICK + costs.LATER)
        bootstrap = (HERE.parents[1] / "bootstrap").read_text()
        self.assertIn(f"--label-regex '{costs.label_of(quick)}'", bootstrap)
        self.assertIn(f"--label-regex '{costs.label_of(costs.LATER)}'", bootstrap)


if __name__ == "__main__":
    main()
