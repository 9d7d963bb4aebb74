"""C programs of NX as a person starts them: by mars-nx run over processes and over MPI, by a line of mpirun's, alone; and
how they end, in order and otherwise. Each has a main function that knows nothing of jobs."""

import fcntl
import os
import pathlib
import pty
import signal
import subprocess
import tempfile
import termios
import time
import unittest

from harness import (ENVIRONMENT, OWN_MPIRUN, PROGRAMS, PROMPT, SECONDS, SOURCES, ProgramTest, SideBySide, family,
                     living, main, needs_mpi, wait_until)

LIBRARY = PROGRAMS.parent / "hal/program"
MARS_NX = PROGRAMS / "mars-nx"

# The last argument says what a node does.
NODE = r"""
#include <cube.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
static char big[1 << 20];
int calls;
static void work(const char* what) {
  long x = 0, i;
  if (!strcmp(what, "square")) {
    crecv(10, &x, sizeof x);
    x *= x;
    csend(11, &x, sizeof x, myhost(), 0);
  }
  if (!strcmp(what, "crash") && mynode() == 2) signal(SIGSEGV, SIG_DFL), raise(SIGSEGV);
  if (!strcmp(what, "leave") && mynode() == 2) _exit(4);
  if (!strcmp(what, "code")) exit((int)mynode() + 3);
  if (!strcmp(what, "give-up") && mynode() == 1) exit(7);
  if (!strcmp(what, "sleep")) { mynode(); printf("sleeping\n"); sleep(100); }
  if (!strcmp(what, "sum")) {
    double one = 1, work;
    if (_gdsum(&one, mynode() == 1 ? -1 : 1, &work) < 0) nx_perror("printed");
    exit(0);
  }
  if (!strcmp(what, "to-pid")) csend(11, &x, sizeof x, myhost(), 100);
  if (!strcmp(what, "fail") && mynode() == 0) csend(1, &x, sizeof x, 99, 0);
  if (!strcmp(what, "load")) load("node", -1, 0);
  if (!strcmp(what, "fill")) for (i = 0; i < 100; i++) csend(1, big, sizeof big, mynode(), 0);
  if (!strcmp(what, "reuse")) for (i = 0; i < 100; i++) { csend(1, big, sizeof big, mynode(), 0); crecv(1, big, sizeof big); }
  if (!strcmp(what, "to-host")) csend(1, &x, sizeof x, myhost(), 0);
  if (!strcmp(what, "to-nobody")) { x = _csend(1, &x, sizeof x, numnodes(), 0); printf("%ld %d\n", x, errno == EQNODE); }
  if (!strcmp(what, "read")) { char line[80] = ""; if (mynode() == 0 && !fgets(line, sizeof line, stdin)) exit(1); printf("read %s", line); }
  if (!strcmp(what, "late")) { sleep(1); printf("late\n"); }
  if (strcmp(what, "square") && strcmp(what, "late") && strcmp(what, "reuse") && strcmp(what, "read") && strncmp(what, "to-", 3)) crecv(10, &x, sizeof x);
}
int main(int argc, char** argv) {
  if (argc < 2) {
    char text[40];
    long me = mynode(), n = numnodes();
    sprintf(text, "word of %ld", me);
    csend(1, text, sizeof text, (me + 1) % n, 0);
    crecv(1, text, sizeof text);
    printf("%ld of %ld has %s, call %d\n", me, n, text, ++calls);
    return 0;
  }
  work(argv[argc - 1]);
  return 0;
}
"""

