"""`mars bench tables`: films have 1992's numbers of polygons, the data are the thesis's, tables show what sources say,
and a quick run measures everything.

Started as: tables_test.py BUILD_FOLDER."""
import collections
import html.parser
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import unittest

sys.path.append(os.path.join(os.path.dirname(__file__), "..", ".."))
import baselines  # noqa: E402
import cases  # noqa: E402
import cells  # noqa: E402
import figures  # noqa: E402
import limbs  # noqa: E402
import page  # noqa: E402
import scenes  # noqa: E402
import studies  # noqa: E402
import tables  # noqa: E402

BUILD = sys.argv[1]
RESULTS = os.path.join(os.path.dirname(__file__), "../../../docs/1992")
MARS = os.path.join(BUILD, "bin", "mars")


def directed_edges(faces):
    return collections.Counter((face[k], face[(k + 1) % 3]) for face in faces for k in range(3))


class Limbs(unittest.TestCase):
    def test_meshes_are_closed_and_have_exactly_the_triangles(self):
        for triangles in [8, 10, 214, 216, 646, 648, 650, 1300]:
            for slender in [0.2, 1, 6]:
                with self.subTest(triangles=triangles, slender=slender):
                    faces = limbs.mesh(triangles, slender)["mesh"]["faces"]
                    edges = directed_edges(faces)
                    self.assertEqual(len(faces), triangles)
                    self.assertEqual(set(edges.values()), {1})
                    self.assertTrue(all((b, a) in edges for a, b in edges))

    def test_patches_are_26_and_meet(self):
        patches = limbs.patches()
        self.assertEqual(len(patches), 26)
        sides = collections.Counter()
        for p in patches:
            for side in (p[:4], p[12:], p[::4], p[3::4]):
                sides[min(str(side), str(side[::-1]))] += 1
        self.assertEqual(set(sides.values()), {2})

    def test_odd_or_too_few_triangles_are_refused(self):
        for triangles in [6, 1301]:
            self.assertRaises(AssertionError, limbs.mesh, triangles)


class Scenes(unittest.TestCase):
    def test_all_films_have_the_sizes_of_the_tables(self):
        films = scenes.all_films()
        wanted = {f"{part['table']}-{cell['row']}" for part in cells.load(cells.THESIS) for cell in part["cells"]}
        self.assertEqual({name.removesuffix("-patches") for name in films}, wanted)
        for name, film in films.items():
            self.assertEqual(scenes.polygon_count(film), scenes.size_of(name), name)

    def test_sizes_of_table_43_are_put_together_of_the_same_models(self):
        for size, (men, others, children) in scenes.COMPANIES.items():
            self.assertEqual(8 + 5192 * men + 5176 * others + 1728 * children, size)

    def test_films_are_the_same_each_time(self):
        self.assertEqual(json.dumps(scenes.all_films()), json.dumps(scenes.all_films()))

    def test_mars_counts_the_same_and_moves_what_the_row_says(self):
        names = {"4.1-2600": (3900, 0, 2), "4.2-6500-patches": (0, 208, 5), "4.3-17296": (17296, 0, 2),
                 "4.4-3": (27664, 0, 2)}
        films = scenes.all_films(scenes.Cut(2, 32))
        with tempfile.TemporaryDirectory() as folder:
            scenes.write({name: films[name] for name in names}, folder)
            for name, (triangles, patches, moving) in names.items():
                text = subprocess.run([MARS, "info", os.path.join(folder, name + ".json")], check=True,
                                      capture_output=True, text=True).stdout
                counts = {word: int(count) for word, count in re.findall(r"^(triangles|patches) +(\d+)", text, re.M)}
                self.assertEqual((counts.get("triangles", 0), counts["patches"]), (triangles, patches), name)
                intervals = re.findall(r"^ +(\d+) +33 +(\d+)$", text, re.M)
                self.assertEqual(intervals, [("0", str(moving)), ("33", str(moving))], name)


