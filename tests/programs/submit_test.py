"""Jobs of Slurm without Slurm: mars submit, status, watch and cancel, and the batch scripts, with programs of a few
lines in place of Slurm's; and of PBS, LSF and Flux, whose scripts run on this machine."""

import json
import shutil
import signal
import subprocess

from harness import (ENVIRONMENT, PROGRAMS, SECONDS, SOURCES, ProgramTest, SideBySide, complaints, main, needs,
                     needs_mpi, spinning_teapot, wait_until)

LONG = 20000  # frames: more than are rendered while a test looks on
SCRIPTS = [SOURCES / "cluster/slurm" / name for name in ("render.sbatch", "mpirun.sbatch", "srun.sbatch")]

SBATCH = """if [ -e refusal ]; then cat refusal >&2; exit 1; fi
for word; do script=$word; done
printf '%s\\n' "$@" >sbatch.words; cp "$script" submitted
echo '12|RUNNING|0:20|1|n[1-4]|None|' >queue; echo 12"""
SQUEUE = """if [ -s queue ]; then cat queue; exit; fi
echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1"""
SCANCEL = """echo "$@" >scancel.words; rm queue"""


class FakeSlurm(ProgramTest):
    def setUp(self):
        super().setUp()
        self.environment = dict(ENVIRONMENT, PATH=f"{self.folder}/bin:{ENVIRONMENT['PATH']}")
        (self.folder / "bin").mkdir()
        self.program("sinfo", "echo 'short|2|0/8/0/8'; echo 'main*|4|0/32/0/32'")

    def program(self, name, script):
        path = self.write(f"bin/{name}", "#!/bin/bash\n" + script + "\n")
        path.chmod(0o755)

    def read(self, name):
        return (self.folder / name).read_text()


