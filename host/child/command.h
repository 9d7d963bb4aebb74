// A program to start: its words, and the environment variables set for it on top of those it inherits.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mars::child {

// Open MPI that a command starts, whose files are to be kept apart (shell/launch/session_folders.h).
enum class OpenMpi { none, on_this_machine, on_several };

struct Command {
  std::vector<std::pair<std::string, std::string>> environment;
  std::vector<std::string> words;  // the first is the path of the program
  OpenMpi open_mpi = OpenMpi::none;

  bool operator==(const Command&) const = default;
};

}  // namespace mars::child