class Thesis(unittest.TestCase):
    def setUp(self):
        self.parts = cells.load(cells.THESIS)

    def test_cells_are_as_many_and_add_up(self):
        sums = {part["table"]: (len(part["cells"]), sum(cell["ms"] for cell in part["cells"])) for part in self.parts}
        self.assertEqual(sums, {"4.1": (30, 45163), "4.2": (72, 152445), "4.3": (44, 117665), "4.4": (25, 87170)})

    def test_blanks_are_where_memory_was_short(self):
        table = cells.Cells("4.3", self.parts)
        self.assertEqual([row for row in table.rows("keyframe") if table.ms("thesis", row, "keyframe", 4) is None],
                         [43224, 70880, 98536, 138288, 165944])
        self.assertEqual([row for row in table.rows("keyframe") if table.ms("thesis", row, "keyframe", 2)], [5200])

    def test_the_best_numbers_of_nodes_are_those_that_the_thesis_names(self):
        best = lambda name, row: cells.Cells(name, self.parts).best_nodes("thesis", row, "keyframe")
        self.assertEqual((best("4.1", 1300), best("4.2", 1300), best("4.3", 165944)), (4, 8, 16))


class Baselines(unittest.TestCase):
    THESIS = {(1, 2): 40, (2, 2): 80, (1, 8): 10, (2, 8): 30, (3, 32): 5}

    def test_predict_by_the_columns_mean_and_by_the_cell_of_8_nodes(self):
        self.assertEqual(baselines.column_means(self.THESIS), {(1, 2): 60, (2, 2): 60, (1, 8): 20, (2, 8): 20, (3, 32): 5})
        self.assertEqual(baselines.shared_out(self.THESIS), {(1, 2): 40, (2, 2): 120, (1, 8): 10, (2, 8): 30})

    def test_errors_leave_out_where_predictions_start_and_rows_that_are_alone(self):
        self.assertEqual(baselines.errors(baselines.shared_out(self.THESIS), self.THESIS), {(1, 2): 0, (2, 2): 0.5})

    def test_r_squared_is_1_where_all_is_explained_and_0_as_the_mean(self):
        def r_squared(predicted, nodes=2):
            return baselines.r_squared(predicted, self.THESIS, nodes)
        self.assertEqual(r_squared(self.THESIS), 1)
        self.assertEqual(r_squared(baselines.column_means(self.THESIS)), 0)
        self.assertEqual(r_squared(baselines.shared_out(self.THESIS)), 1 - 40**2 / (20**2 + 20**2))
        self.assertIsNone(r_squared({(1, 2): 40}), "a row is missing")
        self.assertIsNone(r_squared(self.THESIS, 32), "nothing varies")

    def test_of_the_thesis_8_over_P_is_near_for_inbetweens_of_the_man_alone(self):
        parts = cells.load(cells.THESIS)

        def median(table, kind):
            thesis = cells.Cells(table, parts).cells_of("thesis", kind)
            return statistics.median(map(abs, baselines.errors(baselines.shared_out(thesis), thesis).values()))
        self.assertAlmostEqual(median("4.2", "inbetween"), 0.053, delta=0.001)
        for table, kind in (("4.1", "inbetween"), ("4.1", "keyframe"), ("4.2", "keyframe"), ("4.4", "keyframe")):
            self.assertGreater(median(table, kind), 0.2, (table, kind))

    def test_stand_beside_each_simulated_table(self):
        sheets = tables.sheets_beside_thesis(cells.load(os.path.join(RESULTS, "simulated.json")))
        for table in cells.TITLES:
            for kind in cells.KINDS[table]:
                place = next(k for k, sheet in enumerate(sheets) if sheet.get("picture") == f"table-{table}-{kind}s")
                beside = sheets[place + 1]
                self.assertEqual(beside["title"], f"Table {table}: {kind}s, beside naive predictions")
                self.assertEqual([row[0] for row in beside["rows"]], ["simulated-thesis", *baselines.NAIVE])
                for row in beside["rows"]:
                    self.assertEqual(len(row), len(beside["header"]))
                self.assertTrue(all(row[4:] == [0 if r is not None else None for r in row[4:]]
                                    for row in beside["rows"] if row[0] == "the column's mean"))

    def test_of_this_machine_alone_there_are_none(self):
        sheets = tables.sheets_beside_thesis(cells.load(os.path.join(RESULTS, "results.json")))
        self.assertFalse([sheet["title"] for sheet in sheets if "naive" in sheet["title"]])


