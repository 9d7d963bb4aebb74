// mars-nx: starts programs that are written for NX: one host and its nodes, or nodes alone.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/processes/job.h"
#include "hal/messages/settings.h"
#include "host/shell/launch/command.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/child/exec.h"
#include "host/shell/launch/session_folders.h"
#include "host/shell/options/command_line.h"
#include "topology/machine.h"
#include "topology/memory_limit.h"

namespace mars::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHostSetting = "MARS_NX_HOST";

constexpr const char* kWayIn = R"(Runs programs that are written for NX, the message passing of the iPSC/2.

  mars-nx run --nodes 8 ./node           eight nodes
  mars-nx run --nodes 8 ./host ./node    one host and eight nodes
  mars-nx run --nodes 8 --host ./host    a host that loads its nodes itself
  mars-nx run --help                     every option, with an example
)";

constexpr const char* kStarts =
    R"(What follows -- goes to every program as its arguments; after two programs the --
can be left out. The nodes of a host begin when it loads them, when it sends or
receives for the first time, or when it has ended. What the programs write is
what mars-nx writes; the host reads its input, without a host node 0 does.

When a program dies, the others' message calls fail, unless the host kills and
loads the nodes again. Where every process waits for a message and none is on
its way, all fail over processes; over MPI they do once a process has ended with
a code above 0, else they wait for ever: MARS_NX_STRICT=yes prints
who waits.
Nothing is left behind, however mars-nx ends.

Exit codes: the highest of all programs', 128 and the signal for one that died
of it, 1 where a message call failed; 2 the command line is wrong.
)";

enum class Over { automatic, processes, mpi };

Over over_of(const std::string& word) {
  if (word == "auto") return Over::automatic;
  if (word == "processes") return Over::processes;
  if (word == "mpi") return Over::mpi;
  throw CLI::ValidationError("--over", "'" + word + "' is not auto or processes or mpi");
}

struct RunOptions {
  int nodes = 0;  // 0: one a processor, or the slots of the hostfile or the batch system
  bool host = false;
  Over over = Over::automatic;
  std::string hostfile;
  std::vector<std::string> words;
  std::vector<std::string> arguments;
};

// Here, or where a shell would find it.
fs::path program_file(const std::string& word, const char* remedy = "") {
  if (runnable(word)) return fs::absolute(word);
  if (word.find('/') == std::string::npos)
    if (const auto found = find_program(word, program_path(own_environment()))) return *found;
  std::error_code ignored;
  if (fs::is_directory(word, ignored)) throw Failure("is a folder, not a program", word, "");
  if (fs::exists(word, ignored))
    throw Failure("is not a program that can be run", word, "see whether it may be executed: chmod +x");
  throw Failure("there is no such program", word, remedy);
}

struct NxPrograms {
  fs::path host;  // empty: none
  fs::path node;  // likewise
};

NxPrograms programs_of(RunOptions& options) {
  NxPrograms programs;
  std::size_t used = 0;
  if (options.host || options.words.size() >= 2) programs.host = program_file(options.words[used++]);
  const char* remedy = used == 0 ? "" : "arguments of the programs come after --";
  if (used < options.words.size()) programs.node = program_file(options.words[used++], remedy);
  options.arguments.insert(options.arguments.begin(),
                           options.words.begin() + static_cast<std::ptrdiff_t>(used), options.words.end());
  return programs;
}

// In its own process; returns where it cannot.
int become_program(const fs::path& file, const std::vector<std::string>& arguments, bool reads) try {
  if (!reads && std::freopen("/dev/null", "r", stdin) == nullptr) return kFailed;
  Command command{{}, {file.string()}};
  command.words.insert(command.words.end(), arguments.begin(), arguments.end());
  become(command);
} catch (const Failure& failure) {
  std::cerr << "mars-nx: " << failure.what() << '\n';
  return kFailed;
}

