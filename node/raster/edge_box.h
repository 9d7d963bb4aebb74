// The part of a scanline that a triangle covers. Plain structs: kernels of several instruction sets share them.
#pragma once

#include <cstdint>

namespace mars::raster {

// One triangle's part of one scanline: samples [first, last).
struct EdgeBox {
  std::uint32_t triangle;  // index into the frame's triangles
  std::uint16_t first;
  std::uint16_t last;
};

// An edge box that is not in its line yet.
struct UnsortedEdgeBox {
  EdgeBox box;
  std::uint16_t line;
  std::uint16_t moving;  // 1: of a part that moves in the interval
};
static_assert(sizeof(UnsortedEdgeBox) == 12);

}  // namespace mars::raster
