// The inner loops of shadows, each written once and compiled for several instruction sets (kernels/); the bits are the
// same for all of them. Plain structs and pointers only, as in shape/kernels.h.
#pragma once

#include <cstdint>

#include "node/shadow/light_view.h"
#include "node/shadow/point_vector.h"
#include "node/shape/vertices.h"

namespace mars::simd {
enum class InstructionSet;
}

namespace mars::shadow {

// Vertices on a view's grid, kVectorSlack longer than there are; kOffGrid in x where a vertex is off it.
struct GridVertices {
  std::int32_t* x;
  std::int32_t* y;
  float* z;
};

inline constexpr std::int32_t kOffGrid = -0x7fffffff - 1;

// From a point towards all places of a light, on the grid of its middle: at height h over the point it is h * spread
// steps wide to each side. `bound` and `room` say what part of a vector's (point_vector.h) is certain for all of them.
struct Shaft {
  float spread;
  float tangent;  // the same in units of length
  float bound, room;
  float rounding;  // of the grid, a part of the error
  std::uint32_t has_place;
};

// Towards a point.
inline constexpr Shaft kRay{0, 0, 1, 1, 0, 0};

// Of planes, to the rise of a shaft's rays: what is nowhere before such a plane blocks no point on it.
inline constexpr float kMostRise = 0.5f;

// A hull's places on a view's grid; surfaces within it are off it by `margin` steps at most, and by `margin_z`.
struct alignas(64) GridHull {
  std::int32_t x[kPointLanes];
  std::int32_t y[kPointLanes];
  float z[kPointLanes];
  std::uint32_t count;
  float margin, margin_z;
};

// Triangles that are small on the grid: differences of their coordinates fit kMostSmall, so that edge functions are
// exact in 32 bits. Turned so that they run counter-clockwise; bounds of those that are not small are empty.
struct alignas(64) SmallTriangles {
  std::int32_t x[3][kPointLanes];
  std::int32_t y[3][kPointLanes];
  std::int32_t least[3][kPointLanes];  // of each edge's function, where a point is inside
  float z[3][kPointLanes];
  float per_x[kPointLanes];
  float per_y[kPointLanes];
  float slope[kPointLanes];  // |per_x| + |per_y|, for a unit of length or of the tangent
  std::int32_t low_x[kPointLanes], high_x[kPointLanes], low_y[kPointLanes], high_y[kPointLanes];
  float high_z[kPointLanes];
};

inline constexpr std::uint32_t kMostBatches = 64;  // that are set up at a time, so that they stay in a cache

// Batches of them, and bounds of each.
struct alignas(64) SmallBatches {
  SmallTriangles batch[kMostBatches];
  std::int32_t low_x[kMostBatches], high_x[kMostBatches], low_y[kMostBatches], high_y[kMostBatches];
  float high_z[kMostBatches];
  std::uint32_t count;
};
inline constexpr std::int32_t kMostSmall = 32767;

struct ShadowKernels {
  // Vertices from eye space to the grid; the box of those on it. Places have kVectorSlack to spare.
  GridBox (*project)(const LightView& view, const float* const* place, std::uint32_t count, const GridVertices& out);
  // Points from their places in the square at (left, top) and their depths; inactive where that is PointFrame::nothing
  // or `active` has no bit.
  void (*put_points)(const LightView& view, const PointFrame& frame, float left, float top, const LanePlaces& places,
                     const float* depths, std::uint32_t active, PointVector& out);
  // Sets up the triangles of a batch, the next of `out`, whose bounds are empty where none meets `where`; bits of those
  // that are not small, which are left to the caller.
  std::uint32_t (*set_up)(const LightView& view, const GridVertices& vertices, const shape::Triangles& triangles,
                          const shape::Batch& batch, const GridBox& where, SmallBatches& out);
  // Of boxes [first, first + count), a multiple of kPointLanes, those with points that a caster within `box` may block,
  // where the grid's places of points of one light differ by `spread` (light_view.h). Their numbers go to `found`; says
  // how many.
  std::uint32_t (*find)(const BoxArrays& boxes, std::uint32_t first, std::uint32_t count, const GridBox& box,
                        float spread, std::uint32_t* found);
  // Leaves those numbers in `found` of vectors before whose near plane (point_vector.h) the hull reaches, all of which
  // is on the grid, or which rise too much for that to say anything; says how many.
  std::uint32_t (*find_below)(const GridHull& hull, const Shaft& shaft, const PointVector* points, std::uint32_t* found,
                              std::uint32_t found_count);
  // Blocks those of the points `found` that the triangles are before.
  void (*block)(const SmallBatches& batches, PointVector* points, const std::uint32_t* found,
                std::uint32_t found_count);
  // Sets bits of the batches that meet shafts of points `found`, and touched[i] of the vectors i that have these.
  void (*touch)(const SmallBatches& batches, const Shaft& shaft, const PointVector* points, const std::uint32_t* found,
                std::uint32_t found_count, std::uint64_t& touching, std::uint8_t* touched);
};

const ShadowKernels& shadow_kernels(simd::InstructionSet set);

}  // namespace mars::shadow