HOST = r"""
#include <cube.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
static long squares(void) {
  long i, x, sum = 0;
  for (i = 0; i < numnodes(); i++) csend(10, &i, sizeof i, i, 0);
  for (i = 0; i < numnodes(); i++) { crecv(11, &x, sizeof x); sum += x; }
  return sum;
}
static void print_ends(void) {
  long i, node, pid, code;
  for (i = 0; i < numnodes(); i++) { waitone(-1, 0, &node, &pid, &code); printf("node %ld pid %ld code %ld\n", node, pid, code); }
}
static char longer[1000];
int main(int argc, char** argv) {
  const char* what = argv[1];
  char line[80];
  long i, x, n;
  struct cubetable table[1];
  if (!strcmp(what, "sum")) printf("sum %ld\n", squares());
  if (!strcmp(what, "cube")) {
    getcube("mine", "d1", NULL, 0);
    attachcube("mine");
    setpid(0);
    killcube(-1, -1);
    load("/usr/joe/node", -1, 0);
    n = cubeinfo(table, 1, 0);
    printf("%ld cube %s of %ld, host %ld, me %ld\n", n, table[0].cubename, table[0].nodes, myhost(), mynode());
    printf("sum %ld\n", squares());
    waitall(-1, 0);
    relcube("mine");
  }
  if (!strcmp(what, "again")) {
    getcube("mine", "4", NULL, 0);
    for (n = 0; n < 3; n++) { load("node", -1, 0); printf("sum %ld\n", squares()); waitall(-1, 0); }
    load("./loop", -1, 0);
    csend(10, &n, sizeof n, -1, 0);
    killproc(0, 0);
    waitone(0, 0, &x, &x, &n);
    printf("killed %ld\n", n);
    killcube(-1, -1);
    load("node", -1, 0);
    printf("sum %ld\n", squares());
    relcube("");
  }
  if (!strcmp(what, "two")) {
    for (i = 0; i < 2; i++) load("node", i, 0);
    for (i = 0; i < 2; i++) csend(10, &i, sizeof i, i, 0);
    for (n = i = 0; i < 2; i++) { crecv(11, &x, sizeof x); n += x; }
    waitall(-1, 0);
    printf("two %ld\n", n);
  }
  if (!strcmp(what, "ends")) print_ends();
  if (!strcmp(what, "rounds")) for (n = 0; n < 30; n++) {
    for (i = 0; i < (n % 2 ? numnodes() : 1); i++) load("talk", n % 2 ? i : -1, 0);
    waitall(-1, 0);
  }
  if (!strcmp(what, "long")) for (n = 0; n < 3; n++) {
    load("echo", -1, 0);
    for (i = 0; i < numnodes(); i++) { csend(1, longer, sizeof longer, i, 0); crecv(2, longer, sizeof longer); }
    waitall(-1, 0);
  }
  if (!strcmp(what, "busy")) { load("loop", -1, 0); sleep(1); killcube(-1, -1); load("busy", -1, 0); waitall(-1, 0); }
  if (!strcmp(what, "ends-and-again")) { load("node", -1, 0); print_ends(); killcube(-1, -1); load("square", -1, 0); printf("sum %ld\n", squares()); }
  if (!strcmp(what, "more")) getcube("mine", "16", NULL, 0);
  if (!strcmp(what, "long-name")) getcube("sixteen-letters-", "2", NULL, 0);
  if (!strcmp(what, "twin")) printf("%ld %ld %ld\n", _load("none", 0, 0), _getcube("mine", "16", NULL, 0), _relcube("other"));
  if (!strcmp(what, "load")) load(argv[2], 0, 0);
  if (!strcmp(what, "pid")) {
    printf("%ld ", mypid());
    setpid(100);
    getcube("mine", "", NULL, 0);
    for (i = 0; i < numnodes(); i++) crecv(11, &x, sizeof x);
    printf("%ld %ld\n", mypid(), _setpid(-1));
  }
  if (!strcmp(what, "receive")) crecv(99, &x, sizeof x);
  if (!strcmp(what, "kill")) { csend(10, &n, 0, 0, 0); killcube(-1, -1); return 3; }
  if (!strcmp(what, "read")) { if (!fgets(line, sizeof line, stdin)) return 1; printf("read %s", line); }
  if (!strcmp(what, "sleep")) { csend(10, &n, 0, 0, 0); sleep(100); }
  return 0;
}
"""

