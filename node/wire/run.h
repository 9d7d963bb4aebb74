// Where pixels of a strip go. Plain: kernels of several instruction sets write it.
#pragma once

#include <cstdint>

namespace mars::wire {

// `count` pixels of line `line` from column `first`.
struct Run {
  std::uint32_t line;
  std::uint16_t first;
  std::uint16_t count;
};

}  // namespace mars::wire
