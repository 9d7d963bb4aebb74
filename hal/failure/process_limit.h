// The limits that the calling process itself has for its memory (ulimit).
#pragma once

#include <cstdint>

namespace mars {

// Bytes of one process, as ulimit counts them.
struct ProcessMemory {
  std::uint64_t addresses = 0;  // ulimit -v: also those that were only set aside
  std::uint64_t data = 0;       // ulimit -d: memory that may be written

  bool operator==(const ProcessMemory&) const = default;
};

// 0: no limit. Allocates nothing: explain.h calls it where memory has run out.
ProcessMemory process_limit();

}  // namespace mars
