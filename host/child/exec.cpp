#include "host/child/exec.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/failure/failure.h"

namespace mars::child {
namespace {

Environment environment_for(const Command& command) {
  Environment environment = own_environment();
  for (const auto& [name, value] : command.environment) environment.set(name, value);
  return environment;
}

}  // namespace

ExecArguments::ExecArguments(const Command& command)
    : words_(command.words),
      environment_(environment_for(command)),
      word_pointers_(pointers_to(words_)),
      environment_pointers_(environment_.pointers()) {}

void ExecArguments::execute() const { execve(word_pointers_[0], word_pointers_.data(), environment_pointers_.data()); }

void become(const Command& command, const std::string& remedy) {
  const ExecArguments arguments(command);
  arguments.execute();
  throw Failure(std::string("cannot be started: ") + std::strerror(errno), command.words.front(), remedy);
}

}  // namespace mars::child
