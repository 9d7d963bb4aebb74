// A range of frames.
#pragma once

#include <cstdint>

namespace mars::animator {

// Both ends belong to it.
struct FrameRange {
  std::uint32_t first;
  std::uint32_t last;

  bool holds(std::uint32_t frame) const { return frame >= first && frame <= last; }
};

}  // namespace mars::animator