int run_processes(const RunOptions& options, const NxPrograms& programs, std::uint64_t limit) {
  hal::JobPlan plan;
  plan.nodes = options.nodes;
  plan.host = !programs.host.empty();
  if (plan.host) plan.begin = programs.node.empty() ? hal::JobPlan::Begin::never : hal::JobPlan::Begin::later;
  plan.limit = limit;
  plan.become = [&](const hal::Place& place, const std::string& file) {
    const bool host = plan.host && place.index == options.nodes;
    hal::leave_place(place);
    const fs::path& program = host ? programs.host : file.empty() ? programs.node : fs::path(file);
    return become_program(program, options.arguments, plan.host ? host : place.index == 0);
  };
  plan.report = [](const std::string& line) { std::cerr << "mars-nx: " << line << std::endl; };
  return hal::Job(plan).run();
}

// Half of what the machine has and this job may use.
std::uint64_t message_memory(const topology::Machine& machine) {
  const std::uint64_t memory = machine.memory() == 0 ? std::uint64_t{1} << 32 : machine.memory();
  const std::uint64_t limit = topology::memory_limit().least();
  return (limit == 0 ? memory : std::min(memory, limit)) / 2;
}

void check_mpi_can_start(const RunOptions& options, const NxPrograms& programs) {
  if (programs.node.empty())
    throw Failure("MPI starts the nodes with the host, and no program is named for them", "",
                  "name it: mars-nx run --over mpi ./host ./node");
  if (std::find(options.arguments.begin(), options.arguments.end(), ":") != options.arguments.end())
    throw Failure("mpirun takes : for the end of a program's arguments, not for one of them", "",
                  "leave it out, or use --over processes");
}

// mpirun as it begins, and how many nodes it starts.
Command mpi_start_of(const RunOptions& options, const NxPrograms& programs, std::uint32_t& nodes) {
  const std::string path = program_path(own_environment());
  Programs starters;
  starters.loopback = find_loopback(fs::read_symlink("/proc/self/exe"));
  starters.mpirun = find_mpirun(starters.mpi, path);
  if (!starters.mpirun)
    throw Failure("mpirun was not found", "",
                  "install Open MPI (Debian: openmpi-bin), or use --over processes");
  RenderOptions start;
  start.hostfile = options.hostfile;
  start.backend = Backend::mpi;
  Surroundings surroundings = look_around(path);
  start.nodes = nodes =
      options.nodes == 0 ? default_nodes(start, surroundings) : static_cast<std::uint32_t>(options.nodes);
  surroundings.settings.emplace_back(kHostSetting);
  Command command = mpi_start(start, starters, surroundings);
  command.environment.emplace_back(kHostSetting, programs.host.empty() ? "no" : "yes");
  return command;
}

// Becomes mpirun: its output, its end and the signals it is sent are its own.
[[noreturn]] void run_mpi(const RunOptions& options, const NxPrograms& programs) {
  check_mpi_can_start(options, programs);
  std::uint32_t nodes = 0;
  Command command = mpi_start_of(options, programs, nodes);
  const auto add = [&](std::uint32_t count, const fs::path& program) {
    command.words.insert(command.words.end(), {"-n", std::to_string(count), program.string()});
    command.words.insert(command.words.end(), options.arguments.begin(), options.arguments.end());
  };
  if (!programs.host.empty()) {
    add(1, programs.host);
    command.words.emplace_back(":");
  }
  add(nodes, programs.node);
  const SessionFolders folders(command);
  folders.leave_to_another();
  become(command);
}

bool over_mpi(const RunOptions& options) {
  if (options.over == Over::processes && !options.hostfile.empty())
    throw Failure("processes are all on this machine", "", "leave out --hostfile, or use --over mpi");
  if (options.over != Over::automatic) return options.over == Over::mpi;
  return !options.hostfile.empty() || own_environment().value("SLURM_TASKS_PER_NODE").has_value();
}

