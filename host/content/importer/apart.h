// Work in a process of its own: a library that crashes, never ends or takes all memory at a damaged file takes nothing
// with it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace mars::importer {

struct ApartLimits {
  std::chrono::seconds processor_time;
  std::chrono::milliseconds time;  // by the clock
  std::uint64_t memory;            // bytes, beyond what this process has
};

// For the work on a file of `bytes` bytes; a sound file takes a fraction of these limits.
ApartLimits limits_for(std::uint64_t bytes);

// The parts that `work` returns, joined; its Failure is thrown here. Where the process dies or reaches a limit, that is
// a Failure at `where` with `remedy`. The process ends with this one.
std::string run_apart(const std::function<std::vector<std::string>()>& work, const ApartLimits& limits,
                      const std::string& where, const std::string& remedy);

}  // namespace mars::importer
