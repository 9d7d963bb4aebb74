"""The figures of scaling studies on data with known answers: laws, spreads, tests for noise, slow machines, changes."""
import contextlib
import io
import json
import os
import sys
import tempfile
import unittest
import unittest.mock

import numpy

sys.path.append(os.path.join(os.path.dirname(__file__), "..", ".."))
import cases  # noqa: E402

import changes  # noqa: E402
import compare  # noqa: E402
import findings  # noqa: E402
import fits  # noqa: E402
import machines  # noqa: E402
import measured  # noqa: E402
import noise  # noqa: E402
import results  # noqa: E402
import runs  # noqa: E402
import study  # noqa: E402

FOUR_HOSTS = dict(host_of=lambda node: f"n{node % 4 + 1}")


class Laws(unittest.TestCase):
    TIMES = [(nodes, 8 * (0.1 + 0.9 / nodes)) for nodes in (1, 2, 4, 8, 16)]  # a tenth is serial

    def test_amdahls_law_is_found_again(self):
        fraction, one = fits.amdahl(self.TIMES)
        self.assertAlmostEqual(fraction, 0.1)
        self.assertAlmostEqual(one, 8)

    def test_karp_and_flatt_find_the_same_fraction_everywhere(self):
        speed_ups = fits.speed_up(dict(self.TIMES), [nodes for nodes, _ in self.TIMES])
        self.assertIsNone(fits.karp_flatt(1, 1))
        for nodes, _ in self.TIMES[1:]:
            self.assertAlmostEqual(fits.karp_flatt(speed_ups[nodes], nodes), 0.1)

    def test_gustafson(self):
        self.assertAlmostEqual(fits.gustafson(8 - 7 * 0.25, 8), 0.25)

    def test_a_study_without_a_single_node_begins_at_its_fewest(self):
        self.assertEqual(fits.speed_up({4: 10.0, 8: 5.0}, [4, 8]), {4: 4.0, 8: 8.0})

    def test_the_spread_of_runs(self):
        self.assertEqual(fits.spread([5, 1, 4, 2, 3]), fits.Spread(1, 2, 3, 4, 5))

    def test_bounds_hold_the_median(self):
        low, high = fits.bootstrapped(lambda groups: numpy.median(groups[0]), [numpy.arange(100.0)])
        self.assertTrue(35 < low < 49.5 < high < 65, (low, high))

    def test_a_study_finds_its_serial_part(self):
        line, = results.Results([measured.study(1, serial=0.2)]).lines
        fraction, (low, high), _ = line.amdahl
        self.assertAlmostEqual(fraction, 0.2, delta=0.03)
        self.assertTrue(low <= fraction <= high)

    def test_laws_are_not_fitted_to_nodes_that_share_processors(self):
        found = results.Results([measured.study(1, nodes=(8, 16, 32))])
        self.assertEqual([point.nodes for point in found.lines[0].fitted], [8, 16])
        self.assertIn("runs of 32 nodes share them", " ".join(findings.all_of(found)))


class Order(unittest.TestCase):
    def test_all_run_once_before_any_runs_again(self):
        turns = list(study.turns("abcdefgh", 1, 3, seed=7))
        rounds = [turns[k:k + 8] for k in range(0, 32, 8)]
        self.assertEqual([{repeat for _, repeat in each} for each in rounds], [{0}, {1}, {2}, {3}])
        self.assertTrue(all(sorted(name for name, _ in each) == list("abcdefgh") for each in rounds))
        self.assertEqual(len({tuple(name for name, _ in each) for each in rounds}), 4)
        self.assertEqual(turns, list(study.turns("abcdefgh", 1, 3, seed=7)))

    def test_pictures_grow_with_the_nodes(self):
        grown = list(study.weak(["a.json"], [1, 2, 4], {"mapping": ["cost", "greedy"]}, lambda film: (320, 180)))
        self.assertEqual([(each.nodes, each.size) for each in grown[:3]], [(1, (320, 180)), (2, (453, 255)), (4, (640, 360))])
        self.assertEqual([each.setting("mapping") for each in grown], ["cost"] * 3 + ["greedy"] * 3)


class Noise(unittest.TestCase):
    def test_known_probabilities(self):
        self.assertAlmostEqual(noise.differ([([1, 2, 3], [4, 5, 6])]), 2 / 20)
        self.assertAlmostEqual(noise.differ([([1, 2, 3, 4, 5], [6, 7, 8, 9, 10])]), noise.least_possible(5, 5))
        self.assertEqual(noise.differ([([1, 1], [1, 1])]), 1)

    def test_ties_share_their_rank(self):
        self.assertEqual(list(noise.ranks([30, 10, 30, 20])), [3.5, 1, 3.5, 2])

    def test_holm(self):
        for corrected, right in zip(noise.holm([0.01, 0.04, 0.03]), [0.03, 0.06, 0.06]):
            self.assertAlmostEqual(corrected, right)

    def test_strata_add_up(self):
        one = ([1, 2, 3], [4, 5, 6])
        self.assertLess(noise.differ([one] * 4), 0.001)


def compared(before, after):
    return changes.Comparison(results.Results([before]), results.Results([after]))