class Docs(unittest.TestCase):
    def test_the_pages_of_1992_are_what_the_tool_makes_of_their_files(self):
        """But for pictures, which Matplotlib draws."""
        found = [part for name in ("results", "simulated", "product")
                 for part in cells.load(os.path.join(RESULTS, name + ".json"))]
        drawn = {name.removesuffix(".svg"): None for name in os.listdir(RESULTS) if name.endswith(".svg")}
        for name, text in page.markdown_pages(tables.ABOUT, tables.sheets_beside_thesis(found), drawn).items():
            with open(os.path.join(RESULTS, name)) as file:
                self.assertEqual(file.read(), text, name)


class TagCounter(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.open = collections.Counter()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.open[tag] += 1

    def handle_endtag(self, tag):
        self.open[tag] -= 1


class Rendering(unittest.TestCase):
    def setUp(self):
        simulated = {"table": "4.1", "source": "simulated-thesis", "parameters": {"speed": 1.25},
                     "cells": [{"row": 1300, "kind": "keyframe", "nodes": nodes, "ms": ms}
                               for nodes, ms in ((2, 2449 * 1.1), (4, 2306 * 0.8), (8, 2486))]}
        here = {"table": "4.1", "source": "here", "cells": [{"row": 1300, "kind": "keyframe", "nodes": 2, "ms": 2.449}]}
        self.parts = cells.load(cells.THESIS) + [simulated, here]

    def test_a_sheet_has_all_sources_with_residuals_of_the_simulated_thesis(self):
        sheet = page.sheets_of(self.parts)[0]
        self.assertEqual(sheet["header"], ["moving polygons", "source", "P = 2", "P = 4", "P = 8", "P = 16", "P = 32",
                                           "best P"])
        self.assertEqual(sheet["rows"][:3], [
            [1300, "thesis", "2449", "2306", "2486", "2917", "3711", 4],
            ["", "simulated-thesis", "2694 (+10 %)", "1845 (-20 %)", "2486 (+0 %)", "", "", 4],
            ["", "here", "2.45", "", "", "", "", 2]])
        self.assertEqual(sheet["note"], "\"simulated-thesis\" differs from the thesis by 10 % in the median, and by at "
                                        "most -20 % (row 1300, P = 4). In 1 of 1 rows, its best P took at most 5 % more "
                                        "than the least time in the thesis. \"here\" is 1000 to 1000 times as fast as "
                                        "the thesis.")

    def test_a_wrong_best_number_of_nodes_costs_what_it_takes_in_the_thesis(self):
        part = self.parts[-2]
        part["cells"] = [{**cell, "ms": 100 * cell["nodes"]} for cell in part["cells"]]
        regrets = cells.Cells("4.1", self.parts).regrets("simulated-thesis", "keyframe")
        self.assertEqual(list(regrets), [1300])
        self.assertAlmostEqual(regrets[1300], 2449 / 2306 - 1)

    def test_markdown_and_html_have_the_same_fields(self):
        sheets = page.sheets_of(self.parts) + page.parameters_of(self.parts)
        text = "".join(page.markdown_pages("Intro.", sheets, {}).values())
        marked = page.page("Intro.", sheets, {"table-4.1-keyframes": "<svg></svg>"})
        self.assertIn("|  | simulated-thesis | 2694 (+10 %) | 1845 (-20 %) | 2486 (+0 %) |  |  | 4 |", text)
        self.assertIn("| simulated-thesis | speed | 1.25 |", text)
        fields = TagCounter(marked)
        self.assertEqual(set(fields.open.values()) - {0}, {1}, "only meta has no end")
        self.assertEqual(marked.count("<td"), sum(len(row) for sheet in sheets for row in sheet["rows"]))
        self.assertEqual((marked.count("<svg>"), marked.count("src="), marked.count("href=")), (1, 0, 0))

    def test_each_table_and_topic_has_a_page_and_the_first_page_leads_to_it(self):
        study = {"title": "Blocks", "note": "", "header": ["side"], "rows": [[16]]}
        files = page.markdown_pages("Intro.", page.sheets_of(self.parts) + [study] + page.parameters_of(self.parts), {})
        self.assertEqual(list(files), ["tables.md", "table-4.1.md", "comparisons.md", "parameters.md"])
        self.assertEqual(re.findall(r"\]\((.*?)\)", files["tables.md"]), list(files)[1:])
        self.assertIn("## Blocks", files["comparisons.md"])
        self.assertIn("| simulated-thesis | speed |", files["parameters.md"])
        for text in files.values():
            self.assertRegex(text, r"\A# .+\n\n")

    def test_results_read_back_and_others_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "results.json")
            for text in (cells.text_of(self.parts), '{"table": "4.9", "source": "x", "cells": []}', "["):
                with open(file, "w") as out:
                    out.write(text)
                if text == cells.text_of(self.parts):
                    self.assertEqual(cells.load(file), self.parts)
                else:
                    self.assertRaisesRegex(cells.Trouble, "results.json", cells.load, file)


