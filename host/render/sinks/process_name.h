// Which process of which machine wrote something, so that another can see whether it still runs. The start time
// distinguishes a later process with the same number. A host's name identifies no machine or container: only a process
// that was started since the same boot and is counted in the same list of processes can be looked up.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace mars::sinks {

struct ProcessName {
  std::string host;       // for people
  std::string boot;       // the boot's own id; "" where the system has none
  std::string processes;  // the list of processes that counts it, as the kernel names it ("pid:[4026531836]")
  std::int64_t number = 0;
  std::uint64_t start = 0;  // clock ticks since the boot

  bool operator==(const ProcessName&) const = default;
};

ProcessName this_process();

nlohmann::json to_json(const ProcessName& process);
// Throws Failure, without a place, where it is none that a process can have.
ProcessName process_name_of(const nlohmann::json& from);

enum class Running { yes, no, unknown };  // unknown: it cannot be seen from here

// As far as the process `seen_from` can see. One that has ended and waits for its parent does not run.
Running is_running(const ProcessName& process, const ProcessName& seen_from);

}  // namespace mars::sinks
