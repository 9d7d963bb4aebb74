// A picture in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace mars::images {

// Rows from the top. A pixel is one word, red in the lowest byte, then green, blue, 0; or two words of 16 bits or half
// also floats (node/wire/pixel_format.h), where the declaration names them.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint32_t> pixels;
};

}  // namespace mars::images
