"""More nodes than processors: any number of nodes finishes, with the same pixels."""

import json
import unittest

from harness import EXAMPLES, MPICH, ProgramTest, main, needs_mpi, spinning_teapot

MANY = 32
NUMBERS = [1, 2, 3, 4, 5, 6, 7, 8, 9, 15, 16, 17, 24, 31, MANY]  # around powers of two, and between
FILMS = sorted(path for path in EXAMPLES.glob("*.json"))


@needs_mpi
@unittest.skipIf(MPICH, "MPICH spins while it starts, for seconds where ranks share processors")
class ManyNodes(ProgramTest):
    def pixels(self, film, nodes, *more, backend="mpi"):
        self.succeed("mars", "render", film, "-o", "out", "--overwrite", "--nodes", nodes, "--backend", backend, "--quiet",
                     *more)
        return self.verified_hash("out")

    def test_any_number_of_nodes(self):
        film = self.write("film.json", spinning_teapot(3, [160, 90]))
        self.assertEqual(len({self.pixels(film, nodes) for nodes in NUMBERS}), 1)

    def test_every_example(self):
        for film in FILMS:
            with self.subTest(film=film.name):
                few = ["--size", "96x54", "--frames", f"0-{min(4, json.loads(film.read_text())['frames'] - 1)}"]
                self.assertEqual(self.pixels(film, MANY, *few), self.pixels(film, 1, *few, backend="threads"))


if __name__ == "__main__":
    main()
