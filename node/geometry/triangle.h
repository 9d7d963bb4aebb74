// A polygon's set-up: all that drawing it needs, one cache line, and what travels to the homes of its scanlines.
// Screen places are snapped to 1/256 pixel; sample (column, row) lies at (256 column + 128, 256 row + 128). Values
// at a sample are plane equations taken at the sample's own place relative to the first vertex.
#pragma once

#include <cstdint>

namespace mars::node {

inline constexpr std::int32_t kSubpixels = 256;
inline constexpr std::int32_t kSampleOffset = kSubpixels / 2;

// Screen places of a triangle's vertices.
struct Corners {
  std::int32_t x[3];
  std::int32_t y[3];
};

// What a sample takes from a triangle: 1 / w, w the distance along the view axis (greater is nearer), and the
// eye space normal / w, turned to the eye.
enum Value { kDepth, kNormalX, kNormalY, kNormalZ, kValues };

// value(x, y) = (at_first + (y - first_y) * per_y) + (x - first_x) * per_x, in this order; x, y in 1/256 pixel.
struct alignas(64) Triangle {
  float at_first[kValues];
  float per_x[kValues];
  float per_y[kValues];
  std::int32_t first_x;
  std::int32_t first_y;
  std::uint32_t patch;  // wins depth ties where lower; within a patch the triangle that comes first
  std::uint32_t look;   // index into the film's materials
};
static_assert(sizeof(Triangle) == 64);

// One triangle's part of one scanline: samples [first, last).
struct EdgeBox {
  std::uint32_t triangle;  // index into the frame's triangles
  std::uint16_t first;
  std::uint16_t last;
};

// An edge box that is not in its line yet.
struct Crossing {
  EdgeBox box;
  std::uint16_t line;
  std::uint16_t moving;  // 1: of a part that moves in the interval
};
static_assert(sizeof(Crossing) == 12);

}  // namespace mars::node
