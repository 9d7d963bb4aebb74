#include <string>
#include <utility>

#include "host/shell/launch/command.h"

namespace mars::launch {
namespace {

void add_arguments(child::Command& command, options::Program program, const options::RenderOptions& options) {
  for (std::string& word : options::arguments_for(program, options)) command.words.push_back(std::move(word));
}

}  // namespace

child::Command mpi_command(const options::RenderOptions& options, const Programs& programs,
                           const Surroundings& surroundings) {
  child::Command command = mpi_start(options, programs, surroundings);
  // Nodes bind themselves, each by its place on its machine.
  add_program(command, 1, *programs.host, programs, surroundings);
  add_arguments(command, options::Program::host, options);
  command.words.emplace_back(":");
  add_program(command, options.nodes, *programs.node, programs, surroundings);
  return command;
}

child::Command threads_command(const options::RenderOptions& options, const Programs& programs) {
  child::Command command{{}, {programs.threads->string()}};
  add_arguments(command, options::Program::threads, options);
  return command;
}

child::Command simulated_command(const options::RenderOptions& options, const Programs& programs) {
  child::Command command{{}, {programs.simulated->string()}};
  add_arguments(command, options::Program::simulated, options);
  return command;
}

}  // namespace mars::launch
