"""The simulated tables of 1992: a fit finds the parameters that cells were made with, what is replayed is near what is
simulated, and simulated times are the same again.

Started as: simulate_test.py BUILD_FOLDER."""
import json
import os
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.dirname(HERE), os.path.join(HERE, "..", "..", "..")]
import alignments  # noqa: E402
import assumptions  # noqa: E402
import cases  # noqa: E402
import costs  # noqa: E402
import fit  # noqa: E402
import inbetweens  # noqa: E402
import product  # noqa: E402
import records  # noqa: E402
import replay  # noqa: E402
import scenes  # noqa: E402
import simulate  # noqa: E402

BUILD = sys.argv[1]
NODES = [2, 4, 8, 16]
TRUE = {"speed": 1.3, "host_byte": 0.7e-6, "host_message": 0.015, "depth": 4e-6, "scale": 0.25}


class Simulating(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        records.SCALES = [0.17, 0.25, 0.35]
        cls.simulator = simulate.Simulator(BUILD, folder.name, ["4.1-2600"])
        cls.measured = [(row, kind, nodes, 1.0) for row in (2600,) for kind in ("keyframe", "inbetween")
                        for nodes in NODES]
        cls.films = {2600: cls.simulator.record("4.1", 2600, cls.measured)}

    def cells(self, errors):
        """Made with TRUE, times 1 + each of the errors in turn."""
        cells = fit.Cells(self.measured, self.films, replay.Network())
        cells.ms = fit.Cells.times(cells, fit.costs_of(TRUE), TRUE["scale"])
        cells.ms *= [1 + errors[k % len(errors)] for k in range(len(cells.ms))]
        return cells

    def test_the_fit_finds_what_cells_were_made_with(self):
        found = fit.fit_costs(self.cells([0.0]))
        for name, value in TRUE.items():
            self.assertAlmostEqual(found[name] / value, 1, delta=0.01, msg=name)

    def test_the_uncertainty_covers_errors_of_cells(self):
        cells = self.cells([0.01, -0.015, 0.02, -0.005, -0.01])
        found = fit.fit_costs(cells)
        spread = fit.uncertainty(cells, found)
        for name, value in TRUE.items():
            self.assertLessEqual(abs(found[name] - value), 4 * spread[name], name)
        self.assertTrue(all(spread[name] > 0 for name in replay.Costs.NAMES), spread)

    def test_one_column_gives_the_scale(self):
        self.assertEqual(fit.fit_scale(self.cells([0.0]), fit.costs_of(TRUE)), TRUE["scale"])

    def test_what_is_replayed_is_near_what_is_simulated(self):
        simulated = self.simulator.times("4.1", self.measured, TRUE)
        self.assertEqual(simulated, self.simulator.times("4.1", self.measured, TRUE))
        for cell, there, here in zip(self.measured, simulated, self.cells([0.0]).ms):
            self.assertAlmostEqual(here / there, 1, delta=0.12, msg=cell)

    def inbetweens_by_nodes(self, job, rounds):
        """Milliseconds of one, replayed."""
        return {nodes: 1000 * replay.inbetween(job, nodes, fit.costs_of(TRUE), replay.Network(), rounds) for nodes in NODES}

    def test_what_the_host_takes_for_an_inbetween_does_not_shrink_with_the_nodes(self):
        job, known = self.films[2600][16][0.25], fit.costs_of(TRUE)
        takes = inbetweens.host_takes(job, known, replay.Network())
        share, serial = inbetweens.shares(self.inbetweens_by_nodes(job, 1))
        self.assertAlmostEqual(serial / sum(takes.values()), 1, delta=0.05)
        self.assertAlmostEqual(share / (1000 * float(job.inbetweens[0] @ known.work)), 1, delta=0.05)
        self.assertEqual(takes["message"], 1000 * TRUE["host_message"])
        self.assertTrue(all(ms > 0 for ms in takes.values()), takes)

    def test_more_inbetweens_hide_what_the_host_takes(self):
        job = self.films[2600][16][0.25]
        (_, one), (_, four) = (inbetweens.shares(self.inbetweens_by_nodes(job, rounds)) for rounds in (1, 4))
        self.assertAlmostEqual(four / one, 1 / 4, delta=0.05)

    def test_pixels_that_cost_nothing_leave_the_message_and_the_flags(self):
        job, known, network = self.films[2600][16][0.25], fit.costs_of(TRUE), replay.Network()
        takes = inbetweens.host_takes(assumptions.free_pixels(job), known, network)
        self.assertAlmostEqual(takes["pixels"], 0)
        self.assertEqual(takes["link"], 0)
        self.assertEqual(takes["flags"], inbetweens.host_takes(job, known, network)["flags"])

    def test_costs_have_the_order_of_the_counts(self):
        self.assertEqual(costs.clocks_of("copy"), 2 * costs.CLOCKS["move"] + costs.CLOCKS["step"])
        twice = costs.seconds(2, 0)
        for work, one, two in zip(costs.WORKS[:-1], costs.seconds(1, 0), twice):
            self.assertEqual((2 * one, one), (two, costs.clocks_of(work) / 16e6), work)

    def test_the_product_is_faster_on_the_same_machine(self):
        film = self.simulator.film("4.1", 2600)
        mars = product.Product(BUILD, self.simulator.folder, product.platform_of(TRUE))
        product.INBETWEENS_A_NODE = 4
        seconds = mars.seconds(film, 4, True)
        self.assertEqual(seconds, mars.seconds(film, 4, True))
        self.assertGreater(seconds["inbetween"], TRUE["host_message"])
        measured = [(2600, kind, 4, 1.0) for kind in ("keyframe", "inbetween")]
        for kind, then in zip(("keyframe", "inbetween"), self.simulator.times("4.1", measured, {**TRUE, "scale": 1.0})):
            self.assertLess(1000 * seconds[kind], then, kind)

    def test_the_platform_file_is_the_fitted_machine(self):
        parts = simulate.tables.load(os.path.join(HERE, "../../../../docs/1992/simulated.json"))
        with open(replay.IPSC2) as file:
            self.assertEqual(json.load(file), product.platform_of(parts[0]["parameters"]))

    def test_films_at_rest_have_the_first_pose(self):
        film = simulate.still(scenes.all_films(scenes.Cut(2, 32))["4.3-5200"])
        self.assertFalse(any("keys" in actor for actor in film["actors"]))
        self.assertIn("left-arm", film["actors"][1]["pose"])


class Inbetweens(unittest.TestCase):
    def test_times_are_a_share_and_what_all_wait_for(self):
        share, serial = inbetweens.shares({nodes: 800 / nodes + 30 for nodes in NODES})
        self.assertAlmostEqual(share, 800)
        self.assertAlmostEqual(serial, 30)

    def test_of_the_man_the_thesis_waits_for_no_pixels(self):
        """About 30 ms whatever moves, but for one row: what docs/1992 says."""
        cells = simulate.measured_cells()["4.2"]
        serial = [inbetweens.shares(inbetweens.by_nodes(cells, row))[1] for row in simulate.rows_of(cells) if row != 2600]
        self.assertGreater(min(serial), 29)
        self.assertLess(max(serial), 33)


class Alignments(unittest.TestCase):
    def test_spread_is_greatest_over_least_of_a_column(self):
        measured = [(row, "keyframe", nodes, 1.0) for row in (1, 2) for nodes in (2, 4)]
        self.assertEqual(alignments.spreads(measured, [200, 100, 300, 110]), {2: 0.5, 4: 110 / 100 - 1})

    def test_bodies_along_a_line_have_the_size_of_the_table_and_one_line(self):
        for number, axis in ((4, 2), (2, 0)):
            film = alignments.along_a_line(number, scenes.Cut(2, 32), alignments.stretched)
            self.assertEqual(scenes.polygon_count(film), scenes.ALIGNED_SIZE)
            bodies = film["actors"][1:]
            self.assertEqual(len(bodies), 6)
            self.assertLess(max(abs(body["place"][axis]) for body in bodies), 1e-9)
            self.assertEqual(len({round(body["place"][2 - axis], 6) for body in bodies}), 6)


if __name__ == "__main__":
    cases.main()