NOTHING = "int main(void) { return 0; }\n"
TALK = r"""
#include <cube.h>
int main(void) {
  long x = 0, left = 10 + mynode(), right = 10 + (mynode() + 1) % numnodes();
  csend(right, &x, sizeof x, right - 10, 0);
  crecv(left, &x, sizeof x);
  return 0;
}
"""
# MPI comes with the library.
BEGUN = r"""
#define _GNU_SOURCE
#include <cube.h>
#include <dlfcn.h>
int main(void) {
  ((int (*)(int*, char***))dlsym(RTLD_DEFAULT, "MPI_Init"))(0, 0);
  mynode();
  return 0;
}
"""
# The one that makes the folder has a child that ends before any call.
FORK = r"""
#include <cube.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
int main(void) {
  if (mkdir("forked", 0700) == 0 && fork() == 0) exit(0);
  wait(NULL);
  gsync();
  return 0;
}
"""
LOOP = "#include <cube.h>\nint main(void) { long x; for (;;) crecv(-1, &x, sizeof x); }\n"
ECHO = '#include <cube.h>\nstatic char x[1000];\nint main(void) { crecv(1, x, sizeof x); csend(2, x, sizeof x, myhost(), 0); return 0; }\n'
BUSY = '#include <cube.h>\n#include <unistd.h>\nint main(void) { mynode(); sleep(2); return 0; }\n'
STORM = r"""
#include <cube.h>
int main(void) {
  long x[300], n = numnodes(), i = 0;
  for (;; i++) {
    csend(1, x, (i * 37) % sizeof x, (mynode() + i) % n, 0);
    if (i % 7 == 0) crecv(-1, x, sizeof x);
    while (iprobe(-1)) crecv(-1, x, sizeof x);
  }
}
"""
SQUARE = '#include <cube.h>\nint main(void) { long x; crecv(10, &x, sizeof x); x *= x; csend(11, &x, sizeof x, myhost(), 0); return 0; }\n'


def compile_program(folder, name, text):
    source = folder / f"{name}.c"
    source.write_text(text)
    subprocess.run(["cc", "-I", SOURCES / "hal/nx", source, "-o", folder / name, "-L", LIBRARY, "-lmars-nx",
                    f"-Wl,-rpath,{LIBRARY}"], check=True)


def setUpModule():
    NxRun.programs = pathlib.Path(unittest.enterModuleContext(tempfile.TemporaryDirectory(prefix="mars-test-")))
    for name, text in [("node", NODE), ("host", HOST), ("nothing", NOTHING), ("loop", LOOP), ("begun", BEGUN), ("busy", BUSY),
                       ("fork", FORK), ("echo", ECHO), ("talk", TALK), ("square", SQUARE), ("storm", STORM)]:
        compile_program(NxRun.programs, name, text)


