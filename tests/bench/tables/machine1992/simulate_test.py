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
import cases  # noqa: E402
import costs  # noqa: E402
import fit  # noqa: E402
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


if __name__ == "__main__":
    cases.main()
