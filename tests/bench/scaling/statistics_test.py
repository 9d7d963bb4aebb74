"""The figures of scaling studies on data with known answers: laws, spreads, tests for noise, slow machines, changes."""
import contextlib
import io
import json
import math
import os
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

import numpy

sys.path.append(os.path.join(os.path.dirname(__file__), "..", ".."))
import cases  # noqa: E402

import answers  # noqa: E402
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
import usage  # noqa: E402

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


    def test_programs_take_turns_and_each_is_as_often_first(self):
        configuration, = study.strong(["a.json"], [2], {})
        turns = list(study.in_pairs(study.turns([configuration], 0, 20, seed=3), seed=3))
        first, second = ([each.setting("program") for each, _ in turns[k::2]] for k in (0, 1))
        self.assertEqual((first.count("A"), second.count("A")), (10, 10))
        self.assertEqual([set(pair) for pair in zip(first, second)], [{"A", "B"}] * 20)
        self.assertGreater(sum(one != other for one, other in zip(first, first[1:])), 3)
        self.assertLess(sum(one != other for one, other in zip(first, first[1:])), 19)


BURN = "import time\nwhile time.process_time() < {}: pass\n"


class Usage(unittest.TestCase):
    def test_processors_of_all_processes_are_counted(self):
        child = f"import subprocess, sys\nsubprocess.run([sys.executable, '-c', {BURN.format(0.2)!r}])\n"
        used = usage.run([sys.executable, "-c", child + BURN.format(0.1)])
        self.assertEqual(used.failure, "")
        self.assertTrue(0.3 <= used.processor_seconds < 0.6, used)
        self.assertGreaterEqual(used.wall_seconds, 0.25)

    def test_what_others_take_is_counted(self):
        with subprocess.Popen([sys.executable, "-c", BURN.format(9)]) as other:
            time.sleep(0.1)
            used = usage.run(["sleep", "0.4"])
            other.kill()
        self.assertGreater(used.others_seconds, 0.05)
        self.assertLess(used.processor_seconds, 0.1)

    def test_a_failure_is_kept(self):
        self.assertEqual(usage.run(["sh", "-c", "echo no film >&2; exit 3"]).failure, "no film")
        self.assertEqual(usage.run(["sh", "-c", "kill -9 $$"]).failure, "ended with -9")


class Noise(unittest.TestCase):
    def one(self, found):
        bounds, = found
        return bounds.low, bounds.middle, bounds.high

    def test_pairs_of_which_all_differ_alike(self):
        """By chance 2 of 32: at a level from there on, no candidate but the extreme ones lies outside."""
        differences = [[0.1], [0.3], [0.2], [0.5], [0.4]]
        self.assertEqual(self.one(noise.paired(differences, 2 / 32)), (0.1, 0.3, 0.5))
        self.assertEqual(self.one(noise.paired(differences, 1.9 / 32)), (-math.inf, 0.3, math.inf))

    def test_sides_of_which_all_differ_alike(self):
        """By chance 2 of 20."""
        sides = [[1], [1], [1]], [[2], [2], [3]]
        self.assertEqual(self.one(noise.apart(*sides, 0.1)), (-1, 1, 4))  # 1 to 2 lie between the sides, and B drifts by 1
        self.assertEqual(self.one(noise.apart(*sides, 0.09)), (-math.inf, 1, math.inf))

    def test_bounds_hold_for_all_columns_together(self):
        chance = numpy.random.default_rng(1)
        missed = sum(any(each.low > 0 or each.high < 0 for each in noise.paired(chance.normal(size=(8, 10)), 0.1))
                     for _ in range(200))
        self.assertLessEqual(missed, 35)  # 20 are expected, more than 35 in 1 of 1000 such tests

    def test_all_resamplings_are_tried_where_they_are_few(self):
        self.assertEqual(len({tuple(row) for row in noise.choices(3, 6)}), 20)
        self.assertEqual(len({tuple(row) for row in noise.exchanges(5)}), 32)

    def test_what_is_equal_has_no_width(self):
        self.assertEqual(self.one(noise.paired(numpy.zeros((10, 1)), 0.05)), (0, 0, 0))

    def test_ties_share_their_rank(self):
        self.assertEqual(list(noise.ranks([30, 10, 30, 20])), [3.5, 1, 3.5, 2])


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


SLOW_DICE = {"times_of_b": lambda host, phase: 4 / 3 if phase == "dice" else 1}  # a tenth more in all
CALM = {"outliers": 0.02}


def against(seed, **how):
    return changes.of_programs(results.Results([measured.against(seed, **how)]))


