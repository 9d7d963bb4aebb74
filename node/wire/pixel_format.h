// How the pixels of a strip are stored. Kernels of several instruction sets share it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mars::wire {

// Red, then green, blue and a zero, 8 or 16 bits each. rgb8 and rgb16 are encoded (node/color); half: light before
// exposure and curve, as IEEE 754 half floats. The others have alpha in place of the zero: the share of a pixel's
// samples that surfaces cover. Their background is 0; rgba8 and rgba16 have the colour of what is covered, half_alpha
// its light times alpha.
enum class PixelFormat : std::uint32_t { rgb8, rgb16, half, rgba8, rgba16, half_alpha };
inline constexpr PixelFormat kLastPixelFormat = PixelFormat::half_alpha;

constexpr bool has_alpha(PixelFormat format) { return format >= PixelFormat::rgba8; }
// The same without alpha.
constexpr PixelFormat colors_of(PixelFormat format) {
  const auto kWithAlpha = static_cast<std::uint32_t>(PixelFormat::rgba8);
  return has_alpha(format) ? static_cast<PixelFormat>(static_cast<std::uint32_t>(format) - kWithAlpha) : format;
}

constexpr std::size_t pixel_bytes(PixelFormat format) { return colors_of(format) == PixelFormat::rgb8 ? 4 : 8; }
// Pictures are arrays of words of 32 bits, of which a pixel has one or two, the lower first.
constexpr std::size_t pixel_words(PixelFormat format) { return pixel_bytes(format) / sizeof(std::uint32_t); }

}  // namespace mars::wire
