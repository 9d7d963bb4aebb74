// A machine and the processes that a job may start on it: a line of a hostfile.
#pragma once

#include <cstdint>
#include <string>

namespace mars::launch {

struct Slots {
  std::string host;
  std::uint32_t count;

  bool operator==(const Slots&) const = default;
};

// Whether it is this machine: mpirun starts processes there without ssh.
bool is_here(const std::string& machine);

}  // namespace mars::launch
