#include "host/render/compositor/background.h"

#include <algorithm>

#include "host/render/compositor/blocks.h"
#include "host/render/compositor/plain_pixels.h"

namespace mars::compositor {

Background::Background(std::uint32_t width, std::uint32_t height, std::uint32_t block, wire::PixelFormat format)
    : width(width),
      height(height),
      format(format),
      pixel_words(wire::pixel_words(format)),
      constant(width, height, block) {}

std::uint64_t Background::write(std::uint32_t* picture, std::uint32_t row, std::uint32_t first,
                                std::uint32_t last) const {
  std::uint64_t words = 0;
  constant.for_parts(row, first, last, [&](std::uint32_t from, std::uint32_t to, bool drawn) {
    for_lines({width, height, pixel_words}, constant.block(), row, from, to, [&](std::size_t at, std::size_t count) {
      words += count;
      if (drawn)
        std::copy_n(&saved[at], count, picture + at);
      else
        fill_pixels({picture + at, count}, plain, format);
    });
  });
  return words * sizeof(std::uint32_t);
}

}  // namespace mars::compositor
