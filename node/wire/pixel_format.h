// How the pixels of a strip are stored. Kernels of several instruction sets share it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mars::wire {

// Red, then green, blue and a zero, 8 or 16 bits each. rgb8 and rgb16 are encoded (node/color); half: light before
// exposure and curve, as IEEE 754 half floats.
enum class PixelFormat : std::uint32_t { rgb8, rgb16, half };

constexpr std::size_t pixel_bytes(PixelFormat format) { return format == PixelFormat::rgb8 ? 4 : 8; }
// Pictures are arrays of words of 32 bits, of which a pixel has one or two, the lower first.
constexpr std::size_t pixel_words(PixelFormat format) { return pixel_bytes(format) / sizeof(std::uint32_t); }

}  // namespace mars::wire