class Studies(unittest.TestCase):
    def test_dealt_patches_give_each_node_a_stretch(self):
        for nodes in [1, 3, 8]:
            order = studies.dealt(list(range(20)), nodes)
            self.assertEqual(sorted(order), list(range(20)))
            self.assertEqual([item for node in range(nodes) for item in order[node::nodes]], list(range(20)))

    def test_a_standing_figure_has_all_its_patches_in_the_unit_cube(self):
        model = figures.as_one_segment(figures.standing_patches(figures.MAN, figures.MAN_POSE))
        points = [x for patch in model["shapes"]["all"] for point in patch for x in point]
        self.assertEqual((len(points), min(points), max(points)), (208 * 16 * 3, 0, 1))


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        run = subprocess.run([MARS, "bench", "tables", "--quick", "--nodes", "1,2", "-o", cls.folder.name],
                             capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        cls.shown = run.stdout
        cls.results = cells.load(os.path.join(cls.folder.name, "results.json"))

    def study(self, title):
        return next(part["rows"] for part in self.results if part.get("title", "").startswith(title))

    def test_a_quick_run_fills_every_table(self):
        for table in cells.TITLES:
            filled = cells.Cells(table, [part for part in self.results if "cells" in part])
            for kind in cells.KINDS[table]:
                self.assertIn(f"## Table {table}: {cells.TITLES[table]}; {kind}s", self.shown)
                for source in ("here, best", "here, median", "here, own work"):
                    for row in filled.rows(kind):
                        for nodes in (1, 2):
                            self.assertGreater(filled.ms(source, row, kind, nodes), 0, (table, source, row))

    def test_the_page_stands_alone(self):
        with open(os.path.join(self.folder.name, "tables.html")) as file:
            text = file.read()
        self.assertNotRegex(text, r"(src|href)=\"(?!#)")
        self.assertIn("Table 4.4", text)

    def test_a_vertical_limb_has_more_edge_boxes(self):
        boxes = {row[0]: row[2] for row in self.study("Figure 4.11")}
        self.assertGreater(boxes["vertical"], 2 * boxes["horizontal"])

    def test_scattered_patches_are_more_even_than_tiles(self):
        ratios = {row[1]: row[2] for row in self.study("Figure 4.4")}
        self.assertLess(ratios["scattered"], ratios["tiled"])

    def test_the_exact_mapping_is_as_even_as_the_heuristic(self):
        ratios = {row[2]: row[3] for row in self.study("Mapping")}
        self.assertLessEqual(ratios["optimal"], ratios["greedy"])

    def test_larger_blocks_are_fewer_and_restore_more(self):
        rows = [row[1:4] for row in self.study("Blocks") if row[0] == "4.2-5200"]
        self.assertEqual([row[0] for row in rows], studies.BLOCKS)
        self.assertEqual(rows, sorted(rows, key=lambda row: (-row[1], row[2])))

    def test_unknown_parts_are_refused(self):
        run = subprocess.run([MARS, "bench", "tables", "4.5"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 2)
        self.assertIn("there is no part 4.5", run.stderr)


if __name__ == "__main__":
    cases.main()
