"""The same film gives the same pixels with any backend, number of nodes, starter and division of work."""

from harness import EXAMPLES, OWN_MPIRUN, PROGRAMS, ProgramTest, main, needs_mpi

FILM = EXAMPLES / "robot-arm.json"
FEW = ["--frames", "0,5-8,30", "--size", "192x108"]


class Backends(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.hashes = {}

    def hash_of(self, *options):
        self.succeed("mars", "render", FILM, "-o", "out", "--overwrite", "-q", *FEW, *options)
        return self.verified_hash(self.folder / "out")

    def expected(self):
        if "hash" not in self.hashes:
            self.hashes["hash"] = self.hash_of("--backend", "threads", "--nodes", 1)
        return self.hashes["hash"]

    def test_any_number_of_nodes(self):
        for backend in self.backends():
            for nodes in [1, 2, 3, 5, 8]:
                with self.subTest(backend=backend, nodes=nodes):
                    self.assertEqual(self.hash_of("--backend", backend, "--nodes", nodes), self.expected())

    def test_any_division_of_work(self):
        for options in [["--no-coherence"], ["--intervals", "keyframes"], ["--mapping", "optimal"],
                        ["--mapping", "cost"], ["--groups", 1], ["--sharers", 3], ["--cut", 2],
                        ["--exchange", "again"], ["--block", 7]]:
            with self.subTest(options=options):
                self.assertEqual(self.hash_of("--nodes", 3, *options), self.expected())

    def test_threads_program_alone(self):
        self.succeed("mars-threads", FILM, "-o", "out", "--nodes", 2, *FEW)
        self.assertEqual(self.verified_hash("out"), self.expected())

    @needs_mpi
    def test_own_mpirun_line(self):
        self.succeed(*OWN_MPIRUN, "-n", 1, PROGRAMS / "mars-host", FILM, "-o", "out", *FEW, ":", "-n", 3,
                     PROGRAMS / "mars-node")
        self.assertEqual(self.verified_hash("out"), self.expected())

    @needs_mpi
    def test_host_in_any_place(self):
        self.succeed(*OWN_MPIRUN, "-n", 2, PROGRAMS / "mars-node", ":", "-n", 1, PROGRAMS / "mars-host", FILM,
                     "-o", "out", *FEW)
        self.assertEqual(self.verified_hash("out"), self.expected())

    @needs_mpi
    def test_nodes_that_are_kept_apart(self):
        """Each in a user namespace, as containers may be: they cannot see each other's memory."""
        apart = ["unshare", "--user", "--map-root-user"]
        if self.run_program(*apart, "true").returncode != 0:
            self.skipTest("no user namespaces here")
        for ways in ([], ["--exchange", "again"], ["--groups", "1", "--sharers", "2", "--cut", "2"]):
            done = self.run_program(*OWN_MPIRUN, "-n", 1, PROGRAMS / "mars-host", FILM, "-o", "out", "--overwrite", *FEW,
                                    *ways, ":", "-n", 3, *apart, PROGRAMS / "mars-node")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.count("cannot share memory"), 1, done.stdout)
            self.assertRegex(done.stdout, r'"warning","text":"the nodes on .* cannot share memory \(.*ermission denied')
            self.assertEqual(self.verified_hash("out"), self.expected())

    @needs_mpi
    def test_combined_program(self):
        self.succeed(*OWN_MPIRUN, "-n", 4, PROGRAMS / "mars-ranks", FILM, "-o", "out", *FEW)
        self.assertEqual(self.verified_hash("out"), self.expected())


if __name__ == "__main__":
    main()
