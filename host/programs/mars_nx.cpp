// mars-nx: starts programs that are written for NX: one host and its nodes, or nodes alone.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "hal/failure.h"
#include "hal/processes/job.h"
#include "hal/settings.h"
#include "host/launch/command.h"
#include "host/launch/environment.h"
#include "host/options/command_line.h"
#include "topology/machine.h"
#include "topology/memory_limit.h"

namespace mars::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWayIn = R"(Runs programs that are written for NX, the message passing of the iPSC/2.

  mars-nx run --nodes 8 ./node           eight nodes
  mars-nx run --nodes 8 ./host ./node    one host and eight nodes
  mars-nx run --nodes 8 --host ./host    a host that loads its nodes itself
  mars-nx run --help                     every option, with an example
)";

constexpr const char* kEnds =
    R"(What follows -- goes to every program as its arguments; after two programs the -- can be left out.
The nodes of a host begin when it loads them, sends or receives for the first time, or ends.
Each program's output is that of mars-nx, and the host reads its input; without a host node 0 does.

Exit codes: the highest of all programs', 128 and the signal for one that died of it, 1 where a message call failed;
2 the command line is wrong.
)";

struct RunOptions {
  int nodes = 0;  // 0: as many as the machine has processors
  bool host = false;
  std::vector<std::string> words;
  std::vector<std::string> arguments;
};

std::string path_of(const Environment& environment) { return environment.value("PATH").value_or("/usr/bin:/bin"); }

bool runnable(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
}

// Here, or where a shell would find it.
fs::path program_file(const std::string& word) {
  if (runnable(word)) return fs::absolute(word);
  if (word.find('/') == std::string::npos)
    if (const auto found = find_program(word, path_of(own_environment()))) return *found;
  std::error_code ignored;
  if (fs::is_directory(word, ignored)) throw Failure("is a folder, not a program", word, "");
  if (fs::exists(word, ignored)) throw Failure("is not a program that can be run", word, "see whether it may be executed: chmod +x");
  throw Failure("there is no such program", word, "");
}

struct Programs {
  fs::path host;  // empty: none
  fs::path node;  // likewise
};

Programs programs_of(RunOptions& options) {
  Programs programs;
  std::size_t used = 0;
  if (options.host || options.words.size() >= 2) programs.host = program_file(options.words[used++]);
  if (used < options.words.size()) programs.node = program_file(options.words[used++]);
  options.arguments.insert(options.arguments.begin(), options.words.begin() + static_cast<std::ptrdiff_t>(used), options.words.end());
  return programs;
}

// In its own process; returns where it cannot.
int become(const fs::path& file, const std::vector<std::string>& arguments, bool reads) {
  std::vector<std::string> words = {file.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  if (!reads && std::freopen("/dev/null", "r", stdin) == nullptr) return kFailed;
  execv(pointers[0], pointers.data());
  std::cerr << "mars-nx: " << file.string() << ": cannot be run: " << std::strerror(errno) << '\n';
  return kFailed;
}

int run_processes(const RunOptions& options, const Programs& programs, std::uint64_t limit) {
  hal::JobPlan plan;
  plan.nodes = options.nodes;
  plan.host = !programs.host.empty();
  if (plan.host) plan.begin = programs.node.empty() ? hal::JobPlan::Begin::never : hal::JobPlan::Begin::later;
  plan.limit = limit;
  plan.become = [&](const hal::Place& place, const std::string& file) {
    const bool host = plan.host && place.index == options.nodes;
    hal::leave_place(place);
    return become(host ? programs.host : file.empty() ? programs.node : fs::path(file), options.arguments,
                  plan.host ? host : place.index == 0);
  };
  plan.tell = [](const std::string& line) { std::cerr << "mars-nx: " << line << std::endl; };
  return hal::Job(plan).run();
}

// Half of what the machine has and this job may use.
std::uint64_t message_memory(const topology::Machine& machine) {
  const topology::MemoryLimit limit = topology::memory_limit();
  std::uint64_t memory = machine.memory() == 0 ? std::uint64_t{1} << 32 : machine.memory();
  for (const std::uint64_t bound : {limit.together, limit.each})
    if (bound != 0) memory = std::min(memory, bound);
  return memory / 2;
}

int run(RunOptions& options) {
  const Programs programs = programs_of(options);
  const topology::Machine machine = topology::Machine::here();
  if (options.nodes == 0) options.nodes = machine.processors();
  return run_processes(options, programs, message_memory(machine));
}

void add_run(CLI::App& app, RunOptions& options, int& code) {
  CLI::App* command = app.add_subcommand("run", "Start a host and its nodes, or nodes alone");
  command->add_option("PROGRAM", options.words, "The host's program and the nodes', or the nodes' alone. Example: ./host ./node")
      ->required();
  command->add_option("--nodes", options.nodes, "Number of nodes; default: one a processor. Example: --nodes 8")
      ->check(CLI::Range(1, 1 << 12).description(""))
      ->type_name("N");
  command->add_flag("--host", options.host, "The first program is the host, also where it is the only one: it loads its nodes itself. Example: --host ./host");
  command->footer(kEnds);
  command->callback([&] { code = run(options); });
}

// What follows -- is not ours.
std::vector<std::string> take_arguments(std::vector<const char*>& words) {
  const auto at = std::find_if(words.begin(), words.end(), [](const char* word) { return std::string_view(word) == "--"; });
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