class Commands(SideBySide, FakeSlurm):
    def setUp(self):
        super().setUp()
        for name, script in {"sbatch": SBATCH, "squeue": SQUEUE, "scancel": SCANCEL}.items():
            self.program(name, script)
        self.film = self.write("film.json", spinning_teapot(24, [64, 36]))

    def slurm(self, *words):
        return self.succeed("mars", *words, env=self.environment)

    def refused(self, code, *words, says):
        return self.fail_clearly(code, *words, says=says, env=self.environment)

    def submit(self, *words):
        return self.slurm("submit", "film.json", "-o", "out", *words)

    def test_a_job_is_submitted_followed_and_cancelled(self):
        output = self.submit("--nodes", 2, "--tasks", 8, "--time", "1:00:00", "--partition", "long", "--samples", 2,
                             "--sbatch", "--qos=high '--comment=two words'", "--sbatch", "--time=5")
        self.assertEqual(output, "job 12; follow it with: mars watch out\n")
        self.assertEqual(self.read("sbatch.words").splitlines(),
                         ["--parsable", f"--output={self.folder}/out/.slurm/%j.out", "--qos=high",
                          "--comment=two words", "--time=5", f"{self.folder}/out/.slurm/job.sbatch"])
        script = self.read("submitted")
        for line in ["#SBATCH --nodes=2", "#SBATCH --ntasks=8", "#SBATCH --time=1:00:00", "#SBATCH --partition=long",
                     "#SBATCH --requeue", "# mars submit calls sbatch with: --qos=high '--comment=two words' --time=5",
                     "set -- film.json -o out --kept-film --samples 2"]:
            self.assertIn(f"\n{line}\n", script)
        self.assertEqual(self.slurm("status", "out"),
                         "out: 0 of 24 frames of film.json\njob 12: running on n[1-4] for 0:20, 1 restart\n")
        self.assertEqual(self.slurm("cancel", "out"), "job 12 has ended\nout: 0 of 24 frames of film.json\n")
        self.assertEqual(self.read("scancel.words"), "12\n")
        self.assertEqual(self.slurm("cancel", "out"), "no job is left to cancel\nout: 0 of 24 frames of film.json\n")

    def test_the_script_is_the_one_of_the_cluster_folder(self):
        printed = self.submit("--print")
        self.assertFalse((self.folder / "out").exists())
        ours = [line for line in printed.splitlines() if not line.startswith(("export PATH=", "kept=", "set -- "))]
        self.assertEqual(ours, SCRIPTS[0].read_text().splitlines())
        subprocess.run(["bash", "-n"], input=printed, text=True, check=True)

    def test_an_array_is_cut_into_equal_work(self):
        film = spinning_teapot(24, [64, 36])
        first, last = film["actors"][0]["keys"]
        film["actors"][0]["keys"] = [dict(first, frame=0), dict(last, frame=8), dict(first, frame=16),
                                     dict(last, frame=24)]
        self.write("film.json", film)
        output = self.submit("--array", 3, "--intervals", "keyframes", "--sbatch", "--array=0-2%2")
        self.assertIn("job 12, 3 tasks;", output)
        self.assertIn("\nframes=(0-7 8-15 16-23)\n", self.read("submitted"))
        self.assertIn("%A_%a.out\n--array=0-2%2\n", self.read("sbatch.words"))
        submit = ["submit", "film.json", "-o", "out"]
        done = self.run_program("mars", *submit, "--array", 9, "--print", env=self.environment)
        self.assertIn("8 jobs instead of 9", done.stderr)
        self.assertIn("\nframes=(0-2 3-5 6-8 9-11 12-14 15-17 18-20 21-23)\n", done.stdout)
        self.refused(2, *submit, "--array", 2, "--report", "r", says="cannot share one file")
        self.refused(2, *submit, "--sbatch", "--array=0-9", says="add --array N of mars submit")

    def test_what_cannot_be_submitted(self):
        submit = ["submit", "film.json", "-o", "out"]
        self.refused(2, "submit", "film.json", says="add -o DIR")
        self.refused(2, *submit, "--time", "1 day", says="'1 day' is not one word")
        self.refused(2, *submit, "--tasks", 1, says="--tasks")
        self.refused(2, *submit, "--sbatch", "--comment='two words", says="the quotation mark ' is not closed")
        self.refused(2, *submit, "--sbatch", "--qos=long\ntouch x", says="more than one line")
        self.refused(1, "submit", "none.json", "-o", "out", says="none.json")
        self.write("refusal", "sbatch: error: invalid partition specified: nix\n")
        self.refused(1, *submit, says="sbatch failed: sbatch: error: invalid partition specified: nix")
        (self.folder / "bin/sbatch").unlink()
        self.environment["PATH"] = f"{self.folder}/bin"
        self.refused(1, *submit, says="no batch system was found: none of sbatch of Slurm, qsub of PBS")

    def test_what_a_program_asks_for(self):
        self.write("modules.sh", "module load gcc\n")
        self.assertEqual(self.submit("--parsable", "--prologue", "modules.sh"), "12\n")
        script = self.read("submitted")
        self.assertLess(script.index("\nmodule load gcc\n"), script.index("\nunset SLURM_EXPORT_ENV\n"))
        self.refused(2, "submit", "film.json", "-o", "out", "--prologue", "none.sh", says="none.sh")
        self.succeed("mars", "render", "film.json", "-o", "out", "--backend", "threads", "--quiet")
        state = json.loads(self.slurm("status", "out", "--json"))
        self.assertEqual((state["state"], state["frames"]), ("complete", {"done": 24, "of": 24}))
        self.assertEqual([job["job"] for job in state["jobs"]], ["12"])
        written = sum(path.stat().st_size for path in (self.folder / "out").glob("*.png"))
        self.assertEqual((state["usage"]["bytes"], state["usage"]["restarts"]), (written, 0))
        self.assertGreater(state["usage"]["processor_hours"], 0)
        metrics = self.slurm("status", "out", "--metrics")
        self.assertIn(f'mars_written_bytes{{folder="{self.folder}/out"}} {written}\n', metrics)
        self.assertTrue(metrics.endswith("# EOF\n"))
        self.assertRegex(self.slurm("status", "out", "--comment"),
                         r"^mars: 24 of 24 frames, [0-9.]+ processor [a-z]+, [0-9.]+ MB written, 0 restarts\n$")
        self.refused(2, "status", "out", "--json", "--comment", says="--comment")

    def test_a_prologue_that_bash_cannot_read(self):
        for code, text, says in [(1, b"if true; then\n", "line "), (1, b"fi \x01\xff(\n", "line "),
                                 (2, b"true\nmodule load gcc\r\n", "line 2 ends with CR LF"),
                                 (2, b"\x7fELF\0", "line 1 is no text")]:
            (self.folder / "odd.sh").write_bytes(text)
            self.refused(code, "submit", "film.json", "-o", "out", "--prologue", "odd.sh", says=says)
            self.assertFalse((self.folder / "out/.slurm").exists() or (self.folder / "submitted").exists(), text)

    def test_what_may_never_come_to_a_frame_is_said_before(self):
        submit = lambda *words: self.run_program("mars", "submit", "film.json", "-o", "out", *words,
                                                 env=self.environment).stderr
        self.assertClear(submit("--time", 1), "the time limit 1 is 60 seconds")
        self.assertClear(submit("--tasks", 33), "the partition main has 4 machines with 32 processors, and the job "
                         "asks for 4 machines and 33 tasks")
        self.assertClear(submit("--partition", "short"), "the partition short has 2 machines")
        self.environment["SBATCH_PARTITION"] = "short"
        self.assertClear(submit("--nodes", 3, "--tasks", 8), "the partition short has 2 machines")
        self.assertEqual(submit("--nodes", 2, "--tasks", 8, "--time", 10), "")
        self.assertEqual(submit("--sbatch", "-p other"), "")

    def test_a_folder_of_another_film(self):
        render = ["render", "--backend", "threads", "--quiet", "-o", "out"]
        self.succeed("mars", *render, "film.json")
        self.submit()
        self.write("other.json", dict(spinning_teapot(23, [64, 36]), background=[1, 0, 0]))
        for more in [[], ["--print"]]:
            self.refused(1, "submit", "other.json", "-o", "out", *more,
                         says="out: the frames in this folder are of another film, film.json")
        self.assertEqual(self.slurm("submit", "other.json", "-o", "out", "--overwrite").splitlines()[-1],
                         "job 12; follow it with: mars watch out")
        self.assertNotIn("--overwrite", self.read("submitted"))
        self.assertEqual(self.slurm("status", "out").splitlines()[0], "out: 0 of 23 frames of other.json")

    def test_a_run_without_slurm(self):
        self.refused(1, "status", "out", says="no folder of frames")
        self.write("film.json", spinning_teapot(LONG, [160, 90]))
        process = self.start_mars("render", "film.json", "-o", "out", "--backend", "threads", "--nodes", 2)
        wait_until(lambda: " left\n" in self.slurm("status", "out"), SECONDS, "no status of frames")
        self.assertRegex(self.slurm("status", "out"), rf"out: \d+ of {LONG} frames of film.json\n"
                         rf"used: .* processor [a-z]+, .* written, 0 restarts\n"
                         rf"run on .* \(process \d+\): frame \d+ of {LONG}, .* left\n  .*  2 nodes, \d+ frames\n$")
        self.refused(1, "cancel", "out", says="no job was submitted for this folder")
        process.send_signal(signal.SIGTERM)
        process.wait(SECONDS)
        self.assertRegex(self.slurm("status", "out"), r"frames of film.json\nused: .* written, 1 restart\n$")
        done = self.run_program("mars", "watch", "out")
        self.assertEqual(done.returncode, 1)
        self.assertClear(done.stderr, "nothing renders here, and frames are missing")

    def test_a_complete_film_is_not_waited_for(self):
        self.succeed("mars", "render", "film.json", "-o", "out", "--backend", "threads", "--quiet")
        self.assertEqual(self.slurm("watch", "out"), "out: 24 of 24 frames of film.json, complete\n")

    @needs("ffmpeg", "ffprobe")
    def test_a_video_alone(self):
        """Its working folder is MARS's from then on, so that the job may enter it."""
        self.succeed("mars", "submit", "film.json", "-o", "film.mp4", env=self.environment)
        self.assertTrue((self.folder / "film.mp4.mars-work" / "made-by-mars").exists())
        self.succeed("mars", "render", "film.json", "-o", "film.mp4", "--kept-film", "--backend", "threads", "--quiet")
        self.assertTrue((self.folder / "film.mp4").exists())

    def test_a_queue_that_does_not_answer(self):
        self.submit()
        self.program("squeue", "echo 'squeue: error: timed out' >&2; exit 1")
        self.assertIn("jobs are unknown: squeue failed: squeue: error: timed out\n", self.slurm("status", "out"))
        self.refused(1, "cancel", "out", says="squeue failed: squeue: error: timed out")

    def test_a_queue_that_hangs_can_be_left(self):
        self.submit()
        self.program("squeue", "touch begun; exec sleep 1000")
        for command in ["status", "watch", "cancel"]:
            process = subprocess.Popen([PROGRAMS / "mars", command, "out"], env=self.environment, cwd=self.folder,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.addCleanup(self.end, process)
            wait_until((self.folder / "begun").exists, SECONDS, "squeue does not begin")
            process.send_signal(signal.SIGTERM)
            said = process.communicate(timeout=SECONDS)[1]
            self.assertClear(said, "stopped by Terminated")
            (self.folder / "begun").unlink()


class Jobs(SideBySide, FakeSlurm):
    """What sbatch was given, run as Slurm runs it, on a machine without MPI."""

    def setUp(self):
        super().setUp()
        self.program("sbatch", SBATCH)
        for name in ["find", "rm", "wc"]:
            (self.folder / "bin" / name).symlink_to(shutil.which(name))
        self.film = self.write("film.json", spinning_teapot(24, [64, 36]))
        self.succeed("mars", "render", "film.json", "-o", "whole", "--backend", "threads", "--quiet")

    def submit(self, *words):
        return self.succeed("mars", "submit", "film.json", "-o", "out", *words, env=self.environment)

    def run_job(self, **slurm):
        environment = dict(ENVIRONMENT, PATH=f"{self.folder}/bin", SLURM_JOB_ID="12", SLURM_JOB_NUM_NODES="1",
                           SLURM_NTASKS="2", **slurm)
        done = subprocess.run(["/bin/bash", "submitted"], cwd=self.folder, env=environment, capture_output=True,
                              text=True, timeout=SECONDS)
        self.assertEqual((done.returncode, complaints(done.stderr)), (0, ""), done.stdout)

    def test_what_was_submitted_is_rendered(self):
        self.submit()
        whole = self.film.read_text()
        self.film.unlink()
        self.run_job()
        for restarts, text in enumerate([whole.replace('"frame": 24', '"frame": 30'), whole[:100]], 1):
            self.film.write_text(text)
            (self.folder / "out/frame-0007.png").unlink()
            self.run_job(SLURM_RESTART_COUNT=str(restarts))
        self.assertEqual(self.verified_hash("out"), self.verified_hash("whole"))

    def test_an_array_of_one_interval(self):
        self.assertIn("job 12, 3 tasks", self.submit("--array", 3))
        self.film.unlink()
        for task in range(3):
            self.run_job(SLURM_ARRAY_JOB_ID="10", SLURM_ARRAY_TASK_ID=str(task))
        self.assertEqual(self.verified_hash("out"), self.verified_hash("whole"))


class Scripts(SideBySide, FakeSlurm):
    """What a batch script does with its film's end and with signals."""

    def setUp(self):
        super().setUp()
        for name in ["mars", "mpirun"]:
            self.program(name, "trap 'echo term >terminated; sleep 0.2; exit 1' TERM; echo \"$@\" >words; touch begun\n"
                         "[ -e go ] || exit $(cat code)\n"
                         "while :; do sleep 0.05; done")
        self.program("mars-host", "")
        self.program("mars-node", "")
        self.program("srun", "[ \"$SLURM_EXPORT_ENV\" != NONE ] || exit 1\n"  # without PATH
                     "case $* in *--multi-prog*) exec mars $(<${!#});; *--relative*) ;; *) exit $(cat machines);; esac")
        self.program("scontrol", "case $1 in show) cat job;; *) echo \"$@\" >>requeued;; esac")
        self.write("job", "JobId=12 PreemptTime=None\n")
        self.write("machines", "0")
        self.job = dict(self.environment, SLURM_JOB_ID="12", SLURM_JOB_NUM_NODES="2", SLURM_NTASKS="4",
                        SLURMD_NODENAME="n1")

    def start(self, script):
        for name in ["begun", "terminated", "requeued"]:
            (self.folder / name).unlink(missing_ok=True)
        process = subprocess.Popen(["bash", script, "film.json", "-o", "out"], env=self.job, cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        wait_until((self.folder / "begun").exists, SECONDS, "it does not begin")
        return process

    def end_of(self, script):
        """Its exit code, and what it asked of scontrol."""
        process = self.start(script)
        code = process.wait(SECONDS)
        self.said = process.stderr.read()
        requeued = self.folder / "requeued"
        return code, requeued.read_text() if requeued.exists() else ""

    def after(self, script, *signals):
        self.write("go", "")
        process = self.start(script)
        for each in signals:
            process.send_signal(each)
        wait_until((self.folder / "terminated").exists, SECONDS, "the job of the film did not receive TERM")
        code = process.wait(SECONDS)
        (self.folder / "go").unlink()
        return code, self.read("requeued") if (self.folder / "requeued").exists() else ""

    def test_they_share_what_they_do_at_the_end(self):
        ends = {script.read_text().partition("# From here on")[2] for script in SCRIPTS}
        self.assertEqual(len(ends), 1)
        self.assertGreater(len(ends.pop()), 500)

    def test_a_film_that_ends(self):
        for script in SCRIPTS:
            with self.subTest(script.name):
                for code in ["0", "1", "2"]:
                    self.write("code", code)
                    self.assertEqual(self.end_of(script), (int(code), ""))

    def test_a_job_that_is_queued_again_takes_the_folders_film(self):
        self.write("code", "0")
        for restarts in [{}, {"SLURM_RESTART_COUNT": "1"}]:
            self.job.update(restarts)
            for script in SCRIPTS:
                self.end_of(script)
                self.assertEqual("-o out --kept-film" in self.read("words"), bool(restarts), script)

    def test_a_lost_machine(self):
        self.write("code", "1")
        self.write("machines", "1")
        for script in SCRIPTS:
            self.assertEqual(self.end_of(script), (0, "requeue 12\n"), script)

    def test_a_job_that_does_not_hand_its_environment_on(self):
        """As sbatch --export=NONE starts it: no machine is lost because of that."""
        self.write("code", "1")
        self.job["SLURM_EXPORT_ENV"] = "NONE"
        for script in SCRIPTS:
            self.assertEqual(self.end_of(script), (1, ""), script)

    def test_starts_without_a_new_frame_end(self):
        self.write("code", "1")
        self.write("machines", "1")
        (self.folder / "out").mkdir()
        for number, script in enumerate(SCRIPTS):
            self.job["SLURM_JOB_ID"] = str(number)
            self.assertEqual([self.end_of(script)[0] for _ in range(6)], [0] * 5 + [1], script)
            self.assertIn("its starts bring no new frame (restarts in a row without one: 5;", self.said)
            self.write(f"out/frame-{number:04}.png", "")
            self.assertEqual(self.end_of(script), (0, f"requeue {number}\n"), script)

    def test_preemption_with_a_time_of_grace(self):
        self.write("code", "1")
        self.write("job", "JobId=12 PreemptTime=2026-11-22T19:07:11\n")
        for script in SCRIPTS:
            self.assertEqual(self.end_of(script), (0, "requeue 12\n"), script)

    def test_the_time_limit(self):
        for script in SCRIPTS:
            self.assertEqual(self.after(script, signal.SIGUSR1), (0, "requeue 12\n"), script)
        self.job.update(SLURM_ARRAY_JOB_ID="10", SLURM_ARRAY_TASK_ID="3")
        self.assertEqual(self.after(SCRIPTS[0], signal.SIGUSR1), (0, "requeue 10_3\n"))

    def test_scancel(self):
        for script in SCRIPTS:
            self.assertEqual(self.after(script, signal.SIGTERM), (1, ""), script)


QSTAT = """echo 'Job id            Name             User              Time Use S Queue'
echo '----------------  ---------------- ----------------  -------- - -----'
echo '1.pbs             mars             ada               00:00:20 R workq'"""
NUMBERED = "PATH=/usr/bin:/bin; for script; do :; done; printf '%s\\n' \"$@\" >words; cp \"$script\" submitted; " \
           "echo >>jobs; "
OTHERS = {
    "pbs": ({"qsub": NUMBERED + 'echo "$(wc -l <jobs).pbs"', "qstat": QSTAT, "pbsnodes": ""},
            {"PBS_JOBID": "1.pbs", "PBS_NODEFILE": "tasks", "PBS_O_WORKDIR": "."}, "1.pbs", "running for 00:00:20"),
    "lsf": ({"bsub": "PATH=/usr/bin:/bin; printf '%s\\n' \"$@\" >words; cat >submitted; "
                     "echo 'Job <1> is submitted to queue <normal>.'",
             "bjobs": "echo '1|RUN|20 second(s)|3*n1|-|'"},
            {"LSB_JOBID": "1", "LSB_HOSTS": "localhost localhost localhost"}, "1", "running on 3*n1 for 20 second(s)"),
    "flux": ({"flux": "case $1 in hostlist) echo localhost; exit;; jobs) echo 'f1|RUN|20s|n1|'; exit;; esac; "
                      + NUMBERED + 'echo "f$(wc -l <jobs)"'}, {}, "f1", "running on n1 for 20s")}


@needs_mpi
class OtherSystems(SideBySide, FakeSlurm):
    """What qsub, bsub and flux were given, run as their systems run it."""

    def submit(self, system, film, *words):
        """The answer, without a look for Slurm's programs of this machine."""
        programs, *_ = OTHERS[system]
        for name, script in programs.items():
            self.program(name, script)
        if not (self.folder / "bin/sh").exists():
            (self.folder / "bin/sh").symlink_to(shutil.which("sh"))
        self.environment["PATH"] = f"{self.folder}/bin"
        self.write("tasks", "localhost\n" * 3)
        self.write("film.json", film)
        return self.run_program("mars", "submit", "film.json", "-o", system, "--nodes", 1, "--tasks", 3, *words,
                                env=self.environment)

    def run_job(self, system):
        environment = dict(ENVIRONMENT, PATH=f"{self.folder}/bin:{ENVIRONMENT['PATH']}", **OTHERS[system][1])
        return subprocess.run(["/bin/bash", "submitted"], cwd=self.folder, env=environment, capture_output=True,
                              text=True, timeout=SECONDS)

    def remove_programs(self):
        for name in [name for programs, *_ in OTHERS.values() for name in programs]:
            (self.folder / "bin" / name).unlink(missing_ok=True)
        (self.folder / "jobs").unlink(missing_ok=True)

    def test_a_film(self):
        film = spinning_teapot(12, [64, 36])
        self.write("film.json", film)
        self.succeed("mars", "render", "film.json", "-o", "whole", "--backend", "threads", "--quiet")
        for system, (_, _, number, running) in OTHERS.items():
            with self.subTest(system):
                done = self.submit(system, film, "--sbatch", "-P physics")
                self.assertEqual((done.stdout, done.stderr),
                                 (f"job {number}; follow it with: mars watch {system}\n", ""))
                self.assertIn("-P\nphysics\n", self.read("words"))
                self.assertIn(f"job {number}: {running}\n",
                              self.succeed("mars", "status", system, env=self.environment))
                done = self.run_job(system)
                self.assertEqual((done.returncode, complaints(done.stderr)), (0, ""), done.stdout)
                self.assertEqual(self.verified_hash(system), self.verified_hash("whole"))
                self.remove_programs()

    def test_a_time_limit(self):
        """Two seconds after its start, which is two minutes before its limit, the job queues itself again."""
        for system, code, jobs in [("pbs", 0, ["1.pbs", "2.pbs"]), ("lsf", 85, ["1"]), ("flux", 0, ["f1", "f2"])]:
            with self.subTest(system):
                self.assertClear(self.submit(system, spinning_teapot(LONG, [160, 90]), "--time", "2:02").stderr,
                                 "the time limit 2:02 is 122 seconds")
                self.assertEqual(self.run_job(system).returncode, code)
                again = self.folder / system / f".{system}/again"
                self.assertEqual(again.read_text().split() if again.exists() else [], jobs[1:])
                self.remove_programs()

    def test_what_others_do_not_have(self):
        film = spinning_teapot(12, [64, 36])
        self.assertClear(self.submit("lsf", film, "--array", 2).stderr, "only Slurm gets an array of jobs from mars")
        self.assertClear(self.submit("lsf", film, "--time", "soon").stderr, "'soon' is not a time such as 8:00:00, which LSF needs")


if __name__ == "__main__":
    main()
