"""`mars bench traffic` on small pictures: threads and traces count alike, and nodes apart send each other triangles.

Started as: traffic_test.py BUILD_FOLDER."""
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.append(os.path.join(os.path.dirname(__file__), "..", ".."))
import cases  # noqa: E402
import messages_sent  # noqa: E402
import traffic  # noqa: E402

BUILD = sys.argv[1]


def of_nodes(sent):
    """What the nodes send; how often the host gives credit back depends on the moment."""
    return {key: each for key, each in sent.items() if key[2] in messages_sent.KINDS}


class Counting(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_threads_and_traces_count_alike(self):
        film = traffic.Film("s1", self.folder, [160, 90])
        counted = traffic.on_threads(BUILD, film, 3, 3)
        self.assertEqual(of_nodes(counted), of_nodes(traffic.by_trace(BUILD, film, 3, "threads", self.folder)))
        self.assertEqual({key[0] for key in counted if key[2] == "Strip"}, {0, 1, 2})

    def test_nodes_apart_send_triangles(self):
        film = traffic.Film("s1", self.folder, [160, 90])
        rows = dict(messages_sent.rows_of(traffic.on_threads(BUILD, film, 3, 1), 3))
        self.assertTrue(all(node.bytes > 0 for node in rows["triangles"]), rows)

    def test_the_command_shows_a_table(self):
        run = subprocess.run([os.path.join(BUILD, "bin", "mars"), "bench", "traffic", "--scenes", "s1", "--nodes", "2",
                              "--each", "all"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("s1, a keyframe, 2 nodes, on one machine", run.stdout)


if __name__ == "__main__":
    cases.main()
