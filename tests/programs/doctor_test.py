"""mars doctor, the advice of a start that fails, and the help."""

import os
import re
import shutil
import signal
import stat
import subprocess

from harness import ENVIRONMENT, EXAMPLES, PROGRAMS, ProgramTest, main, needs_mpi, wait_until


def plain(text):
    """Without the breaks of lines."""
    return " ".join(text.split())


class Doctor(ProgramTest):
    def doctor(self, *words, code=0, **environment):
        done = self.mars("doctor", *words, env=dict(ENVIRONMENT, **environment))
        self.assertEqual((done.returncode, done.stderr), (code, ""), done.stdout)
        return done.stdout

    def fake_mpirun(self, words, code=1):
        """A PATH whose first mpirun only says something on standard error."""
        fake = self.write("bin/mpirun", f"#!/bin/sh\ncase $1 in --version) echo 'mpirun (Open MPI) 4.1.4'; exit;; esac\n"
                                        f"cat >&2 <<'WORDS'\n{words}\nWORDS\nexit {code}\n")
        fake.chmod(fake.stat().st_mode | stat.S_IXUSR)
        return f"{fake.parent}:{os.environ['PATH']}"

    def setUp(self):
        super().setUp()
        (self.folder / "bin").mkdir()

    @needs_mpi
    def test_a_sound_machine(self):
        printed = self.doctor("--nodes", 2)
        for about in ["MPI", "programs", "processors", "slots", "memory", "/dev/shm", "copies", "user", "TMPDIR",
                      "ffmpeg", "OpenColorIO", "window", "a start"]:
            self.assertRegex(printed, rf"(?m)^  (ok|note) +{about} ")
        self.assertIn("2 nodes on 1 machine (mpi) booted in", plain(printed))
        self.assertIn("No trouble found", printed)

    @needs_mpi
    def test_a_start_that_fails(self):
        path = self.fake_mpirun("A call to mkdir was unable to create the desired directory:")
        printed = self.doctor(code=1, PATH=path)
        self.assertRegex(printed, r"TROUBLE +a start +Open MPI cannot write its temporary files")
        self.assertIn("set TMPDIR", printed)

    @needs_mpi
    def test_other_machines(self):
        """An ssh stands for machines: two are this one, the others are not ready."""
        ssh = self.write("bin/ssh", """#!/bin/sh
until [ "$1" = -- ]; do shift; done
case $2 in
  gone) echo "ssh: Could not resolve hostname gone: Name or service not known" >&2; exit 255;;
  bare) echo "mars: error while loading shared libraries: libpng16.so.16: cannot open shared object file" >&2; exit 127;;
esac
echo "Welcome to $2"; exec sh -c "$3"
""")
        ssh.chmod(0o755)
        self.write("hosts", "alpha slots=2\nbeta slots=2\ngone slots=2\nbare slots=2\n")
        printed = plain(self.doctor("--hostfile", "hosts", "-o", self.folder, code=1,
                                    PATH=f"{ssh.parent}:{os.environ['PATH']}"))
        for says in ["on alpha,beta ", "gone: the name does not resolve", "bare: lacks the library libpng16.so.16",
                     "3 machines answered: ",
                     "ok ports all machines reach each other by TCP", "ok clocks differ by less than 2 seconds",
                     f"ok folder {self.folder} is the same on all machines", "2 troubles"]:
            self.assertIn(says, printed)
        self.assertRegex(printed, r"ok MARS \S+, mars-node [0-9a-f]{8} ")
        self.assertNotIn("a start", printed)
        self.assertEqual(list(self.folder.glob(".mars-doctor*")), [])

    def test_machines_of_a_batch_job(self):
        ssh = self.write("bin/ssh", "#!/bin/sh\n"
                         "echo 'ssh: Could not resolve hostname: Name or service not known' >&2; exit 255\n")
        ssh.chmod(0o755)
        printed = plain(self.doctor(code=1, PATH=f"{ssh.parent}:{os.environ['PATH']}", LSB_HOSTS="alpha alpha beta"))
        self.assertIn("alpha: the name does not resolve", printed)
        self.assertIn("beta: the name does not resolve", printed)

    def test_a_signal_leaves_no_file(self):
        ssh = self.write("bin/ssh", "#!/bin/sh\nexec sleep 60\n")
        ssh.chmod(0o755)
        self.write("hosts", "alpha\n")
        for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            process = subprocess.Popen([PROGRAMS / "mars", "doctor", "--hostfile", "hosts"], cwd=self.folder,
                                       env=dict(ENVIRONMENT, PATH=f"{ssh.parent}:{os.environ['PATH']}"),
                                       stdout=subprocess.DEVNULL,
                                       preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))  # ignored under nohup
            self.addCleanup(process.kill)
            wait_until(lambda: list(self.folder.glob(".mars-doctor*")), 30, "the file")
            process.send_signal(number)
            self.assertEqual(process.wait(), -number)
            self.assertEqual(list(self.folder.glob(".mars-doctor*")), [])

    def test_other_machines_without_mpirun(self):
        for name in ["sh", "env"]:
            (self.folder / "bin" / name).symlink_to(shutil.which(name))
        ssh = self.write("bin/ssh", "#!/bin/sh\nuntil [ \"$1\" = -- ]; do shift; done\nexec sh -c \"$3\"\n")
        ssh.chmod(0o755)
        printed = plain(self.doctor("--hostfile", self.write("hosts", "alpha slots=2\n"), code=1, PATH=str(ssh.parent)))
        self.assertEqual(printed.count("TROUBLE MPI mpirun was not found"), 1)
        self.assertNotIn("a start", printed)

    def test_a_hostfile_that_names_no_host(self):
        self.fail_clearly(1, "doctor", "--hostfile", self.write("hosts", ""), says="names no host")

    def test_temporary_files_have_no_place(self):
        self.assertRegex(self.doctor(code=1, TMPDIR="/proc/nowhere"), r"TROUBLE +TMPDIR +/proc/nowhere cannot be written")

    @needs_mpi
    def test_render_prints_the_same(self):
        printed = lambda **environment: plain(self.mars("render", EXAMPLES / "teapot.json", "-o", "out", "--frames", 0,
                                                     env=dict(ENVIRONMENT, **environment)).stderr)
        self.assertIn("Open MPI cannot write its temporary files (set TMPDIR",
                      printed(PATH=self.fake_mpirun("A call to mkdir was unable to create the desired directory:")))
        unknown = printed(PATH=self.fake_mpirun("Something that nobody has seen"), TMPDIR="/proc/nowhere")
        self.assertIn("Something that nobody has seen", unknown)
        self.assertIn("TMPDIR: /proc/nowhere cannot be written", unknown)
        self.assertIn("mars doctor", unknown)


class Help(ProgramTest):
    def test_every_option_has_an_example(self):
        commands = re.findall(r"^  mars (\w+) ", self.succeed("mars"), re.MULTILINE)
        self.assertIn("doctor", commands)
        for command in sorted(set(commands)) + [""]:
            text = self.succeed("mars", *command.split(), "--help")
            options = re.split(r"\n(?=  (?:-|FILM|FILE|DIR))", text.partition("Environment")[0])[1:]
            self.assertTrue(options)
            for option in options:
                with self.subTest(command=command, option=option.split()[0]):
                    self.assertIn("Example: ", option)
            self.assertLessEqual(max(map(len, text.splitlines())), 80)

    def test_what_could_be_meant(self):
        self.fail_clearly(2, "rendre", says="did you mean 'render'?")
        self.fail_clearly(2, "render", "film.json", "--nodez", says="'--nodez' is not an option (did you mean")


if __name__ == "__main__":
    main()
