"""Whatever is wrong, there is one clear line on standard error, the right exit code, and no half frame."""

import os
import re
import resource
import shutil
import unittest

from harness import (ENVIRONMENT, EXAMPLES, MPICH, OWN_MPIRUN, PROGRAMS, SANITIZED, ProgramTest, main, needs_mpi,
                     spinning_teapot)

TEAPOT = EXAMPLES / "teapot.json"


class CommandLine(ProgramTest):
    def test_wrong_options(self):
        for words, says in [(["--nodez", "3"], "nodez"),
                            (["--nodes", "0"], "--nodes: '0' is not a number"),
                            (["--nodes", "two"], "--nodes: 'two' is not a number"),
                            (["--size", "0x10"], "--size: '0x10'"),
                            (["--size", "16"], "like 960x540"),
                            (["--frames", "9-3"], "--frames: '9-3' ends before it begins"),
                            (["--mapping", "best"], "--mapping: 'best' is not greedy or optimal or cost"),
                            (["--backend", "smoke"], "not auto or mpi or threads")]:
            with self.subTest(words=words):
                self.fail_clearly(2, "render", TEAPOT, "-o", "out", *words, says=says)
                self.assertFalse((self.folder / "out").exists())

    def test_missing_words(self):
        self.fail_clearly(2, "render", says="FILM is required")
        self.fail_clearly(2, "info", "", says="FILM: is empty")
        self.fail_clearly(2, "render", TEAPOT, says="add -o DIR, or --sink none")
        self.fail_clearly(2, "compile", TEAPOT, says="--output is required")
        self.fail_clearly(2, "paint", says="paint")

    def test_words_out_of_place(self):
        self.fail_clearly(1, "compile", TEAPOT, "-o", "film.json", says="name it like film.mars")
        self.fail_clearly(2, "compile", TEAPOT, "-o=film.mars", says="'=film.mars' begins with = (write -o film.mars)")
        self.fail_clearly(2, "compile", TEAPOT, "-o", "a.mars", "-o", "b.mars", says="--output is given more than once")
        self.fail_clearly(2, "film", "new", "play.json", says="'new' comes later: write mars film FILM new")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_frames_beyond_the_film(self):
        self.fail_clearly(1, "render", TEAPOT, "-o", "out", "--frames", "20-30",
                          says="beyond the film's last, 23")

    def test_settings_that_make_no_sense(self):
        for backend in self.backends():
            self.fail_clearly(1, "render", TEAPOT, "-o", "out", "--backend", backend,
                              says='MARS_SIMD: "abacus" is not', env=dict(ENVIRONMENT, MARS_SIMD="abacus"))
        done = self.mars("render", TEAPOT, "-o", "out", env=dict(ENVIRONMENT, MARS_MEMROY="9"))
        self.assertIn("did you mean MARS_MEMORY?", done.stdout)


