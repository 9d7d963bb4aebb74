// For kernels only: files of the folders kernels/, which are compiled once for each instruction set. MARS_SET names it,
// and all they define is in a namespace of that name. Vectors are Highway's, as wide as the set has them; a lane does
// what plain code would, with + - * / and square roots only, so the bits are the same for all sets. What kernels share
// with other code is plain structs and pointers: nothing inline may be shared with code that is compiled for a lesser
// CPU.
#pragma once

#include <hwy/highway.h>

#include <cstdint>

#include "node/simd/vector_slack.h"

namespace mars::simd::MARS_SET {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<std::int32_t>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
static_assert(hn::MaxLanes(FloatTag()) <= kVectorSlack);

inline constexpr FloatTag kFloats;
inline constexpr IntTag kInts;
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));

inline Floats constant(float number) { return hn::Set(kFloats, number); }

}  // namespace mars::simd::MARS_SET