def called_different(comparison):
    return [change.name for change in (*comparison.times, *comparison.steps, *comparison.machines) if change.holds]


class Against(unittest.TestCase):
    """Two programs that take turns."""

    def test_equals_are_not_called_different_whatever_else_the_machine_does(self):
        for moments in (measured.quiet, measured.heavy_tailed, measured.drifting, measured.busy):
            found = [called_different(against(seed, moments=moments)) for seed in range(30)]
            self.assertEqual(found, [[]] * 30, moments.__name__)

    def test_the_second_run_of_a_pair_may_be_faster(self):
        self.assertEqual([called_different(against(seed, second=0.8, **CALM)) for seed in range(20)], [[]] * 20)

    def test_a_tenth_more_is_found_and_its_step_named(self):
        for seed in range(10):
            slower = against(seed, **SLOW_DICE, **CALM)
            self.assertEqual(answers.answer(slower.times[0]), "slower")
            self.assertTrue(slower.times[0].bounds.low < 0.1 < slower.times[0].bounds.high)
            self.assertEqual(slower.cause().name, "dice")

    def test_a_tenth_more_is_found_on_a_busy_machine_by_processors_seconds(self):
        for moments in (measured.heavy_tailed, measured.drifting, measured.busy):
            found = [against(seed, moments=moments, **SLOW_DICE, **CALM).times[1].slower for seed in range(10)]
            self.assertGreaterEqual(sum(found), 9, moments.__name__)

    def test_steps_that_are_alike_are_not_named(self):
        for seed in range(10):
            changed = against(seed, moments=measured.busy, **SLOW_DICE, **CALM)
            self.assertLessEqual({step.name for step in changed.steps if step.holds}, {"dice"})

    def test_on_several_nodes_each_configuration_is_compared(self):
        slower = against(1, nodes=(1, 2), repeats=30, **SLOW_DICE, **CALM)
        self.assertEqual([change.name for change in slower.times],
                         ["film's time", "processors' seconds", "made, strong, nodes 1", "made, strong, nodes 2"])
        self.assertTrue(all(change.slower for change in slower.times))

    def test_a_quiet_machine_says_that_equals_are_the_same(self):
        same = against(1, repeats=30, **CALM)
        self.assertLess(same.times[0].within, 0.05)
        self.assertIn("A and B are the same within", " ".join(answers.sentences(same)))

    def test_a_busy_machine_cannot_tell(self):
        printed = " ".join(answers.sentences(against(1, moments=measured.busy, load=9.5, others=0.8)))
        self.assertIn("Film's time: cannot tell; the machine was busy", printed)
        self.assertIn("load average 9.50 to 9.50", printed)
        self.assertIn("other programs took 80 % of the processors", printed)

    def test_few_repeats_cannot_tell(self):
        few = against(1, repeats=6, **SLOW_DICE)
        self.assertEqual((called_different(few), few.enough), ([], 12))
        self.assertIn("6 repeats are too few at level 0.001: take 12", " ".join(answers.sentences(few)))

    def test_a_run_that_failed_leaves_its_block_out(self):
        header, every = measured.against(1, repeats=13)
        every[4] = {**every[4], "failure": "killed"}
        found = changes.of_programs(results.Results([(header, every)]))
        self.assertEqual([len(blocks) for blocks in found.blocks], [12, 12])

    def test_two_files_of_a_study_have_twice_the_blocks(self):
        found = changes.of_programs(results.Results([measured.against(seed, repeats=6) for seed in (1, 2)]))
        self.assertEqual([len(blocks) for blocks in found.blocks], [12, 12])


def apart(before, after, level=changes.LEVEL):
    return changes.of_studies(results.Results([before]), results.Results([after]), level)


