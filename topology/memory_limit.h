// How much memory may be used here, beside what the machine has: limits of control groups (a Slurm job's
// --mem, a container's) and of the process itself (ulimit). And what that leaves for each of several like
// processes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "hal/failure/process_limit.h"

namespace mars::topology {

// The memory that the calling process has; sanitizers take terabytes of addresses. 0 where /proc cannot be read.
ProcessMemory process_memory(const std::filesystem::path& root = "/");

// Bytes; 0: no limit.
struct MemoryLimit {
  std::uint64_t together = 0;  // all processes of the control group at once
  ProcessMemory each;
  ProcessMemory used;  // of each, so far

  // The least of all; 0: none.
  std::uint64_t least() const;

  bool operator==(const MemoryLimit&) const = default;
};

// Bytes that the calling process may use: the machine's, or the least limit's.
std::uint64_t usable_memory();

// An amount of memory in messages about usable_memory(): "1.5 GB".
std::string gigabytes(std::uint64_t bytes);

// Of the calling process. `root` is where proc/ and sys/ are.
MemoryLimit memory_limit(const std::filesystem::path& root = "/");

// The most that a process takes by default, however much there is.
inline constexpr std::uint64_t kMostShare = std::uint64_t{4} << 30;

// The bytes that each of `processes` on a machine of `machine_bytes` (0: unknown) may use for a frame by default: half
// of its equal share, at most kMostShare; of what a limit of data leaves, a quarter. Of what a limit of addresses
// leaves, several have a quarter together, for each sees the memory of all. Where the node is one of several threads
// that share this process's limit, `threads` says of how many.
std::uint64_t memory_share(std::uint64_t machine_bytes, const MemoryLimit& limit, int processes, int threads = 1);

}  // namespace mars::topology
