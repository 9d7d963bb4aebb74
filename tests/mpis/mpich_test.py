"""A film over MPICH has the pixels that it has over the build's own MPI. Takes MPICH's mpirun as a third word."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "programs"))
from harness import EXAMPLES, PROGRAMS, ProgramTest, main  # noqa: E402

FILM = EXAMPLES / "robot-arm.json"
FEW = ["--frames", "0,5-8,30", "--size", "192x108"]


class Mpich(ProgramTest):
    def test_the_same_pixels(self):
        self.succeed("mars", "render", FILM, "-o", "own", "--backend", "mpi", "--nodes", 3, "-q", *FEW)
        self.succeed(sys.argv[3], "-n", 4, PROGRAMS / "mars-ranks-mpich", FILM, "-o", "mpich", *FEW)
        self.assertEqual(self.verified_hash("mpich"), self.verified_hash("own"))


if __name__ == "__main__":
    main()
