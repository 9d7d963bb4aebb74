// A command in place of this process.
#pragma once

#include <string>
#include <vector>

#include "host/child/command.h"
#include "host/child/environment.h"

namespace mars::child {

// A command's words and its whole environment, as exec takes them.
class ExecArguments {
 public:
  explicit ExecArguments(const Command& command);
  ExecArguments(const ExecArguments&) = delete;
  ExecArguments& operator=(const ExecArguments&) = delete;

  // This process becomes the program. Returns, with errno, where it cannot. May be called after fork.
  void execute() const;

 private:
  std::vector<std::string> words_;
  Environment environment_;
  std::vector<char*> word_pointers_;
  std::vector<char*> environment_pointers_;
};

// This process becomes that program. Throws Failure with this remedy where it cannot.
[[noreturn]] void become(const Command& command, const std::string& remedy = "");

}  // namespace mars::child
