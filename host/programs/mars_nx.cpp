// mars-nx: starts programs that are written for NX: one host and its nodes, or nodes alone.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/messages/settings.h"
#include "hal/processes/job.h"
#include "host/child/exec.h"
#include "host/child/standard_streams.h"
#include "host/content/document/text.h"
#include "host/shell/nx/run.h"
#include "host/cli/program.h"

namespace mars::programs {
namespace {

constexpr const char* kWayIn = R"(Runs programs that are written for NX, the message passing of the iPSC/2.

  mars-nx run --nodes 8 ./node           eight nodes
  mars-nx run --nodes 8 ./host ./node    one host and eight nodes
  mars-nx run --nodes 8 --host ./host    a host that loads its nodes itself
  mars-nx run --help                     every option, with an example
)";

constexpr const char* kStarts =
    R"(The words after -- are arguments of every program; after two programs you can
leave out the --. The nodes of a host begin when the host loads them, when it
sends or receives for the first time, or when it has ended. mars-nx prints what
the programs print. Its input goes to the host, or without a host to node 0.

When a program dies, message calls of the other programs fail, unless the host
kills the nodes and loads them again. If every process waits for a message and
no message is on its way, all of them fail. Over MPI they fail only if a process
has ended with an exit code above 0; otherwise they wait for ever:
MARS_NX_STRICT=yes prints who waits. However mars-nx ends, no process remains.

Exit codes: the highest of all programs; 128 and the signal if a signal ended a
program; 1 if a message call failed; 2 if the command line is wrong.
)";

nx_jobs::Over over_of(const std::string& word) {
  if (word == "auto") return nx_jobs::Over::automatic;
  if (word == "processes") return nx_jobs::Over::processes;
  if (word == "mpi") return nx_jobs::Over::mpi;
  throw cli::UsageError("--over", "'" + word + "' is not auto or processes or mpi");
}

// Nothing, or what is wrong with the word.
std::string is_count(const std::string& word) {
  const int count = document::number_in<int>(word).value_or(0);
  return count >= 1 && count <= nx_jobs::kMostNxNodes
             ? ""
             : "'" + word + "' is not a number from 1 to " + std::to_string(nx_jobs::kMostNxNodes);
}

// In its own process; returns where it cannot.
int become_program(const std::filesystem::path& file, const std::vector<std::string>& arguments, bool reads) try {
  if (!reads && std::freopen("/dev/null", "r", stdin) == nullptr) return cli::kFailed;
  child::Command command{{}, {file.string()}};
  command.words.insert(command.words.end(), arguments.begin(), arguments.end());
  child::become(command);
} catch (const Failure& failure) {
  std::cerr << "mars-nx: " << failure.what() << '\n';
  return cli::kFailed;
}

int run_processes(const nx_jobs::NxRun& job, const nx_jobs::NxPrograms& programs, std::uint64_t limit) {
  processes::JobPlan plan;
  plan.nodes = job.nodes;
  plan.host = !programs.host.empty();
  if (plan.host)
    plan.begin = programs.node.empty() ? processes::JobPlan::Begin::never : processes::JobPlan::Begin::later;
  plan.limit = limit;
  plan.become = [&](const processes::Place& place, const std::string& file) {
    const bool host = plan.host && place.index == job.nodes;
    processes::leave_place(place);
    const std::filesystem::path& program = host           ? programs.host
                                           : file.empty() ? programs.node
                                                          : std::filesystem::path(file);
    return become_program(program, job.arguments, plan.host ? host : place.index == 0);
  };
  plan.report = [](const std::string& line) { std::cerr << "mars-nx: " << line << std::endl; };
  return processes::Job(plan).run();
}

void add_run(cli::Command app, nx_jobs::NxRun& options, int& code) {
  const cli::Command command = app.add_command("run", "Start a host and its nodes, or nodes alone");
  command
      .add("PROGRAM", options.words,
           "The programs of the host and of the nodes, or that of the nodes alone. Example: ./host ./node")
      .required()
      .type("FILE");
  command
      .add("-n,--nodes", options.nodes,
           "Number of nodes; default: one per processor, or the slots of the hostfile or Slurm job. "
           "Example: --nodes 8")
      .check(is_count)
      .type("N");
  command.add_flag("--host", options.host,
                   "The first program is the host, even if it is the only one: then it loads its nodes itself. "
                   "Example: --host ./host");
  command
      .add_read(
          "--over", [&options](const std::string& word) { options.over = over_of(word); },
          "Processes over shared memory on this machine, or mpi; default: mpi with a hostfile, in a Slurm job or "
          "in a batch job of several machines, otherwise processes. Example: --over mpi")
      .type("auto|processes|mpi");
  command.add("--hostfile", options.hostfile, "Open MPI's file of the machines to use. Example: --hostfile hosts")
      .type("FILE");
  command.footer("Environment variables:\n" + messages::settings_text(true) + "\n" + kStarts);
  command.runs([&] { code = nx_jobs::run_nx(options, run_processes); });
}

// What follows -- is not ours.
std::vector<std::string> take_arguments(std::vector<const char*>& words) {
  const auto at =
      std::find_if(words.begin(), words.end(), [](const char* word) { return std::string_view(word) == "--"; });
  if (at == words.end()) return {};
  std::vector<std::string> arguments(at + 1, words.end());
  words.erase(at, words.end());
  return arguments;
}

int run_command(int argc, char** argv) {
  cli::Program program("mars-nx", "Runs programs written for NX");
  program.version("mars-nx " MARS_VERSION);
  nx_jobs::NxRun options;
  int code = 0;
  std::vector<const char*> words(argv, argv + argc);
  options.arguments = take_arguments(words);
  add_run(program, options, code);
  if (const auto ended = program.read(static_cast<int>(words.size()), words.data())) return *ended;
  if (program.no_command_given()) std::cout << kWayIn;
  return code;
}

}  // namespace
}  // namespace mars::programs

int main(int argc, char** argv) {
  mars::child::prepare_standard_streams();
  try {
    return mars::programs::run_command(argc, argv);
  } catch (const std::exception& failure) {
    std::cerr << "mars-nx: " << mars::reason_of(failure) << '\n';
    return mars::cli::kFailed;
  }
}
