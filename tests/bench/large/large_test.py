"""mars bench large on the small film: the sums of its figures, and that no run is made twice.
Takes: the build's folder."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))
import curve  # noqa: E402
import film  # noqa: E402
import walls  # noqa: E402

BUILD = pathlib.Path(sys.argv.pop(1))


def bench(folder, *more):
    return subprocess.run([sys.executable, "-B", HERE / "large.py", "--build", BUILD, "--size", "small", "--platforms",
                           "fat-tree", "-o", folder, *more], capture_output=True, text=True, timeout=50, check=True)


def made(seconds, nodes, groups=1):
    return {"platform": "fat-tree", "writer": "host", "frames": "all", "size": "small", "nodes": nodes,
            "groups": groups, "film_seconds": seconds, "load_seconds": 0, "keyframe_seconds": 0,
            "inbetweens_a_second": 1, "floors": {"compute": seconds / 2, "link": seconds / 4}}


class Film(unittest.TestCase):
    def test_the_whole_one_is_as_large_as_it_says(self):
        self.assertAlmostEqual(film.WHOLE.polygons() / 1e7, 1, delta=0.01)
        self.assertEqual((film.WHOLE.picture, film.WHOLE.frames, film.WHOLE.intervals), ([3840, 2160], 2000, 60))

    def test_another_twentieth_moves_in_each_interval(self):
        for size in film.SIZES.values():
            actors = film.film_of(size)["actors"]
            models = film.film_of(size)["models"]
            firsts = size.first_frames()
            for k in range(size.intervals):
                moving = [actor for actor in actors
                          if any(key["frame"] == firsts[k] and nxt["frame"] == firsts[k + 1] and
                                 key["place"] != nxt["place"]
                                 for key, nxt in zip(actor.get("keys", []), actor.get("keys", [])[1:]))]
                self.assertEqual([actor["name"] for actor in moving], [f"part-{k % film.PARTS}"])
                bodies = len(models[moving[0]["model"]]["joints"])
                self.assertEqual(bodies * film.PARTS, size.columns * size.rows)


class Curve(unittest.TestCase):
    def test_the_quickest_groups_count(self):
        best = curve.best_runs([made(3, 16, 1), made(2, 16, 4), made(1, 64)])
        self.assertEqual([(run["nodes"], run["groups"]) for run in best], [(16, 4), (64, 1)])

    def test_efficiency_is_against_the_fewest_nodes(self):
        efficiency = [part for _, part in curve.with_efficiency([made(4, 16), made(2, 64)])]
        self.assertEqual(efficiency, [1, 0.5])


def explained(nodes, seconds, **walls_of):
    return {"nodes": nodes, "seconds": seconds, "explained": {"seconds": seconds, "walls": [], **walls_of}}


class Walls(unittest.TestCase):
    def test_a_cell_says_what_binds_and_what_binds_then(self):
        storage = {"wall": "storage", "alone": 1, "without": 0.5}
        self.assertEqual(walls.cell(explained(4, 2, binding="storage", next="host", walls=[storage])),
                         "2: storage (0.5; then host)")
        self.assertEqual(walls.cell(explained(4, 2)), "2")

    def test_three_films_have_a_row_for_each_number_of_nodes(self):
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(2):
                bench(folder, "--walls", "--films", "large", "--nodes", "4")
            files = sorted(path.name for path in pathlib.Path(folder).iterdir())
            self.assertEqual(files, ["large.counts", "large.json", "walls-large-fat-tree-4.json", "walls.md",
                                     "walls.svg"])
            rows = (pathlib.Path(folder) / "walls.md").read_text().splitlines()[4:]
            self.assertEqual([row.split(" | ")[0] for row in rows], ["| 1", "| 4"])
            for row in rows:
                self.assertRegex(row, r"^\| \d | [\d.]+: compute \(.*\) \|$")


class Bench(unittest.TestCase):
    def test_a_run_is_made_once_and_gives_the_same_digits_again(self):
        with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
            for folder in (first, first, second):
                bench(folder, "--nodes", "2,16")
            lines = [(pathlib.Path(folder) / "runs.jsonl").read_text().splitlines() for folder in (first, second)]
            self.assertEqual(len(lines[0]), len({json.dumps(json.loads(line), sort_keys=True) for line in lines[0]}))
            runs = [[{**json.loads(line), "cost": None} for line in part] for part in lines]
            self.assertEqual(runs[0], runs[1])
            for run in runs[0]:
                self.assertGreaterEqual(run["film_seconds"], 0.99 * max(run["floors"].values()))


if __name__ == "__main__":
    unittest.main()
