// For the files of this folder only, which are compiled once for each instruction set: MARS_SET names it, and all
// they define is in a namespace of that name. Vectors are Highway's, as wide as the set has them; a lane does what
// plain code would, with + - * / and square roots only, so the bits are the same for all sets.
#pragma once

#include <hwy/highway.h>

#include "node/simd/kernels.h"

namespace mars::node::MARS_SET {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<std::int32_t>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
static_assert(hn::MaxLanes(FloatTag()) <= kVectorSlack);

inline constexpr FloatTag kFloats;
inline constexpr IntTag kInts;
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));

Fineness survey(const SurveyWeights& weights, const float (*points)[3], const Projection& projection);
bool evaluate(const Row& row, const Basis& basis, int first, int last, const Vertices& out, int at);
bool project(const Projection& projection, const Vertices& vertices, int count);
void move(const EyeMap& map, const float (*places)[3], const float (*normals)[3], int count, const Vertices& out);
void examine(const Examination& task, const Vertices& vertices, const Triangles& triangles, const Batch& batch,
             Examined& out);
void set(const Vertices& vertices, const Corner3& corners, const ScreenShape& shape, const PatchIdentity& identity,
         Triangle& out);
void keep(const Vertices& vertices, const Triangles& triangles, const Batch& batch, const Examined& examined,
          std::uint32_t lanes, const PatchIdentity& identity, SetUpSpace& out);
Extent draw(const Triangle* triangles, const EdgeBox* boxes, std::uint32_t count, std::uint32_t line, float* depth,
            std::uint32_t* ids);
Shaded shade(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, Run* runs,
             std::uint32_t* pixels);

}  // namespace mars::node::MARS_SET
