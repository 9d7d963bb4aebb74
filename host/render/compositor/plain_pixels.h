// Pixels of one colour, of one or two words (node/wire/pixel_format.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace mars::compositor {

// `words`: of whole pixels, of `pixel_words` each.
inline void fill_pixels(std::span<std::uint32_t> words, std::uint64_t pixel, std::size_t pixel_words) {
  const auto low = static_cast<std::uint32_t>(pixel), high = static_cast<std::uint32_t>(pixel >> 32);
  if (pixel_words == 1) return void(std::ranges::fill(words, low));
  for (std::size_t at = 0; at < words.size(); at += 2) {
    words[at] = low;
    words[at + 1] = high;
  }
}

}  // namespace mars::compositor