class Apart(unittest.TestCase):
    """Two studies made one after the other."""

    def test_equals_are_not_called_different(self):
        for moments in (measured.quiet, measured.heavy_tailed):
            studies = [[measured.study(seed + k, nodes=(1, 2), repeats=10, moments=moments) for k in (0, 50)]
                       for seed in range(30)]
            self.assertEqual([called_different(apart(*both)) for both in studies], [[]] * 30, moments.__name__)

    def test_a_drift_within_a_study_may_go_on_between_two(self):
        found = 0
        for seed in range(50):
            header, every = measured.study(seed, nodes=(1,), repeats=30, moments=measured.drifting)
            renumbered = [{**run, "repeat": k % 15 + 1} for k, run in enumerate(every)]
            found += bool(called_different(apart((header, renumbered[:10]), (header, renumbered[15:25]))))
        self.assertLessEqual(found, 6)

    def test_a_fifth_more_is_found_and_its_step_named(self):
        plain, slow = (measured.study(seed, repeats=10, times=lambda host, phase, by=by: by if phase == "dice" else 1, **CALM)
                       for seed, by in ((1, 1), (2, 5 / 3)))
        slower, faster = apart(plain, slow), apart(slow, plain)
        self.assertTrue(slower.times[0].slower)
        self.assertEqual(slower.cause().name, "dice")
        self.assertEqual((answers.answer(faster.times[0]), faster.cause().name), ("faster", "dice"))

    def test_an_older_mars_has_no_phase_of_shadows(self):
        """Measured studies have none, either."""
        header, runs = measured.study(2, repeats=10, times=lambda host, phase: 5 / 3 if phase == "dice" else 1, **CALM)
        for seconds in (node[kind]["seconds"] for run in runs for node in run["per_node"] for kind in ("keyframe", "inbetween")):
            seconds.update(dice=0.6 * seconds["dice"], shadow=0.4 * seconds["dice"])
        self.assertEqual(apart(measured.study(1, repeats=10, **CALM), (header, runs)).cause().name, "shadow")

    def test_a_step_that_waits_is_named_where_none_computes_longer(self):
        waits = measured.study(2, repeats=10, times=lambda host, phase: 6 if phase == "exchange" else 1)
        self.assertEqual(apart(measured.study(1, repeats=10), waits).cause().name, "exchange")

    def test_a_busy_machine_cannot_tell(self):
        slow = measured.study(2, repeats=20, times=lambda host, phase: 3, load=47, others=0.9)
        comparison = apart(measured.study(1, repeats=20), slow)
        self.assertEqual(called_different(comparison), [])
        said = " ".join(answers.sentences(comparison))
        self.assertIn("cannot tell; the machine was busy", said)
        self.assertIn("B (busy): load average 47.00 to 47.00 on 16 cores, other programs took 90 % of the processors", said)

    def test_nodes_that_wait_for_processors_make_a_machine_busy(self):
        """Where limits of a container hold them, which no load shows."""
        slow = measured.study(2, repeats=20, moments=lambda chance, count: numpy.full(count, 3.0))
        self.assertTrue(apart(measured.study(1, repeats=20), slow).busy)

    def exit_code(self, *studies):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            paths = [os.path.join(folder, f"{k}.jsonl") for k in range(len(studies))]
            for path, (_, lines) in zip(paths, studies):
                with open(path, "w") as file:
                    file.write("\n".join(map(json.dumps, [{"format": runs.FORMAT}, *lines])))
            with unittest.mock.patch.object(sys, "argv", ["compare", *paths]):
                return compare.main()

    def test_exit_codes(self):
        plain, slow = (measured.study(seed, repeats=20, times=lambda host, phase, by=by: by, **CALM)
                       for seed, by in ((1, 1), (2, 1.4)))
        self.assertEqual(self.exit_code(plain, slow), 1)
        self.assertEqual(self.exit_code(slow, plain), 0)
        self.assertEqual(self.exit_code(plain, plain), 0)
        self.assertEqual(self.exit_code(measured.study(1), measured.study(2)), 3)
        self.assertEqual(self.exit_code(measured.against(1, **SLOW_DICE, **CALM)), 1)
        self.assertEqual(self.exit_code(measured.against(1, repeats=5)), 3)

    def test_what_cannot_be_compared(self):
        for studies in ([measured.study(1)], [measured.study(1), measured.against(1)],
                        [measured.study(1, nodes=(1,)), measured.study(1, nodes=(2,))]):
            with self.assertRaises(study.Trouble):
                self.exit_code(*studies)

    def test_a_machine_that_became_slow_is_named(self):
        plain, slow = (measured.study(seed, repeats=10, **FOUR_HOSTS,
                                      times=lambda host, phase, by=by: by if host == "n3" else 1)
                       for seed, by in ((1, 1), (2, 1.5)))
        self.assertEqual([change.name for change in apart(plain, slow).machines if change.holds], ["n3"])


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
        findings_of = lambda repeats: " ".join(findings.all_of(results.Results([measured.study(1, repeats=repeats, **FOUR_HOSTS)])))
        self.assertIn("No machine of n1, n2, n3, n4 is slower", findings_of(5))
        self.assertIn("Too few runs on all of n1, n2, n3, n4", findings_of(2))

    def test_waiting_for_a_slow_machine_is_not_slow(self):
        self.assertEqual(self.slow(1, times=lambda host, phase: 9 if phase == "sum" and host != "n1" else 1), [])

    def test_one_machine_has_none_to_compare_with(self):
        self.assertEqual(self.slow(1, host_of=lambda node: "n1"), [])


if __name__ == "__main__":
    cases.main()
