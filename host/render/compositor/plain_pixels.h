// Pixels of one colour (node/wire/pixel_format.h).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "node/wire/pixel_format.h"

namespace mars::compositor {

// The layers of a pixel that shows nothing but the colour `pixel`.
inline void put_plain_layers(wire::PixelFormat format, std::uint64_t pixel, std::uint32_t* words) {
  std::fill_n(words + wire::color_words(format), wire::pixel_words(format) - wire::color_words(format), 0u);
  if (wire::has_layer(format, wire::Layer::depth))
    words[wire::layer_at(format, wire::Layer::depth)] = std::bit_cast<std::uint32_t>(wire::kNoDepth);
  if (!wire::has_layer(format, wire::Layer::unshadowed)) return;
  std::uint32_t* const light = words + wire::layer_at(format, wire::Layer::unshadowed);
  light[0] = static_cast<std::uint32_t>(pixel);
  light[1] = static_cast<std::uint32_t>(pixel >> 32) & 0xffff;
}

// `words`: of whole pixels. They show the colour `pixel`.
inline void fill_pixels(std::span<std::uint32_t> words, std::uint64_t pixel, wire::PixelFormat format) {
  const auto low = static_cast<std::uint32_t>(pixel), high = static_cast<std::uint32_t>(pixel >> 32);
  const std::size_t pixel_words = wire::pixel_words(format);
  if (pixel_words == 1) return void(std::ranges::fill(words, low));
  for (std::size_t at = 0; at < words.size(); at += pixel_words) {
    words[at] = low;
    words[at + 1] = high;
    if (pixel_words > 2) put_plain_layers(format, pixel, &words[at]);
  }
}

}  // namespace mars::compositor
