// A command as it is started and as it is shown: words, and the environment variables set for it on top of
// those it inherits. Made for each backend from a person's options and from what the machine has.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/options/render_options.h"

namespace mars::host {

struct Command {
  std::vector<std::pair<std::string, std::string>> environment;
  std::vector<std::string> words;  // the first is the program

  bool operator==(const Command&) const = default;
};

// As it can be pasted into a shell.
std::string shell_text(const Command& command);

// The program of that name in `path`, folders separated by colons; none: in none of them.
std::optional<std::filesystem::path> find_program(const std::string& name, const std::string& path);

// Where the programs are that `mars render` starts; none: not installed.
struct Programs {
  std::optional<std::filesystem::path> mpirun;
  std::optional<std::filesystem::path> host;
  std::optional<std::filesystem::path> node;
  std::optional<std::filesystem::path> threads;
};

// Looks for our own beside `self`, then in ../libexec from there, then as for mpirun in `path`.
Programs find_programs(const std::filesystem::path& self, const std::string& path);

// What a start has to mind.
struct Surroundings {
  std::uint32_t cores = 1;  // of the processors this process was given
  bool root = false;
  bool copies_forbidden = false;      // processes may not read each other's memory, as in some containers
  bool no_remote_shell = false;       // neither ssh nor rsh is in the PATH
  std::vector<std::string> settings;  // MARS_* variables that are set, for nodes on other machines
};

// `path` as for find_programs.
Surroundings look_around(const std::string& path);

// Takes auto to one of the two. Throws Failure where the programs for the backend asked for are missing.
Backend choose_backend(Backend asked, const Programs& programs);

// mpirun with one host and options.nodes nodes; one process of as many threads. `options.nodes` is settled.
Command mpi_command(const RenderOptions& options, const Programs& programs, const Surroundings& surroundings);
Command threads_command(const RenderOptions& options, const Programs& programs);

}  // namespace mars::host
