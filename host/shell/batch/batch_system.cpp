#include "host/shell/batch/batch_system.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/child/programs.h"
#include "host/content/document/text.h"

namespace mars::batch {
namespace {

// The machines of the job as a hostfile, from the function `tasks`, which prints the machine of each task. No signal
// comes before the time limit, so that timeout sends one.
const std::string kByHostfile = R"(film=({timeout}mars render "$@" --hostfile "$kept/$job.hosts")
tasks | awk '!n[$1]++ {name[++k] = $1} END {for (i = 1; i <= k; ++i) print name[i] " slots=" n[name[i]]}' \
  >"$kept/$job.hosts"
are_taken() { false; }  # mars render itself goes on with the machines that answer
)";

const std::string kSubmitsAgain = R"(queue_again() { {again} >>"$kept/again"; }
)";

// Slurm's own lines are those of cluster/slurm/render.sbatch.
BatchSystem slurm() {
  return {.name = "Slurm",
          .programs = {"sbatch"},
          .folder = ".slurm",
          .script_name = "job.sbatch",
          .output = "%j.out",
          .options = {"#SBATCH --job-name=mars", "#SBATCH --nodes={nodes}", "#SBATCH --ntasks={tasks}",
                      "#SBATCH --requeue", "#SBATCH --no-kill", "#SBATCH --open-mode=append",
                      "#SBATCH --signal=B:USR1@120", "#SBATCH --time={time}", "#SBATCH --partition={partition}"},
          .setup = "",
          .submit = {"sbatch", "--parsable", "--output={output}", "{more}", "{script}"},
          .again = {},
          .list = {"squeue", "--noheader", "--jobs={jobs}",
                   "--Format=JobArrayID:|,State:|,TimeUsed:|,RestartCnt:|,NodeList:|,Reason:|"},
          .header = 0,
          .columns = {'|', 0, 1, 2, 3, 4, 5},
          .states = {},
          .ended = {},
          .unknown = {"Invalid job id"},
          .cancel = {"scancel"}};
}

// Grid Engine has programs of the same names, but no pbsnodes.
BatchSystem pbs() {
  const BatchSystem::Words submit = {"qsub", "-o", "{output}", "-j", "oe", "{more}", "{script}"};
  return {.name = "PBS",
          .programs = {"qsub", "qstat", "pbsnodes"},
          .folder = ".pbs",
          .script_name = "job.sh",
          .output = "",
          .options = {"#PBS -N mars", "#PBS -l select={nodes}:ncpus={each}:mpiprocs={each}",
                      "#PBS -l walltime={seconds}", "#PBS -q {partition}", "#PBS -r y"},
          .setup = R"(cd "$PBS_O_WORKDIR" || exit
job=film  # under one name, though each start is another job
tasks() { cat "$PBS_NODEFILE"; }
)" + kByHostfile + kSubmitsAgain,
          .submit = submit,
          .again = submit,
          .list = {"qstat", "{jobs}"},
          .header = 2,
          .columns = {' ', 0, 4, 3, -1, -1, -1},
          .states = {{"Q", "pending"}, {"R", "running"}, {"H", "held"}, {"E", "ending"}, {"W", "waiting"}},
          .ended = {"C", "F"},
          .unknown = {"nknown Job", "Job has finished"},
          .cancel = {"qdel"}};
}

// Its program reads the script from standard input.
BatchSystem lsf() {
  return {.name = "LSF",
          .programs = {"bsub", "bjobs"},
          .folder = ".lsf",
          .script_name = "job.sh",
          .output = "%J.out",
          .options = {"#BSUB -J mars", "#BSUB -n {tasks}", "#BSUB -R \"span[ptile={each}]\"", "#BSUB -W {minutes}",
                      "#BSUB -q {partition}", "#BSUB -r", "#BSUB -Q 85"},
          .setup = R"(job=$LSB_JOBID
tasks() { [ -z "$LSB_HOSTS" ] || printf '%s\n' $LSB_HOSTS; [ -n "$LSB_HOSTS" ] || cat "$LSB_DJOB_HOSTFILE"; }
)" + kByHostfile + "queue_again() { exit 85; }\n",
          .submit = {"sh", "-c", R"(script=$1; shift; exec bsub "$@" <"$script")", "bsub", "{script}", "-o", "{output}",
                     "{more}"},
          .again = {},
          .list = {"bjobs", "-noheader", "-o", "jobid stat run_time exec_host pend_reason delimiter='|'", "{jobs}"},
          .header = 0,
          .columns = {'|', 0, 1, 2, -1, 3, 4},
          .states = {{"RUN", "running"}, {"PEND", "pending"}, {"PSUSP", "held"}},
          .ended = {"DONE", "EXIT"},
          .unknown = {"is not found", "already finished", "No matching job"},
          .cancel = {"bkill"}};
}

// A job is an instance of Flux of its own; its parent queues.
BatchSystem flux() {
  return {.name = "Flux",
          .programs = {"flux"},
          .folder = ".flux",
          .script_name = "job.sh",
          .output = "{{id}}.out",
          .options = {"# flux: --job-name=mars", "# flux: --nodes={nodes}", "# flux: --nslots={tasks}",
                      "# flux: --time-limit={seconds}s", "# flux: --queue={partition}"},
          .setup = R"(job=film  # under one name, though each start is another job
tasks() {
  for host in $(flux hostlist --expand instance); do
    for ((i = 0; i < {each}; ++i)); do echo "$host"; done
  done
}
)" + kByHostfile + kSubmitsAgain,
          .submit = {"flux", "batch", "--output={output}", "{more}", "{script}"},
          .again = {"flux", "--parent", "batch", "--output={output}", "{more}", "{script}"},
          .list = {"flux", "jobs", "--no-header", "--format={id}|{state}|{runtime!F}|{nodelist}|", "{jobs}"},
          .header = 0,
          .columns = {'|', 0, 1, 2, -1, 3, -1},
          .states = {{"RUN", "running"}, {"SCHED", "pending"}},
          .ended = {"INACTIVE"},
          .unknown = {"nknown", "inactive"},
          .cancel = {"flux", "cancel"}};
}

}  // namespace

const std::vector<BatchSystem>& batch_systems() {
  static const std::vector<BatchSystem> systems = {slurm(), pbs(), lsf(), flux()};
  return systems;
}

BatchSystem batch_system_in(const std::string& path) {
  const auto is_there = [&](const BatchSystem& system) {
    return std::ranges::all_of(system.programs,
                               [&](const auto& each) { return child::find_program(each, path).has_value(); });
  };
  const auto found = std::ranges::find_if(batch_systems(), is_there);
  if (found != batch_systems().end()) return *found;
  BatchSystem::Words names;
  for (const BatchSystem& system : batch_systems()) names.push_back(system.programs.front() + " of " + system.name);
  throw Failure("no batch system was found: none of " + document::joined(names) + " is in the PATH", "",
                "use a machine from which jobs are submitted; without a batch system: mars render");
}

}  // namespace mars::batch
