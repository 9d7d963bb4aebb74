// A program to start: its words, and the environment variables set for it on top of those it inherits.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mars::child {

struct Command {
  std::vector<std::pair<std::string, std::string>> environment;
  std::vector<std::string> words;  // the first is the path of the program
  bool session_folders = false;    // it starts Open MPI on this machine alone (shell/launch/session_folders.h)

  bool operator==(const Command&) const = default;
};

}  // namespace mars::child
