// Flagged blocks of a picture as rectangles that do not overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "host/render/compositor/block_flags.h"

namespace mars::compositor {

struct Rect {
  std::uint16_t x, y, width, height;  // pixels

  bool operator==(const Rect&) const = default;
};

// Stretches of one row after another that have the same columns are one rectangle.
std::vector<Rect> rectangles_of(const BlockFlags& flags, std::uint32_t width, std::uint32_t height);

}  // namespace mars::compositor
