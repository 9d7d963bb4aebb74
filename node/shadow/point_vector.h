// Points at which shadows are decided: places of samples, on the grid of one view of a light. Plain structs: kernels
// of several instruction sets share them.
#pragma once

#include <cstdint>

namespace mars::shadow {

inline constexpr int kPointLanes = 16;

// Places of a vector's points on the screen, in pixels from the corner of their square (pairs.h).
struct LanePlaces {
  alignas(64) float x[kPointLanes];
  alignas(64) float y[kPointLanes];
};

// Bounds on a view's grid, inclusive. Empty where low_x > high_x.
struct GridBox {
  std::int32_t low_x, high_x, low_y, high_y;
  float low_z, high_z;
};

// Points of neighbouring pixels. A caster is before a point where it is nearer to the light, its z greater, by more
// than lateral * (its slope) + along: the rounding of both grids (light_view.h).
struct alignas(64) PointVector {
  std::int32_t x[kPointLanes];
  std::int32_t y[kPointLanes];
  float z[kPointLanes];
  float lateral[kPointLanes];
  float along[kPointLanes];
  GridBox box;
  // A plane near them, so that casters that lie on it are told from those before it. With d = z - (per_x (x -
  // box.low_x)
  // + per_y (y - box.low_y)), a caster whose d is nowhere above least + room blocks none.
  float per_x, per_y;
  float least;
  float room;
  std::uint32_t active;   // one bit a point
  std::uint32_t blocked;  // and of those that a caster is before
};

// Boxes of point vectors, one array a bound, a little wider where a float has not all digits.
struct BoxArrays {
  const float* low_x;
  const float* high_x;
  const float* low_y;
  const float* high_y;
  const float* low_z;
};

}  // namespace mars::shadow