class Files(unittest.TestCase):
    def read(self, *lines, end="\n"):
        with tempfile.NamedTemporaryFile("w", suffix=".jsonl") as file:
            file.write("\n".join([json.dumps({"format": runs.FORMAT}), *lines]) + end)
            file.flush()
            return runs.read(file.name)

    def test_a_study_that_was_killed_is_read(self):
        first, second, *_ = map(json.dumps, measured.study(1)[1])
        self.assertEqual(len(self.read(first, second)[1]), 2)
        self.assertEqual(len(self.read(first, second[:-9], end="")[1]), 1)

    def test_a_broken_line_is_named(self):
        run = measured.study(1)[1][0]
        without = {key: run[key] for key in run if key != "per_node"}
        for broken in ("{", "[1]", json.dumps(without), json.dumps({**run, "seconds": 0})):
            with self.assertRaisesRegex(study.Trouble, ":3 is no"):
                self.read(json.dumps(run), broken)


class Changes(unittest.TestCase):
    def test_a_tenth_more_is_found_and_its_phase_named(self):
        slower = compared(measured.study(1), measured.study(2, times=lambda host, phase: 4 / 3 if phase == "dice" else 1))
        self.assertTrue(slower.times[0].holds(0.05))
        self.assertAlmostEqual(slower.times[0].ratio, 1.1, delta=0.05)
        self.assertEqual(slower.cause().name, "dice")
        faster = compared(measured.study(1, times=lambda host, phase: 4 / 3 if phase == "dice" else 1), measured.study(2))
        self.assertEqual((faster.cause().name, faster.times[0].slower), ("dice", False))

    def test_a_phase_that_waits_is_named_where_none_computes_longer(self):
        slower = compared(measured.study(1), measured.study(2, times=lambda host, phase: 5 if phase == "exchange" else 1))
        self.assertEqual(slower.cause().name, "exchange")

    def test_noise_is_not_reported(self):
        """At most the level of it, 5 % of the comparisons of equals: of 100 more than 11 are as likely as 1 in 200."""
        cries = 0
        for seed in range(100):
            same = compared(measured.study(2 * seed + 100), measured.study(2 * seed + 101))
            cries += any(change.holds(0.05) for change in same.times)
        self.assertLessEqual(cries, 11)

    def exit_code(self, *studies):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            paths = [os.path.join(folder, f"{k}.jsonl") for k in range(len(studies))]
            for path, (_, lines) in zip(paths, studies):
                with open(path, "w") as file:
                    file.write("\n".join(map(json.dumps, [{"format": runs.FORMAT}, *lines])))
            with unittest.mock.patch.object(sys, "argv", ["compare", *paths]):
                return compare.main()

    def test_exit_codes(self):
        slow = measured.study(2, times=lambda host, phase: 1.2)
        self.assertEqual(self.exit_code(measured.study(1), slow), 1)
        self.assertEqual(self.exit_code(slow, measured.study(1)), 0)
        self.assertEqual(self.exit_code(slow, slow), 0)

    def test_a_machine_that_became_slow_is_named(self):
        after = measured.study(2, **FOUR_HOSTS, times=lambda host, phase: 1.5 if host == "n3" else 1)
        slower = compared(measured.study(1, **FOUR_HOSTS), after)
        self.assertEqual([change.name for change in slower.machines if change.holds(0.05)], ["n3"])

    def test_too_few_repeats_are_told(self):
        few = compared(measured.study(1, repeats=3), measured.study(2, repeats=3))
        self.assertEqual({change.wanted for change in few.times[1:]}, {5})


class Machines(unittest.TestCase):
    def slow(self, seed, repeats=5, **how):
        return machines.slow_ones(measured.study(seed, repeats=repeats, **{**FOUR_HOSTS, **how})[1])

    def test_a_slow_machine_is_named_with_its_steps(self):
        slow, = self.slow(1, times=lambda host, phase: 1.6 if host == "n2" else 1)
        self.assertEqual((slow.name, set(slow.steps)), ("n2", {"dice", "fill", "scanline"}))
        self.assertAlmostEqual(slow.times, 1.6, delta=0.15)

    def test_a_machine_may_be_slow_in_one_step(self):
        slow, = self.slow(1, times=lambda host, phase: 2 if (host, phase) == ("n4", "scanline") else 1)
        self.assertEqual((slow.name, set(slow.steps)), ("n4", {"scanline"}))

    def test_two_slow_machines(self):
        slow = self.slow(1, times=lambda host, phase: {"n1": 3, "n2": 2}.get(host, 1))
        self.assertEqual([each.name for each in slow], ["n1", "n2"])

    def test_equal_machines_are_not_named(self):
        self.assertEqual([self.slow(seed) for seed in range(20)], [[]] * 20)

    def test_the_report_says_whether_runs_sufficed(self):
        told = lambda repeats: " ".join(findings.all_of(results.Results([measured.study(1, repeats=repeats, **FOUR_HOSTS)])))
        self.assertIn("No machine of n1, n2, n3, n4 is slower", told(5))
        self.assertIn("Too few runs on all of n1, n2, n3, n4", told(2))

    def test_waiting_for_a_slow_machine_is_not_slow(self):
        self.assertEqual(self.slow(1, times=lambda host, phase: 9 if phase == "sum" and host != "n1" else 1), [])

    def test_one_machine_has_none_to_compare_with(self):
        self.assertEqual(self.slow(1, host_of=lambda node: "n1"), [])


if __name__ == "__main__":
    cases.main()
