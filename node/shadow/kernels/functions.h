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
                const float* inverse_w, std::uint32_t active, PointVector& out);
std::uint32_t set_up(const LightView& view, const GridVertices& vertices, const shape::Triangles& triangles,
                     const shape::Batch& batch, SmallBatches& out);
std::uint32_t find(const BoxArrays& boxes, std::uint32_t first, std::uint32_t count, const GridBox& box, float spread,
                   std::uint32_t* found);
std::uint32_t find_below(const GridHull& hull, const PointVector* points, std::uint32_t* found,
                         std::uint32_t found_count);
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

inline hn::Mask<IntTag> integers(hn::Mask<FloatTag> mask) { return hn::RebindMask(kInts, mask); }
inline hn::Mask<FloatTag> floats(hn::Mask<IntTag> mask) { return hn::RebindMask(kFloats, mask); }

}  // namespace mars::shadow::MARS_SET
