#include "host/shell/launch/mpi_messages.h"

#include <sstream>
#include <string>

#include "hal/failure/failure.h"
#include "host/child/child.h"
#include "host/child/environment.h"
#include "host/shell/launch/command.h"
#include "host/shell/launch/session_folders.h"

namespace mars::launch {

std::optional<experiments::MessageCosts> mpi_message_costs(const std::filesystem::path& self) {
  constexpr std::uint32_t kNodes = 2;
  const std::string path = child::program_path(child::own_environment());
  const Programs programs = find_programs(self, path);
  if (!programs.mpirun || !programs.messages) return std::nullopt;
  options::RenderOptions options;
  options.nodes = kNodes;
  child::Command command = mpi_start(options, programs, look_around(path));
  command.words.insert(command.words.end(), {"-n", std::to_string(kNodes + 1), programs.messages->string()});
  const SessionFolders folders(command);
  std::string printed, trouble;
  child::Child child(command);
  const auto note = [](std::string& last) { return [&last](const std::string& line) { last = line; }; };
  const child::Ending ending = child.wait({note(printed), note(trouble), [] {}});
  child::fail_if_stopped(child);
  experiments::MessageCosts costs;
  std::istringstream numbers(printed);
  if (!ending.well() || !(numbers >> costs.latency >> costs.rate >> costs.end))
    throw Failure("messages over MPI cannot be measured", trouble, "run mars doctor");
  return costs;
}

}  // namespace mars::launch
