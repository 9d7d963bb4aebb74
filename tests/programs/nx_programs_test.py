"""The programs of examples/nx end well and say what is right, as forked processes at several numbers of nodes."""

from harness import PROGRAMS, ProgramTest, main

NX = PROGRAMS.parent / "examples-nx"
PROCESSES = [1, 2, 3, 4, 8]


def corners(nodes):
    return 1 << (nodes.bit_length() - 1)


class NxProgramsTest(ProgramTest):
    def check(self, program, says):
        """`says`: what it must print on so many nodes."""
        for nodes in PROCESSES:
            with self.subTest(program=program, nodes=nodes):
                self.assertEqual(self.succeed("mars-nx", "run", "--nodes", nodes, NX / program), says(nodes))

    def test_ring(self):
        self.check("ring", lambda nodes: f"ring: {5 * nodes * (nodes + 1) // 2} after 5 rounds of {nodes} nodes, right\n")

    def test_pi(self):
        self.check("pi", lambda nodes: f"pi: 3.14159265 by {nodes} nodes, right\n")

    def test_matrix(self):
        self.check("matrix", lambda nodes: f"matrix: 60 by 60 on {nodes} nodes, 0 elements wrong\n")

    def test_jacobi(self):
        self.check("jacobi", lambda nodes: f"jacobi: 921 steps on {nodes} nodes, right\n")

    def test_exchange(self):
        self.check("exchange", lambda nodes: f"exchange: {corners(nodes)} parts of 20000 bytes on {nodes} nodes, 0 words wrong\n")

    def test_shared_file(self):
        self.check("shared_file", lambda nodes: f"shared_file: {nodes} nodes, four modes, 0 things wrong\n")


if __name__ == "__main__":
    main()
