// Lines of pixels in blocks of a picture.
#pragma once

#include <algorithm>
#include <cstddef>

namespace mars::compositor {

// A picture's size, and how many words its pixels have.
struct Extent {
  std::size_t width;
  std::size_t height;
  std::size_t pixel_words;
};

// Calls visit(at, count) for each line of words in the blocks [first, last) of a row.
template <typename Visit>
void for_lines(const Extent& extent, std::size_t block, std::size_t row, std::size_t first, std::size_t last,
               Visit visit) {
  const std::size_t left = first * block;
  const std::size_t count = std::min(extent.width, last * block) - left;
  const std::size_t bottom = std::min(extent.height, (row + 1) * block);
  for (std::size_t line = row * block; line < bottom; ++line)
    visit((line * extent.width + left) * extent.pixel_words, count * extent.pixel_words);
}

}  // namespace mars::compositor
