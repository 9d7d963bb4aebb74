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
// than error * (its slope + size), size being 1 for a directional light and the point's z for others: the rounding of
// both grids (light_view.h).
struct alignas(64) PointVector {
  GridBox box;
  // A plane near them, which separates casters that lie on it from those before it. With d = z - (per_x (x -
  // box.low_x)
  // + per_y (y - box.low_y)), a caster whose d is nowhere above least + room blocks none.
  float per_x, per_y;
  float least;
  float room;
  std::uint32_t active;     // one bit a point
  std::uint32_t blocked;    // and of those that a caster is before
  std::uint32_t noted;      // and of those of which this is known (points.h)
  std::uint32_t has_place;  // the light
  alignas(64) std::int32_t x[kPointLanes];
  std::int32_t y[kPointLanes];
  float z[kPointLanes];
  float error[kPointLanes];
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
