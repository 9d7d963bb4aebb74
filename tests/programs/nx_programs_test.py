"""The programs of examples/nx end well and say what is right at several numbers of nodes, as forked processes and
under a person's own mpirun."""

import unittest

from harness import ENVIRONMENT, OWN_MPIRUN, PROGRAMS, ProgramTest, main

NX = PROGRAMS.parent / "examples-nx"
PROCESSES = [1, 2, 3, 4, 8]

needs_fortran = unittest.skipUnless((NX / "fortran_pi").exists(), "built without a Fortran compiler")


def corners(nodes):
    return 1 << (nodes.bit_length() - 1)


class NxProgramsTest(ProgramTest):
    def check(self, says, *programs):
        """`says`: what it must print on each number of nodes in PROCESSES."""
        words = [NX / program for program in programs]
        for nodes in PROCESSES:
            with self.subTest(programs=programs, nodes=nodes):
                self.assertEqual(self.succeed("mars-nx", "run", "--nodes", nodes, *words), says(nodes))
        host = ["-n", 1, words[0], ":"] if len(words) == 2 else []
        for nodes in self.over_mpi(2, 4):
            with self.subTest(programs=programs, ranks=nodes):
                self.assertEqual(self.succeed(*OWN_MPIRUN, *host, "-n", nodes, words[-1]), says(nodes))

    def test_ring(self):
        self.check(lambda nodes: f"ring: {5 * nodes * (nodes + 1) // 2} after 5 rounds of {nodes} nodes, right\n", "ring")

    def test_pi(self):
        self.check(lambda nodes: f"pi: 3.14159265 by {nodes} nodes, right\n", "pi")

    def test_matrix(self):
        self.check(lambda nodes: f"matrix: 60 by 60 on {nodes} nodes, 0 elements wrong\n", "matrix")

    def test_jacobi(self):
        self.check(lambda nodes: f"jacobi: 921 steps on {nodes} nodes, right\n", "jacobi")

    def test_exchange(self):
        self.check(lambda nodes: f"exchange: {corners(nodes)} parts of 20000 bytes on {nodes} nodes, 0 words wrong\n", "exchange")

    def test_farm(self):
        says = lambda nodes: f"farm: 2262 primes below 20000 by {nodes} nodes, right\n"
        self.check(says, "farm_host", "farm_node")
        alone = self.succeed("mars-nx", "run", "--nodes", 4, "--host", NX / "farm_host")
        self.assertEqual(alone, says(4))

    def test_counter(self):
        self.check(lambda nodes: f"counter: 500 pieces done by {nodes} nodes, each once\n", "counter")

    def test_counter_with_handlers_on_a_thread(self):
        environment = dict(ENVIRONMENT, MARS_NX_HANDLERS="thread")
        for nodes in PROCESSES:
            said = self.succeed("mars-nx", "run", "--nodes", nodes, NX / "counter", env=environment)
            self.assertEqual(said, f"counter: 500 pieces done by {nodes} nodes, each once\n")

    def test_strict_sends_find_who_sends_head_to_head(self):
        environment = dict(ENVIRONMENT, MARS_NX_STRICT="yes")
        done = self.run_program("mars-nx", "run", "--nodes", 4, NX / "exchange", env=environment)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("every process waits for a message", done.stderr)
        said = self.succeed("mars-nx", "run", "--nodes", 4, NX / "matrix", env=environment)
        self.assertIn("0 elements wrong", said)

    @needs_fortran
    def test_pi_in_fortran(self):
        self.check(lambda nodes: f"pi: 3.14159265 by {nodes:2} nodes\n", "fortran_pi")

    @needs_fortran
    def test_heat_in_fortran(self):
        self.check(lambda nodes: f"heat:  2050 steps on {nodes:2} nodes\n", "fortran_heat")

    def test_shared_file(self):
        self.check(lambda nodes: f"shared_file: {nodes} nodes, four modes, 0 things wrong\n", "shared_file")


if __name__ == "__main__":
    main()
