#include "host/shell/nx/run.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "hal/failure/failure.h"
#include "hal/messages/settings.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/shell/launch/asked_machines.h"
#include "host/shell/launch/command.h"
#include "host/shell/launch/session_folders.h"
#include "host/shell/nx/mpi_help.h"
#include "topology/machine.h"
#include "topology/memory_limit.h"

namespace mars::nx_jobs {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHostSetting = "MARS_NX_HOST";

// Here, or where a shell would find it.
fs::path program_file(const std::string& word, const char* remedy = "") {
  if (child::runnable(word)) return fs::absolute(word);
  if (word.find('/') == std::string::npos)
    if (const auto found = child::find_program(word, child::program_path(child::own_environment()))) return *found;
  std::error_code ignored;
  if (fs::is_directory(word, ignored)) throw Failure("is a folder, not a program", word, "");
  if (fs::exists(word, ignored))
    throw Failure("is not a program that can be run", word, "see whether it may be executed: chmod +x");
  throw Failure("there is no such program", word, remedy);
}

NxPrograms programs_of(NxRun& job) {
  NxPrograms programs;
  std::size_t used = 0;
  if (job.host || job.words.size() >= 2) programs.host = program_file(job.words[used++]);
  const char* remedy = used == 0 ? "" : "arguments of the programs come after --";
  if (used < job.words.size()) programs.node = program_file(job.words[used++], remedy);
  job.arguments.insert(job.arguments.begin(), job.words.begin() + static_cast<std::ptrdiff_t>(used), job.words.end());
  return programs;
}

// Half of what the machine has and this job may use.
std::uint64_t message_memory(const topology::Machine& machine) {
  const std::uint64_t memory = machine.memory() == 0 ? std::uint64_t{1} << 32 : machine.memory();
  const std::uint64_t limit = topology::memory_limit().least();
  return (limit == 0 ? memory : std::min(memory, limit)) / 2;
}

void check_mpi_can_start(const NxRun& job, const NxPrograms& programs) {
  if (programs.node.empty())
    throw Failure("MPI starts the nodes with the host, and no program is named for them", "",
                  "name it: mars-nx run --over mpi ./host ./node");
  if (std::find(job.arguments.begin(), job.arguments.end(), ":") != job.arguments.end())
    throw Failure("mpirun takes : for the end of a program's arguments, not for one of them", "",
                  "leave it out, or use --over processes");
}

child::Command mpi_command(const NxRun& job, const NxPrograms& programs) {
  const child::Environment environment = child::own_environment();
  const std::string path = child::program_path(environment);
  launch::Programs starters;
  starters.loopback = launch::find_loopback(child::own_file());
  starters.mpirun = launch::find_mpirun(starters.mpi, path);
  if (!starters.mpirun)
    throw launch::no_mpirun(starters.mpi, launch::asked_machines(job.hostfile, environment),
                            job.hostfile.empty() ? ", or use --over processes on this machine alone" : "");
  options::RenderOptions start;
  start.hostfile = job.hostfile;
  start.backend = options::Backend::mpi;
  launch::Surroundings surroundings = launch::look_around(path);
  start.nodes = job.nodes == 0 ? launch::default_nodes(start, surroundings) : static_cast<std::uint32_t>(job.nodes);
  surroundings.settings.emplace_back(kHostSetting);
  child::Command command = launch::mpi_start(start, starters, surroundings);
  command.environment.emplace_back(kHostSetting, programs.host.empty() ? "no" : "yes");
  const auto add = [&](std::uint32_t count, const fs::path& program) {
    launch::add_program(command, count, program, starters, surroundings);
    command.words.insert(command.words.end(), job.arguments.begin(), job.arguments.end());
  };
  if (!programs.host.empty()) {
    add(1, programs.host);
    command.words.emplace_back(":");
  }
  add(start.nodes, programs.node);
  return command;
}

int run_mpi(const NxRun& job, const NxPrograms& programs) {
  check_mpi_can_start(job, programs);
  child::Command command = mpi_command(job, programs);
  const launch::SessionFolders folders(command);
  return run_mpirun(command, !programs.host.empty());
}

bool over_mpi(const NxRun& job) {
  if (job.over == Over::processes && !job.hostfile.empty())
    throw Failure("processes are all on this machine", "", "leave out --hostfile, or use --over mpi");
  if (job.over != Over::automatic) return job.over == Over::mpi;
  const child::Environment environment = child::own_environment();
  return !job.hostfile.empty() || environment.value("SLURM_TASKS_PER_NODE").has_value() ||
         !launch::asked_machines("", environment).empty();
}

// More processes than this would keep the machine busy with changing between them.
constexpr int kNodesAProcessor = 64;

void check_nodes(int nodes, const topology::Machine& machine) {
  const int most = kNodesAProcessor * machine.processors();
  if (nodes <= most) return;
  throw Failure(std::to_string(nodes) + " nodes are too many for this machine's " +
                    std::to_string(machine.processors()) + " processors",
                "--nodes", "use at most " + std::to_string(most) + ", or more machines by --hostfile");
}

}  // namespace

int run_nx(NxRun job, const RunProcesses& run_processes) {
  const NxPrograms programs = programs_of(job);
  const messages::Settings settings = messages::read_settings();
  if (over_mpi(job)) return run_mpi(job, programs);
  const topology::Machine machine = topology::Machine::here();
  if (job.nodes == 0) job.nodes = machine.processors();
  check_nodes(job.nodes, machine);
  return run_processes(job, programs, settings.nx_memory.value_or(message_memory(machine)));
}

}  // namespace mars::nx_jobs