class Films(ProgramTest):
    def fail_with_film(self, film, says):
        for backend in self.backends():
            with self.subTest(film=film.name, backend=backend):
                self.fail_clearly(1, "render", film, "-o", "out", "--backend", backend, says=says)
                self.assertNothingTorn(self.folder / "out")
        self.fail_clearly(1, "compile", film, "-o", "film.mars", says=says)
        self.fail_clearly(1, "info", film, says=says)
        self.assertFalse((self.folder / "film.mars").exists())

    def test_missing(self):
        self.fail_with_film(self.folder / "none.json", "none.json: there is no such file")

    def test_malformed(self):
        self.fail_with_film(self.write("cut.json", '{"frames": 3,'), "cut.json:1: is not JSON")
        self.fail_with_film(self.write("empty.json", ""), "empty.json")
        film = spinning_teapot(3, [8, 8])
        film["camara"] = film.pop("camera")
        self.fail_with_film(self.write("misspelt.json", film), "camera")

    def test_damaged(self):
        """Every kind of damage, printed in words of our own."""
        film = (EXAMPLES / "teapot.json").read_bytes()
        self.succeed("mars", "compile", TEAPOT, "-o", "whole.mars")
        whole = (self.folder / "whole.mars").read_bytes()
        garbled = lambda data: bytes(b ^ 0x55 if i % 97 == 0 else b for i, b in enumerate(data))
        damaged = {
            "cut.json": (film[:len(film) // 2], ""), "garbled.json": (garbled(film), "is not JSON"),
            "deep.json": (b"[" * 100000, "64 deep"), "deep-object.json": (b'{"a":' * 100000, "64 deep"),
            "large.json": (b'{"frames": 1e999}', "a number is too large"),
            "long.json": (b'{"frames": ' + b"9" * 100000 + b"}", "a number is too large"),
            "latin.json": (film.replace(b'"', b'"\xff', 1), "a text is not UTF-8"),
            "line.json": (b'{"a\n": 1}', "the end of a line"), "escape.json": (b'{"a\\x": 1}', "a wrong escape"),
            "half.json": (b'{"a\\ud800": 1}', "half a character"), "more.json": (film + b"}", "goes on after its end"),
            "digit.json": (b'{"frames": 1.}', "a number is not complete"), "text.json": (b'{"fra}', "ends within a text"),
            "twice.json": (b'{"frames": 1, "frames": 2}', "stands twice"), "null.json": (b"null", ""),
            "huge.json": (b'{"frames": 123456789012345678901234567890}', ""),
            "garbled.mars": (garbled(whole), ""), "cut.mars": (whole[:len(whole) // 2], "")}
        for name, (data, says) in damaged.items():
            (self.folder / name).write_bytes(data)
            with self.subTest(name=name):
                self.fail_clearly(1, "info", name, says=says)
                self.fail_clearly(1, "compile", name, "-o", "film.mars", says=says)
                self.fail_clearly(1, "render", name, "--sink", "none", "--backend", "threads", says=says)
                self.fail_clearly(1, "animate", name, "list")
                self.fail_clearly(1, "model", name, "show")

    def test_names_that_are_no_text(self):
        self.succeed("mars", "model", "dog.json", "new", "--shape", "ellipsoid", "--sbb", *"-1 -1 -1 1 1 1".split())
        before = (self.folder / "dog.json").read_bytes()
        self.fail_clearly(1, "model", "dog.json", "add", os.fsdecode(b"leg\xff"), "--parent", "body",
                          says="a name that was given is not UTF-8")
        self.assertEqual((self.folder / "dog.json").read_bytes(), before)

    def test_binary(self):
        path = self.folder / "noise.json"
        path.write_bytes(bytes(range(256)) * 9)
        self.fail_with_film(path, "noise.json")

    def test_torn_compiled_film(self):
        self.succeed("mars", "compile", TEAPOT, "-o", "whole.mars")
        whole = (self.folder / "whole.mars").read_bytes()
        torn = self.folder / "torn.mars"
        for length in [10, 64, len(whole) - 1]:
            torn.write_bytes(whole[:length])
            self.fail_clearly(1, "info", torn, says="torn.mars")
        self.fail_with_film(torn, "torn.mars")

    def test_torn_patch_file(self):
        cut = self.write("cut.bpt", "1\n3 3\n0 0 0\n")
        self.fail_clearly(1, "import", cut, "-o", "model.json", says="cut.bpt")
        self.assertFalse((self.folder / "model.json").exists())


@unittest.skipIf(SANITIZED, "a sanitizer takes more addresses than any limit leaves")
class Memory(ProgramTest):
    """Limits of a process's addresses (ulimit -v), from hardly any to nearly enough."""

    def within(self, kilobytes, *words):
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (kilobytes << 10, kilobytes << 10))
        done = self.run_program(*words, preexec_fn=limit)
        self.refusal = done.stderr
        if done.returncode != 0:
            self.assertIn("ulimit -v", done.stderr, f"{kilobytes} kB: {words}")
            self.assertClear(done.stderr, "")
            self.assertEqual(done.returncode, 1)
        return done.returncode == 0

    def test_small_limits(self):
        for backend in self.backends():
            draw = ["mars", "render", TEAPOT, "--sink", "none", "--nodes", 3, "--frames", "0", "--backend", backend]
            with self.subTest(backend=backend):
                self.assertFalse(self.within(60000, *draw))
                for kilobytes in range(80000, 500000, 60000):
                    self.within(kilobytes, *draw)
                self.assertTrue(self.within(1500000, *draw))

    def test_the_limit_that_is_named_does(self):
        for nodes in [1, 3]:
            draw = ["render", TEAPOT, "--sink", "none", "--nodes", nodes, "--frames", "0", "--backend", "threads"]
            limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (300000 << 10, 300000 << 10))
            printed = self.fail_clearly(1, *draw, says="ulimit -v: the limit of 300000 kB", preexec_fn=limit).stderr
            limit = int(re.search(r"raise it to (\d+) or more", printed)[1])
            self.assertTrue(self.within(limit, "mars", *draw), f"{limit} kB, {nodes} nodes: {self.refusal}")

    def test_nodes_read_each_others_triangles_within_limits(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (1000000 << 10, 1000000 << 10))
        for backend in self.backends():
            printed = self.succeed("mars", "render", TEAPOT, "--sink", "none", "--nodes", 4, "--frames", "0", "--backend",
                                   backend, preexec_fn=limit)
            self.assertNotIn("warning", printed)

    def test_a_limit_of_data_is_named(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_DATA, (80000 << 10, 80000 << 10))
        for backend in self.backends():
            self.fail_clearly(1, "render", TEAPOT, "--sink", "none", "--nodes", 3, "--frames", "0", "--backend", backend,
                              says="ulimit -d 80000", preexec_fn=limit)

    def test_without_a_backend(self):
        self.assertFalse(self.within(50000, "mars", "info", TEAPOT))
        self.assertTrue(self.within(400000, "mars", "info", TEAPOT))


class Folders(ProgramTest):
    def test_unwritable(self):
        file = self.write("file", "here")
        for backend in self.backends():
            for out in [file / "out", "/proc/out"]:
                self.fail_clearly(1, "render", TEAPOT, "-o", out, "--backend", backend,
                                  says=f"{out}: cannot create the folder")
        self.fail_clearly(1, "compile", TEAPOT, "-o", file / "film.mars", says="film.mars")
        self.fail_clearly(1, "verify", self.folder, says="frames.json")
        self.fail_clearly(1, "verify", self.folder / "none", says="none")

    def test_forbidden(self):
        (self.folder / "out").mkdir(mode=0o500)
        # Root without what lets it write everywhere.
        bounds = ["setpriv", "--bounding-set=-dac_override"] if os.geteuid() == 0 else []
        done = self.run_program(*bounds, PROGRAMS / "mars", "render", TEAPOT, "-o", "out")
        self.assertEqual(done.returncode, 1)
        self.assertClear(done.stderr, "Permission denied")

    def test_file_size_limit(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))
        done = self.mars("render", TEAPOT, "-o", "out", "--backend", "threads", preexec_fn=limit)
        self.assertEqual(done.returncode, 1)
        self.assertClear(done.stderr, "ulimit -f")
        self.assertNothingTorn(self.folder / "out")
        corners = "".join(f"v {i} {i % 7} {i % 5}\nf -3 -2 -1\n" for i in range(3, 300))
        mesh = self.write("mesh.obj", "v 0 0 0\nv 1 0 0\n" + corners)
        before = set(os.listdir(self.folder))
        for words in [["import", mesh], ["compile", TEAPOT], ["preview", TEAPOT]]:
            new = {"import": "new.json", "compile": "new.mars", "preview": "new.png"}[words[0]]
            self.fail_clearly(1, *words, "-o", new, says=f"{new}: cannot write: File too large (raise ulimit -f",
                              preexec_fn=limit)
        if shutil.which("ffmpeg"):  # which would cut it short
            self.fail_clearly(1, "preview", TEAPOT, "-o", "new.gif", says="ulimit -f", preexec_fn=limit)
        self.assertEqual(set(os.listdir(self.folder)), before, "no part of a file is left")


class Starting(ProgramTest):
    def path_of_its_own(self):
        return dict(ENVIRONMENT, PATH=str(self.folder))

    def test_mpirun_is_missing(self):
        self.fail_clearly(1, "render", TEAPOT, "-o", "out", "--backend", "mpi", says="mpirun was not found",
                          env=self.path_of_its_own())

    def test_threads_stand_in_where_mpirun_is_missing(self):
        printed = self.succeed("mars", "render", TEAPOT, "-o", "out", "--frames", "0",
                            env=self.path_of_its_own())
        self.assertIn("mars-threads", printed)

    def test_threads_do_not_stand_in_for_other_machines(self):
        """By a hostfile, in an allocation; of NX programs, too. A hostfile of this machine alone needs no mpirun."""
        others, here = self.write("others", "localhost\nn2 slots=4\n"), self.write("here", "localhost slots=4\n")
        nowhere, allocation = self.path_of_its_own(), {"SLURM_JOB_NUM_NODES": "4", "SLURMD_NODENAME": "n1"}
        render = ["render", TEAPOT, "-o", "out", "--frames", "0"]
        for words, more, says in [([*render, "--hostfile", others], {}, f"mpirun was not found, and {others} names other"),
                                  (render, allocation, "the Slurm job has 4 machines (load the module of "),
                                  (render, {"FLUX_JOB_NNODES": "3"}, "the Flux job has 3 machines (load the module "),
                                  (render, {"PBS_NODEFILE": "gone"}, "cannot be read from PBS_NODEFILE")]:
            self.fail_clearly(1, *words, says=says, env=dict(nowhere, **more))
            self.assertFalse((self.folder / "out").exists())
        nx = self.run_program("mars-nx", "run", "/bin/true", env=dict(nowhere, **allocation))
        self.assertEqual(nx.returncode, 1)
        self.assertIn("the Slurm job has 4 machines (load the module of ", nx.stderr)
        self.assertIn("mars-threads", self.succeed("mars", *render, "--hostfile", here, env=nowhere))

    @needs_mpi
    def test_no_remote_shell(self):
        (self.folder / "mpirun").symlink_to(shutil.which(OWN_MPIRUN[0]))
        self.succeed("mars", "render", TEAPOT, "-o", "out", "--frames", "0", "--backend", "mpi",
                     env=self.path_of_its_own())

    @needs_mpi
    def test_mpirun_does_not_work(self):
        for script, says in [("exit 3", "mpirun ended with exit code 3"),
                             ("echo lost my way >&2; exit 1", "mpirun ended with exit code 1"),
                             ("exit 0", "mpirun ended before all frames were there"),
                             ("kill -SEGV $$", "mpirun was killed by signal 11")]:
            self.write("mpirun", "#!/bin/sh\n" + script).chmod(0o755)
            done = self.mars("render", TEAPOT, "-o", "out", "--backend", "mpi", "--restarts", 0,
                             env=dict(ENVIRONMENT, PATH=f"{self.folder}:{ENVIRONMENT['PATH']}"))
            self.assertEqual(done.returncode, 1)
            self.assertIn(says, done.stderr)

    @needs_mpi
    @unittest.skipIf(MPICH, "MPICH goes round over the hosts")
    def test_an_allocation_too_small(self):
        hosts = self.write("hosts", "localhost slots=1\n")
        done = self.mars("render", TEAPOT, "-o", "out", "--backend", "mpi", "--nodes", 1,
                         env=dict(ENVIRONMENT, OMPI_MCA_orte_default_hostfile=str(hosts)))
        if "--oversubscribe" in done.stdout:
            self.skipTest("one core: mars asks for more than there is")
        self.assertClear(done.stderr, "too few slots for the host and the nodes")

    @needs_mpi
    def test_a_half_of_the_job_alone(self):
        for words in [["mars-node"], ["mars-host", TEAPOT, "-o", "out"], ["mars-ranks", TEAPOT, "-o", "out"]]:
            done = self.run_program(*words)
            self.assertEqual(done.returncode, 1)
            self.assertIn("mpirun -n 1 mars-host", done.stderr)
            self.assertNothingTorn(self.folder / "out")


if __name__ == "__main__":
    main()
