#include "host/shell/batch/batch_script.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"

namespace mars::batch {
namespace {

constexpr const char* kTemplate = R"(#!/bin/bash
#SBATCH --nodes=4
#SBATCH --signal=B:USR1@120
# Renders.
film=(mars render "$@")
queue_again() { scontrol requeue 12; }

# From here on the scripts of all batch systems are the same. They end.
exit
)";

const BatchSystem& slurm() { return batch_systems()[0]; }
const BatchSystem& pbs() { return batch_systems()[1]; }
const BatchSystem& lsf() { return batch_systems()[2]; }
const BatchSystem& flux() { return batch_systems()[3]; }

BatchJob some_job() {
  BatchJob job;
  job.words = {"film.json", "-o", "out"};
  job.programs = "/opt/mars/bin";
  job.kept = "/films/out/.slurm";
  return job;
}

std::string script_of(const BatchJob& job, const BatchSystem& system = slurm()) {
  return batch_script(system, kTemplate, job);
}

void expect_in(const std::string& script, const std::string& text) {
  EXPECT_TRUE(document::holds(script, text)) << text << "\nis not in\n" << script;
}

TEST(BatchScript, HasTheOptionsThatAreGiven) {
  BatchJob job = some_job();
  job.machines = 2;
  job.time = "1:00";
  EXPECT_EQ(script_of(job), R"(#!/bin/bash
#SBATCH --job-name=mars
#SBATCH --nodes=2
#SBATCH --ntasks=32
#SBATCH --requeue
#SBATCH --no-kill
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@120
#SBATCH --time=1:00
# Renders.
export PATH=/opt/mars/bin:$PATH
kept=/films/out/.slurm
set -- film.json -o out
film=(mars render "$@")
queue_again() { scontrol requeue 12; }

# From here on the scripts of all batch systems are the same. They end.
exit
)");
}

TEST(BatchScript, QuotesWhatAShellWouldReadOtherwise) {
  BatchJob job = some_job();
  job.words = {"my film.json", "-o", "it's"};
  job.programs = "/a b";
  expect_in(script_of(job), "export PATH='/a b':$PATH\n");
  expect_in(script_of(job), "set -- 'my film.json' -o ");
}

TEST(BatchScript, GivesEachTaskOfAnArrayItsFrames) {
  BatchJob job = some_job();
  job.parts = {film::FrameSet("0-9"), film::FrameSet("10-30,40")};
  expect_in(script_of(job), "#SBATCH --array=0-1\n");
  expect_in(script_of(job),
            "frames=(0-9 10-30,40)\nset -- film.json -o out --frames \"${frames[SLURM_ARRAY_TASK_ID]}\"\n");
}

TEST(BatchScript, OfOnePartIsNoArray) {
  BatchJob job = some_job();
  job.parts = {film::FrameSet("0-9")};
  EXPECT_FALSE(document::holds(script_of(job), "array"));
  expect_in(script_of(job), "set -- film.json -o out --frames 0-9\n");
}

TEST(BatchScript, BeginsWithThePrologue) {
  BatchJob job = some_job();
  job.more = {"--qos=high", "--comment=two words"};
  job.prologue = "module load gcc";
  expect_in(script_of(job),
            "USR1@120\n# mars submit calls sbatch with: --qos=high '--comment=two words'\n"
            "module load gcc\n# Renders.\n");
}

TEST(BatchScript, IsOneThatBashReadsToItsEnd) {
  const auto failure = [](const std::string& script) { return document::failure_of([&] { check_script(script); }); };
  EXPECT_EQ(failure("#!/bin/bash\nexit 1\n"), "");
  expect_in(failure("if true; then\n  exit\n"), "bash cannot read the batch script: line 3: syntax error");
  expect_in(failure("cat <<END\n"), "here-document");
  expect_in(failure("echo\nfi \x01\xff(\n"), "line 2: ");
}

TEST(BatchScript, HasTheWordsOfEachSystem) {
  BatchJob job = some_job();
  job.kept = "/films/out/.pbs";
  job.tasks = 30;
  job.time = "8:00:00";
  job.partition = "long";
  job.more = {"-A", "physics"};
  const std::string of_pbs = script_of(job, pbs());
  expect_in(of_pbs,
            "#!/bin/bash\n#PBS -N mars\n#PBS -l select=4:ncpus=8:mpiprocs=8\n#PBS -l walltime=28800\n"
            "#PBS -q long\n#PBS -r y\n# mars submit calls qsub with: -A physics\n");
  expect_in(of_pbs,
            "film=(timeout --foreground --signal=TERM 28680 mars render \"$@\" --hostfile \"$kept/$job.hosts\")\n");
  expect_in(of_pbs,
            "queue_again() { qsub -o /films/out/.pbs/ -j oe -A physics /films/out/.pbs/job.sh >>\"$kept/again\"; "
            "}\n");
  expect_in(of_pbs, "They end.\nexit\n");
  expect_in(script_of(job, lsf()), "#BSUB -n 30\n#BSUB -R \"span[ptile=8]\"\n#BSUB -W 480\n#BSUB -q long\n");
  expect_in(script_of(job, flux()), "# flux: --nodes=4\n# flux: --nslots=30\n# flux: --time-limit=28800s\n");
  job.time = job.partition = "";
  EXPECT_FALSE(document::holds(script_of(job, lsf()), "#BSUB -W"));
  expect_in(script_of(job, lsf()), "film=(mars render ");
}

// The tests of programs may run as root, who can write into any folder.
TEST(BatchScript, NamesItsFolderBeforeItWritesThere) {
  for (const BatchSystem& system : batch_systems()) {
    const std::string script = script_of(some_job(), system);
    EXPECT_LT(script.find("kept=/films"), script.find("$kept")) << system.name;
  }
}

TEST(BatchScript, IsSubmittedByTheSystemsProgram) {
  using Words = std::vector<std::string>;
  BatchJob job = some_job();
  job.kept = "/50%/.slurm";
  job.more = {"--qos=high"};
  EXPECT_EQ(submit_words(slurm(), job),
            (Words{"sbatch", "--parsable", "--output=/50%%/.slurm/%j.out", "--qos=high", "/50%/.slurm/job.sbatch"}));
  job.parts = {film::FrameSet("0"), film::FrameSet("1")};
  EXPECT_EQ(submit_words(slurm(), job)[2], "--output=/50%%/.slurm/%A_%a.out");
  EXPECT_EQ(submit_words(flux(), job),
            (Words{"flux", "batch", "--output=/50%/.slurm/{{id}}.out", "--qos=high", "/50%/.slurm/job.sh"}));
}

TEST(BatchScript, KnowsTheTimesOfSbatch) {
  EXPECT_EQ(seconds_of("90"), 5400u);
  EXPECT_EQ(seconds_of("1:30"), 90u);
  EXPECT_EQ(seconds_of("8:00:05"), 28805u);
  EXPECT_EQ(seconds_of("2-0"), 172800u);
  EXPECT_EQ(seconds_of("1-12:30"), 131400u);
  for (const char* text : {"", "soon", "1:", "2-", "-1", "1:2:3:4", "UNLIMITED"})
    EXPECT_EQ(seconds_of(text), std::nullopt) << text;
}

TEST(BatchSystem, ThatIsNowhereIsAFailure) {
  EXPECT_TRUE(document::holds(document::failure_of([] { batch_system_in("/nowhere"); }),
                              "none of sbatch of Slurm, qsub of PBS, bsub of LSF, flux of Flux is in the PATH"));
}

}  // namespace
}  // namespace mars::batch
