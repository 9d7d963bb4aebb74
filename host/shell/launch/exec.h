// What exec takes for a command, and becoming it.
#pragma once

#include <string>
#include <vector>

#include "host/shell/launch/command.h"
#include "host/shell/launch/environment.h"

namespace mars::host {

// A command's words and its whole environment, as exec takes them.
class ExecArguments {
 public:
  explicit ExecArguments(const Command& command);
  ExecArguments(const ExecArguments&) = delete;
  ExecArguments& operator=(const ExecArguments&) = delete;

  char* const* words() const { return word_pointers_.data(); }
  char* const* environment() const { return environment_pointers_.data(); }

 private:
  std::vector<std::string> words_;
  Environment environment_;
  std::vector<char*> word_pointers_;
  std::vector<char*> environment_pointers_;
};

// This process becomes that program. Throws Failure with this remedy where it cannot.
[[noreturn]] void become(const Command& command, const std::string& remedy = "");

}  // namespace mars::host
