"""More nodes than processors: any number of nodes finishes, with the same pixels."""

import json
import unittest

from harness import EXAMPLES, MPICH, ProgramTest, SideBySide, main, needs_mpi, spinning_teapot

NUMBERS = [4, 6, 7, 9, 15, 16, 17, 24, 31, 32]  # around powers of two, and between; others: backends_test.py
FILMS = sorted(path for path in EXAMPLES.glob("*.json"))


class ManyNodes(SideBySide, ProgramTest):
    AT_ONCE = 2

    def pixels(self, film, nodes, *more, backend="mpi"):
        self.succeed("mars", "render", film, "-o", "out", "--overwrite", "--nodes", nodes, "--backend", backend, "--quiet",
                     *more)
        return self.verified_hash("out")

    @needs_mpi
    @unittest.skipIf(MPICH, "MPICH spins while it starts, for seconds where ranks share processors")
    def test_any_number_of_nodes(self):
        film = self.write("film.json", spinning_teapot(3, [160, 90]))
        alone = self.pixels(film, 1, backend="threads")
        for nodes in NUMBERS:
            with self.subTest(nodes=nodes):
                self.assertEqual(self.pixels(film, nodes), alone)

    def test_every_example(self):
        """Each with 32 threads, and over MPI, whose start costs most, with 9 nodes; one over MPI with 32."""
        over_mpi = [] if MPICH else self.over_mpi("mpi")
        for film in FILMS:
            ways = [("threads", 32), *((backend, 32 if film.name == "demo.json" else 9) for backend in over_mpi)]
            few = ["--size", "96x54", "--frames", f"0-{min(4, json.loads(film.read_text())['frames'] - 1)}"]
            alone = self.pixels(film, 1, *few, backend="threads")
            for backend, nodes in ways:
                with self.subTest(film=film.name, backend=backend):
                    self.assertEqual(self.pixels(film, nodes, *few, backend=backend), alone)


if __name__ == "__main__":
    main()
