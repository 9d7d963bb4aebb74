// A polygon's set-up: all that drawing it needs, and what travels to the homes of its scanlines. Screen
// places are snapped to 1/256 pixel; sample (column, row) lies at (256 column + 128, 256 row + 128). Values
// at a sample are plane equations taken at the sample's own place relative to the first vertex.
#pragma once

#include <cstdint>

namespace mars::node {

inline constexpr std::int32_t kSubpixels = 256;
inline constexpr std::int32_t kSampleOffset = kSubpixels / 2;

// f(x, y) = at_first + (y - y[0]) * per_y + (x - x[0]) * per_x, in this order; x, y in 1/256 pixel.
struct Plane {
  float at_first;
  float per_x;
  float per_y;
};

struct Triangle {
  std::int32_t x[3];
  std::int32_t y[3];
  Plane depth;                  // 1 / w, w the distance along the view axis: greater is nearer
  Plane normal[3];              // eye space normal / w, turned to the eye
  std::uint32_t patch;          // the polygon's number is (patch, index): lower wins depth ties
  std::uint32_t index;          // within the patch's dicing; pieces of a clipped triangle share it
  std::uint32_t look;           // index into the film's materials
};

// One triangle's crossing of one scanline: samples [first, last), with the triangle's depth along the line.
struct EdgeBox {
  std::uint32_t triangle;  // index into the frame's triangles
  std::uint16_t first;
  std::uint16_t last;
  std::int32_t x0;         // depth(x) = depth_at_x0 + (x - x0) * depth_per_x
  float depth_at_x0;
  float depth_per_x;
};

}  // namespace mars::node
