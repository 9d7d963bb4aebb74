// The inner loops of shading, each written once and compiled for several instruction sets (kernels/); the bits are the
// same for all of them. Plain structs and pointers only, as in shape/kernels.h.
#pragma once

#include <cstdint>

#include "node/shading/shading.h"

namespace mars::simd {
enum class InstructionSet;
}

namespace mars::shading {

struct ShadingKernels {
  // Shades the samples of line `line` within `extent` whose id is not kNoTriangle, their runs to `runs` and
  // their pixels to `pixels`, encoded; says how many of each.
  Shaded (*shade)(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, wire::Run* runs,
                  void* pixels);
  // The light that `count` fragments of line `line`, in any order, send to the eye, before exposure: red, green and
  // blue to light[0..2], which have kVectorSlack to spare.
  ShadedCounts (*shade_fragments)(const Shading& shading, const Fragment* fragments, std::uint32_t count,
                                  std::uint32_t line, float* const* light);
  // The same where lights cast shadows, before it is summed up; a triangle's own plane dims what casting lights add
  // where it is turned away from them though its normals are not.
  ShadedCounts (*shade_unsummed)(const Shading& shading, const Fragment* fragments, std::uint32_t count,
                                 std::uint32_t line, const UnsummedLight& out);
  // Sums up what `count` fragments send to the eye: base, then the terms by the shares of each casting light that
  // arrive, then fog, within the bounds of light.
  void (*sum_up)(const Shading& shading, const UnsummedLight& in, const float* const* shares, std::uint32_t count,
                 float* const* light);
  // The light that `count` vertices, all of one material, send to the eye, without fog. `side`: 1 as seen from outside,
  // -1 from inside.
  void (*shade_vertices)(const Shading& shading, std::uint32_t material, float side, const shape::Vertices& vertices,
                         std::uint32_t count, const shape::VertexColors& out);
};

const ShadingKernels& shading_kernels(simd::InstructionSet set);

}  // namespace mars::shading
