// A triangle's set-up: all that drawing it needs, one cache line, sent as it is to the homes of its scanlines. A plain
// struct: kernels of several instruction sets share it. Values at a sample are plane equations taken at the
// sample's own place relative to the first vertex.
#pragma once

#include <cstdint>

#include "node/shape/vertices.h"

namespace mars::geometry {

// value(x, y) = (at_first + (y - first_y) * per_y) + (x - first_x) * per_x, in this order; x, y in 1/256 pixel.
struct alignas(64) Triangle {
  float at_first[shape::kValues];
  float per_x[shape::kValues];
  float per_y[shape::kValues];
  std::int32_t first_x;
  std::int32_t first_y;
  std::uint32_t patch;     // wins depth ties where lower; within a patch the triangle that comes first
  std::uint32_t material;  // index into the film's materials
};
static_assert(sizeof(Triangle) == 64);

}  // namespace mars::geometry