// More processes than this would keep the machine busy with changing between them.
constexpr int kNodesAProcessor = 64;
constexpr int kMostNodes = 1 << 12;

void check_nodes(int nodes, const topology::Machine& machine) {
  const int most = kNodesAProcessor * machine.processors();
  if (nodes <= most) return;
  throw Failure(std::to_string(nodes) + " nodes are too many for this machine's " +
                    std::to_string(machine.processors()) + " processors",
                "--nodes", "use at most " + std::to_string(most) + ", or more machines by --hostfile");
}

int run(RunOptions& options) {
  const NxPrograms programs = programs_of(options);
  const hal::Settings settings = hal::read_settings();
  if (over_mpi(options)) run_mpi(options, programs);
  const topology::Machine machine = topology::Machine::here();
  if (options.nodes == 0) options.nodes = machine.processors();
  check_nodes(options.nodes, machine);
  return run_processes(options, programs, settings.nx_memory.value_or(message_memory(machine)));
}

// Nothing, or what is wrong with the word.
std::string is_count(const std::string& word) {
  const int count = number_in<int>(word).value_or(0);
  return count >= 1 && count <= kMostNodes
             ? ""
             : "'" + word + "' is not a number from 1 to " + std::to_string(kMostNodes);
}

void add_run(CLI::App& app, RunOptions& options, int& code) {
  CLI::App* command = app.add_subcommand("run", "Start a host and its nodes, or nodes alone");
  command
      ->add_option("PROGRAM", options.words,
                   "The host's program and the nodes', or the nodes' alone. Example: ./host ./node")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("-n,--nodes", options.nodes,
                   "Number of nodes; default: one per processor, or the slots of the hostfile or Slurm job. "
                   "Example: --nodes 8")
      ->check(is_count)
      ->type_name("N");
  command->add_flag("--host", options.host,
                    "The first program is the host, also where it is the only one: it loads its nodes "
                    "itself. Example: --host ./host");
  command
      ->add_option_function<std::string>(
          "--over", [&options](const std::string& word) { options.over = over_of(word); },
          "Processes over shared memory on this machine, or mpi; default: mpi with a hostfile or in a "
          "Slurm job, else processes. Example: --over mpi")
      ->type_name("auto|processes|mpi");
  command
      ->add_option("--hostfile", options.hostfile,
                   "Open MPI's file of the machines to use. Example: --hostfile hosts")
      ->type_name("FILE");
  command->footer("Environment variables:\n" + hal::settings_text() + "\n" + kStarts);
  command->callback([&] { code = run(options); });
}

// What follows -- is not ours.
std::vector<std::string> take_arguments(std::vector<const char*>& words) {
  const auto at = std::find_if(words.begin(), words.end(),
                               [](const char* word) { return std::string_view(word) == "--"; });
  if (at == words.end()) return {};
  std::vector<std::string> arguments(at + 1, words.end());
  words.erase(at, words.end());
  return arguments;
}

int run_command(int argc, char** argv) {
  CLI::App app("Runs programs written for NX", "mars-nx");
  app.set_version_flag("--version", "mars-nx " MARS_VERSION, "Print the version. Example: --version");
  app.require_subcommand(0, 1);
  RunOptions options;
  int code = 0;
  std::vector<const char*> words(argv, argv + argc);
  options.arguments = take_arguments(words);
  add_run(app, options, code);
  if (const auto ended = read_command_line(app, static_cast<int>(words.size()), words.data())) return *ended;
  if (app.get_subcommands().empty()) std::cout << kWayIn;
  return code;
}

}  // namespace
}  // namespace mars::host

int main(int argc, char** argv) {
  try {
    return mars::host::run_command(argc, argv);
  } catch (const std::exception& failure) {
    std::cerr << "mars-nx: " << mars::reason_of(failure) << '\n';
    return mars::host::kFailed;
  }
}
