// The part of a sub-scanline that a triangle covers. Plain structs: kernels of several instruction sets share
// them; what they call is always inlined, so that none leaves a copy for the linker to take.
#pragma once

#include <cstdint>

namespace mars::raster {

// One triangle's part of one sub-scanline, at least one sample. A picture has at most 2^14 columns.
struct EdgeBox {
  std::uint32_t triangle;    // index into the frame's triangles
  std::uint32_t first : 14;  // column
  std::uint32_t after : 14;  // columns after the first
  std::uint32_t sample : 4;  // its number in a pixel's pattern: which of the line's sub-scanlines it is on

  // `columns`: first | last << 16, one past.
  [[gnu::always_inline]] static constexpr std::uint32_t packed(std::uint32_t columns, std::uint32_t sample) {
    const std::uint32_t first = columns & 0xffff, last = columns >> 16;
    return first | (last - first - 1) << 14 | sample << 28;
  }
  [[gnu::always_inline]] constexpr std::uint32_t width() const { return after + 1u; }
  [[gnu::always_inline]] constexpr std::uint32_t last() const { return first + width(); }
};
static_assert(sizeof(EdgeBox) == 8);

// An edge box that is not in its line yet.
struct UnsortedEdgeBox {
  EdgeBox box;
  std::uint16_t line;    // of pixels
  std::uint16_t moving;  // 1: of a part that moves in the interval
};
static_assert(sizeof(UnsortedEdgeBox) == 12);

}  // namespace mars::raster
