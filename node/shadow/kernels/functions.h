// The kernels of this folder, each defined in a file of its own and compiled for one instruction set at a time.
#pragma once

#include <cstdint>

#include "node/shadow/kernels.h"
#include "node/simd/vectors.h"

namespace mars::shadow::MARS_SET {

using namespace simd::MARS_SET;

static_assert(kPointLanes % kLanes == 0);

// The largest numbers.
inline constexpr std::int32_t kMostSteps = 0x7fffffff;
inline constexpr float kFar = 3.4028234e38f;

GridBox project(const LightView& view, const float* const* place, std::uint32_t count, const GridVertices& out);
void put_points(const LightView& view, const PointFrame& frame, float left, float top, const LanePlaces& places,
                const float* depths, std::uint32_t active, PointVector& out);
std::uint32_t set_up(const LightView& view, const GridVertices& vertices, const shape::Triangles& triangles,
                     const shape::Batch& batch, const GridBox& where, SmallBatches& out);
std::uint32_t find(const BoxArrays& boxes, std::uint32_t first, std::uint32_t count, const GridBox& box, float spread,
                   std::uint32_t* found);
std::uint32_t find_below(const GridHull& hull, const Shaft& shaft, const PointVector* points, std::uint32_t* found,
                         std::uint32_t found_count);
void touch(const SmallBatches& batches, const Shaft& shaft, const PointVector* points, const std::uint32_t* found,
           std::uint32_t found_count, std::uint64_t& touching, std::uint8_t* touched);
void block(const SmallBatches& batches, PointVector* points, const std::uint32_t* found, std::uint32_t found_count);

// One bit a lane.
template <typename Tag>
std::uint32_t bits(Tag tag, hn::Mask<Tag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(tag, mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

template <typename Tag>
auto least(Tag tag, hn::Vec<Tag> lanes) {
  return hn::GetLane(hn::MinOfLanes(tag, lanes));
}
template <typename Tag>
auto greatest(Tag tag, hn::Vec<Tag> lanes) {
  return hn::GetLane(hn::MaxOfLanes(tag, lanes));
}

// a >= b, which Highway has for some sets alone.
inline hn::Mask<IntTag> at_least(Ints a, Ints b) { return hn::Not(hn::Lt(a, b)); }

inline float magnitude(float number) { return number < 0 ? -number : number; }

// How far a vector of triangles reaches before the plane near the points: at a corner, for both are planes.
inline Floats highest_before(const SmallTriangles& t, std::uint32_t k, const PointVector& points) {
  const Ints low_x = hn::Set(kInts, points.box.low_x), low_y = hn::Set(kInts, points.box.low_y);
  const Floats per_x = constant(points.per_x), per_y = constant(points.per_y);
  Floats highest = constant(-kFar);
  for (int c = 0; c < 3; ++c) {
    const Floats x = hn::ConvertTo(kFloats, hn::Sub(hn::Load(kInts, t.x[c] + k), low_x));
    const Floats y = hn::ConvertTo(kFloats, hn::Sub(hn::Load(kInts, t.y[c] + k), low_y));
    const Floats plane = hn::Add(hn::Mul(per_x, x), hn::Mul(per_y, y));
    highest = hn::Max(highest, hn::Sub(hn::Load(kFloats, t.z[c] + k), plane));
  }
  return highest;
}

// What of the room (point_vector.h) is certain for all points of the light.
inline float room(const PointVector& points, const Shaft& shaft) {
  const float part = points.room * shaft.room;
  return part < points.room ? part : points.room;
}

inline hn::Mask<IntTag> integers(hn::Mask<FloatTag> mask) { return hn::RebindMask(kInts, mask); }
inline hn::Mask<FloatTag> floats(hn::Mask<IntTag> mask) { return hn::RebindMask(kFloats, mask); }

}  // namespace mars::shadow::MARS_SET