class NxRun(SideBySide, ProgramTest):
    def setUp(self):
        super().setUp()
        self.folder = self.programs

    def run_nx(self, *words, **more):
        return self.run_program("mars-nx", "run", *words, **more)

    def transports(self):
        return ["processes", *self.over_mpi("mpi")]

    def well(self, *words, over="processes", **more):
        done = self.run_nx("--over", over, *words, **more)
        self.assertEqual((done.returncode, done.stderr), (0, ""), f"{words}\n{done.stdout}")
        return done.stdout

    def badly(self, code, says, *words, **more):
        """Ends with this code and one line that says so."""
        done = self.run_nx("--over", "processes", *words, **more)
        self.assertClear(done.stderr, says)
        self.assertEqual(done.returncode, code)
        return done.stdout

    def start(self, *words):
        process = subprocess.Popen([str(MARS_NX), "run", *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, env=ENVIRONMENT, cwd=self.folder)
        self.addCleanup(self.end, process)
        return process

    def start_sleeping(self, count):
        """mars-nx with a host and nodes that sleep; all of its processes."""
        process = self.start("--nodes", count, "./host", "./node", "sleep")
        for _ in range(count):
            self.assertEqual(process.stdout.readline(), "sleeping\n")
        processes = family(process.pid)
        self.assertMemoryHasNoName([process.pid, *processes])
        return process, processes

    def assertMemoryHasNoName(self, processes):
        """So that nothing of the memory which these processes share is left, however they end."""
        mapped = "".join(pathlib.Path(f"/proc/{each}/maps").read_text() for each in processes)
        self.assertIn("memfd:mars-nx", mapped)
        self.assertNotIn("/dev/shm/", mapped)

    def pid_of(self, processes, program):
        return next(pid for pid, (_, _, file) in processes.items() if pathlib.Path(file).name == program)

    def gone(self, processes):
        wait_until(lambda: not living(processes), PROMPT, lambda: f"still there: {living(processes)}")


class Starts(NxRun):
    def test_nodes_alone(self):
        for over in self.transports():
            for count in [1, 2, 5]:
                printed = self.well("--nodes", count, "./node", over=over)
                expected = {f"{i} of {count} has word of {(i - 1) % count}, call 1" for i in range(count)}
                self.assertEqual(set(printed.splitlines()), expected)

    def test_host_and_nodes(self):
        for over in self.transports():
            for count in [1, 3, 8]:
                printed = self.well("--nodes", count, "./host", "./node", "sum", "square", over=over)
                self.assertEqual(printed, f"sum {sum(i * i for i in range(count))}\n")

    def test_arguments_after_dashes(self):
        self.assertEqual(self.well("--nodes", 2, "./host", "./node", "--", "sum", "square"), "sum 1\n")
        self.assertEqual(self.well("--nodes", 1, "./node", "--", "late"), "late\n")

    def test_a_program_of_the_path(self):
        path = dict(ENVIRONMENT, PATH=f"{self.folder}:{ENVIRONMENT['PATH']}")
        self.assertIn("0 of 1", self.well("--nodes", 1, "node", cwd="/", env=path))

    def test_alone(self):
        done = self.run_program(self.folder / "node")
        self.assertEqual((done.returncode, done.stdout), (0, "0 of 1 has word of 0, call 1\n"))

    @needs_mpi
    def test_own_mpirun(self):
        printed = self.succeed(*OWN_MPIRUN, "-n", 1, "./host", "sum", ":", "-n", 3, "./node", "square")
        self.assertEqual(printed, "sum 5\n")
        printed = self.succeed(*OWN_MPIRUN, "-n", 1, "./host", "two", ":", "-n", 3, "./node", "square")
        self.assertEqual(printed, "two 1\n")
        printed = self.succeed(*OWN_MPIRUN, "-n", 3, "./node")
        self.assertIn("2 of 3 has word of 1", printed)

    @needs_mpi
    def test_the_setting_says_who_is_the_host(self):
        done = self.run_program(*OWN_MPIRUN, "-n", 1, "./square", ":", "-n", 3, "./node", "to-host",
                                env=dict(ENVIRONMENT, MARS_NX_HOST="no"))
        self.assertIn("this job has no host", done.stderr)

    @needs_mpi
    def test_mpi_for_one_thread(self):
        for handlers, code in [("calls", 0), ("thread", 1)]:
            done = self.run_nx("--over", "mpi", "--nodes", 2, "./begun", env=dict(ENVIRONMENT, MARS_NX_HANDLERS=handlers))
            self.assertEqual((done.returncode, "MPI takes calls of one thread only" in done.stderr), (code, code == 1))

    def test_no_call_at_all(self):
        for over in self.transports():
            self.assertEqual(self.well("--nodes", 3, "./nothing", over=over), "")
        self.assertEqual(self.well("--nodes", 3, "./nothing", "./nothing"), "")

    def test_a_child_that_ends_before_any_call(self):
        for over in self.transports():
            self.assertEqual(self.well("--nodes", 2, "./fork", over=over), "")
            (self.folder / "forked").rmdir()

    def test_input(self):
        for over in self.transports():
            self.assertEqual(self.well("--nodes", 2, "./host", "./node", "read", "to-host", over=over, input="a line\n"), "read a line\n")
        self.assertEqual(set(self.well("--nodes", 2, "./node", "--", "read", input="a line\n").split("read ")), {"", "a line\n"} )

    @needs_mpi
    def test_input_of_a_terminal(self):
        """It goes to mpirun, which is in the terminal's process group."""
        ours, theirs = pty.openpty()
        words = [MARS_NX, "run", "--over", "mpi", "--nodes", "2", "./host", "./node", "read", "to-host"]
        process = subprocess.Popen(words, stdin=theirs, stdout=subprocess.PIPE, env=ENVIRONMENT, cwd=self.folder,
                                   start_new_session=True, preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
        self.addCleanup(self.end, process)
        os.write(ours, b"a line\n")
        self.assertEqual(process.stdout.readline(), b"read a line\n")
        self.assertEqual(process.wait(SECONDS), 0)
        os.close(ours)
        os.close(theirs)

    def test_programs_within_scripts(self):
        script = self.write("script", "#!/bin/sh\n./node\n")
        script.chmod(0o755)
        self.assertIn("1 of 2 has word of 0", self.well("--nodes", 2, "./script"))


class Cubes(NxRun):
    def test_the_host_gets_a_cube_and_loads(self):
        for over in self.transports():
            printed = self.well("--nodes", 4, "./host", "./node", "cube", "square", over=over)
            self.assertEqual(printed, "1 cube mine of 2, host 2, me 2\nsum 1\n")

    def test_a_node_that_is_not_loaded_never_begins(self):
        for over in self.transports():
            self.assertEqual(self.well("--nodes", 3, "./host", "./node", "two", "square", over=over), "two 1\n")

    def test_the_host_has_a_pid_of_its_own(self):
        for over in self.transports():
            self.assertEqual(self.well("--nodes", 2, "./host", "./node", "pid", "to-pid", over=over), "0 100 -1\n")

    def test_loads_without_a_program_of_the_command_line(self):
        printed = self.well("--nodes", 4, "--host", "./host", "--", "cube", "square")
        self.assertIn("sum 1", printed)

    def test_other_programs_on_the_same_nodes(self):
        printed = self.well("--nodes", 4, "--host", "./host", "--", "again", "square")
        self.assertEqual(printed, "sum 14\n" * 3 + "killed -9\nsum 14\n")

    def test_messages_to_a_node_that_is_about_to_be_loaded_again(self):
        self.well("--nodes", 3, "--host", "./host", "--", "rounds")

    def test_strict_messages_with_a_node_that_is_loaded_again(self):
        self.well("--nodes", 2, "--host", "./host", "--", "long", env=dict(ENVIRONMENT, MARS_NX_STRICT="yes"))

    def test_a_node_computes_where_one_waited_before(self):
        self.well("--nodes", 2, "--host", "./host", "--", "busy")

    def test_ends_are_told(self):
        for over in self.transports():
            done = self.run_nx("--over", over, "--nodes", 3, "./host", "./node", "ends", "code")
            self.assertEqual(sorted(done.stdout.splitlines()), [f"node {i} pid 0 code {i + 3}" for i in range(3)], done.stderr)
            self.assertNotEqual(done.returncode, 0)

    def test_a_death_is_reported_and_the_host_goes_on(self):
        done = self.run_nx("--nodes", 4, "--host", "./host", "--", "ends-and-again", "crash")
        lines = done.stdout.splitlines()
        self.assertIn("node 2 pid 0 code -11", lines)
        self.assertEqual(lines[-1], "sum 14")
        self.assertClear(done.stderr.replace("Segmentation fault", ""), "node 2 died: signal 11")
        self.assertEqual(done.returncode, 139)

    def test_killcube(self):
        for over in self.transports():
            done = self.run_nx("--over", over, "--nodes", 3, "./host", "./loop", "kill")
            self.assertEqual(done.returncode, 3, done.stderr)

    def test_failures(self):
        self.badly(1, "16 nodes is asked for, and there are 4", "--nodes", 4, "--host", "./host", "--", "more")
        self.badly(1, "too long for a cube's name", "--nodes", 4, "--host", "./host", "--", "long-name")
        self.badly(1, "load: none: there is no such program", "--nodes", 4, "--host", "./host", "--", "load", "none")
        self.badly(1, "node.c: is not a program that can be run", "--nodes", 4, "--host", "./host", "--", "load", "node.c")
        self.badly(1, "this is the host's call", "--nodes", 1, "./node", "--", "load")
        self.assertEqual(self.well("--nodes", 2, "--host", "./host", "--", "twin"), "-1 -1 -1\n")

    @needs_mpi
    def test_mpi_runs_what_it_started(self):
        done = self.run_nx("--over", "mpi", "--nodes", 2, "./host", "./loop", "load", "square")
        self.assertIn("the host, load: square: node 0 runs", done.stderr)
        self.assertNotEqual(done.returncode, 0)


class Ends(NxRun):
    def test_the_host_ends_first(self):
        for over in self.transports():
            self.assertEqual(self.well("--nodes", 2, "./host", "./node", "late", over=over), "late\n" * 2)

    def test_to_a_node_that_has_ended(self):
        self.assertEqual(self.well("--nodes", 2, "./host", "./nothing", "kill-not"), "")

    def test_a_node_crashes(self):
        for words in [["./node", "--", "crash"], ["./host", "./node", "receive", "crash"]]:
            done = self.run_nx("--over", "processes", "--nodes", 4, *words)
            self.assertEqual(done.stderr, "mars-nx: node 2 died: signal 11 (Segmentation fault)\n")
            self.assertEqual(done.returncode, 139)

    @needs_mpi
    def test_a_node_crashes_under_mpi(self):
        for words in [["./node", "--", "crash"], ["./host", "./node", "receive", "crash"]]:
            done = self.run_nx("--over", "mpi", "--nodes", 4, *words)
            self.assertEqual(done.stderr, "mars-nx: node 2 died: signal 11 (Segmentation fault)\n")
            self.assertNotEqual(done.returncode, 0)

    @needs_mpi
    def test_mpirun_says_one_line(self):
        script = self.write("unreadable", "#!/nowhere/sh\n")
        script.chmod(0o755)
        done = self.run_nx("--over", "mpi", "--nodes", 2, "./unreadable")
        self.assertClear(done.stderr, "unreadable: cannot be started on machine")
        self.assertNotEqual(done.returncode, 0)
        run = '"$0" run --over mpi --nodes 2 ./unreadable 2>log; cat log'
        self.assertIn("unreadable: cannot be started on machine", self.run_program("sh", "-c", run, MARS_NX).stdout)
        done = self.run_nx("--over", "mpi", "--nodes", 2, "./node", "--", "fail")
        self.assertClear(done.stderr, "node 0, csend: there is no node 99")

    def test_a_parent_that_ignores_the_ends_of_its_children(self):
        ignoring = ["sh", "-c", "trap '' CHLD; exec \"$@\"", "sh"]
        done = self.run_program(*ignoring, MARS_NX, "run", "--over", "processes", "--nodes", 4, "./node", "--", "leave")
        self.assertEqual(done.returncode, 4, done.stderr)

    def test_a_node_leaves_without_a_word(self):
        self.badly(4, "node 2 ended without leaving its job, with exit code 4", "--nodes", 4, "./node", "--", "leave")

    def test_nothing_can_come_any_more(self):
        for over in self.transports():
            done = self.run_nx("--over", over, "--nodes", 3, "./node", "--", "give-up")
            self.assertIn("every process waits for a message, and none is on its way; node 1 has ended with exit code 7", done.stderr)
            self.assertNotEqual(done.returncode, 0)
        self.badly(1, "every process waits for a message", "--nodes", 2, "./loop")
        self.badly(1, "every process waits for a message", "--nodes", 2, "./host", "./loop", "receive")
        self.badly(1, "every process waits for a message", "--nodes", 2, "./host", "./loop", "ends")

    def test_a_call_fails(self):
        for over in self.transports():
            done = self.run_nx("--over", over, "--nodes", 3, "./node", "--", "fail")
            self.assertIn("node 0, csend: there is no node 99", done.stderr)
            self.assertNotEqual(done.returncode, 0)
        self.badly(1, "node 0, csend: there is no node 99", "--nodes", 3, "./node", "--", "fail")

    def test_a_global_operation_fails(self):
        for over in self.transports():
            printed = sorted(self.run_nx("--over", over, "--nodes", 3, "./node", "--", "sum").stderr.splitlines())
            for node, says in enumerate(["another node's gdsum failed (", "length -1 is negative (", "another node's gdsum failed ("]):
                self.assertIn(f"printed: node {node}, gdsum: {says}", printed[node])

    def test_a_message_to_a_host_that_is_not_there(self):
        says = "node 0, csend: there is no node 1 (nodes are 0 to 0, and this job has no host"
        for over in self.transports():
            self.assertIn(says, self.run_nx("--over", over, "--nodes", 1, "./node", "--", "to-host").stderr)
            self.assertEqual(self.well("--nodes", 3, "./node", "--", "to-nobody", over=over), "-1 1\n" * 3)
        done = self.run_program(self.folder / "node", "to-host")
        self.assertClear(done.stderr, says)

    def test_too_much_under_way(self):
        little = dict(ENVIRONMENT, MARS_NX_MEMORY="64")
        self.badly(1, "all the 64 MiB that this machine's processes may use", "--nodes", 1, "./node", "--", "fill", env=little)
        self.well("--nodes", 4, "./node", "--", "reuse", env=little)

    def test_wrong_command_lines(self):
        self.badly(1, "./none: there is no such program", "--nodes", 2, "./none")
        self.badly(1, "long: there is no such program (arguments of the programs come after --)", "-n", 2, "./node", "long")
        self.badly(1, "./node.c: is not a program that can be run", "--nodes", 2, "./node.c")
        self.badly(1, "/: is a folder", "--nodes", 2, "/")
        script = self.write("unreadable", "#!/nowhere/sh\n")
        script.chmod(0o755)
        done = self.run_nx("--nodes", 1, "./unreadable")
        self.assertClear(done.stderr, "unreadable: cannot be started: No such file or directory")
        self.assertEqual(done.returncode, 1)
        for words, says in [([], "PROGRAM is required"), (["--nodes", "0", "./node"], "--nodes: '0' is not a number from 1"),
                            (["-n", "4x", "./node"], "--nodes: '4x' is no whole number"),
                            (["--nodes", "5000", "./node"], "--nodes"), (["--over", "smoke", "./node"], "not auto or processes or mpi")]:
            done = self.run_nx(*words)
            self.assertClear(done.stderr, says)
            self.assertEqual(done.returncode, 2)
        self.badly(1, "nodes are too many for this machine's", "--nodes", 64 * os.cpu_count() + 1, "./node")
        done = self.run_nx("--hostfile", "hosts", "--over", "processes", "./node")
        self.assertClear(done.stderr, "processes are all on this machine")


class Kills(NxRun):
    def test_mars_nx_is_killed(self):
        process, all_of_it = self.start_sleeping(3)
        process.kill()
        self.gone(all_of_it)

    def test_ctrl_c(self):
        for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            process, all_of_it = self.start_sleeping(3)
            process.send_signal(number)
            self.assertEqual(process.wait(PROMPT), 128 + number)
            self.assertEqual(process.stderr.read(), "")
            self.gone(all_of_it)

    def test_a_node_is_killed(self):
        process, all_of_it = self.start_sleeping(3)
        os.kill(self.pid_of(all_of_it, "node"), signal.SIGKILL)
        self.assertIn("died: signal 9", process.stderr.readline())
        os.kill(self.pid_of(all_of_it, "host"), signal.SIGKILL)
        self.assertEqual(process.wait(PROMPT), 137)
        self.gone(all_of_it)

    def test_the_host_is_killed(self):
        process, all_of_it = self.start_sleeping(3)
        os.kill(self.pid_of(all_of_it, "host"), signal.SIGKILL)
        self.assertEqual(process.stderr.readline(), "mars-nx: the host died: signal 9 (Killed)\n")
        self.assertEqual(process.wait(PROMPT), 137)
        self.gone(all_of_it)

    def test_at_any_instant(self):
        """Nodes that send for ever, one of them killed at a time of its own: the others always end at once."""
        for i in range(12):
            process = self.start("--nodes", 4, "./storm")
            wait_until(lambda: len(family(process.pid)) == 4, SECONDS, "no nodes")
            time.sleep(0.01 * i)
            all_of_it = family(process.pid)
            self.assertMemoryHasNoName([process.pid, *all_of_it])
            os.kill(list(all_of_it)[i % 4], signal.SIGKILL)
            self.assertEqual(process.wait(PROMPT), 137)
            self.assertEqual(len(process.stderr.read().splitlines()), 1)
            self.gone(all_of_it)


if __name__ == "__main__":
    main()
