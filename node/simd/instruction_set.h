// The inner loops, each written once and compiled for several instruction sets (kernels/); the bits are
// the same for all of them. Plain structs and pointers only: nothing inline may be shared with code that is
// compiled for a lesser CPU.
#pragma once

#include <cstdint>
#include <string_view>

#include "node/raster/examined.h"
#include "node/shading/shading.h"
#include "node/shape/vertices.h"

namespace mars::node {

struct Kernels {
  const char* name;

  // Of a patch's inside: see inside_rates (bezier.h).
  Fineness (*survey)(const SurveyWeights& weights, const float (*points)[3], const Projection& projection);

  // Vertices first..last - 1 of `row` at first/rate.. into out[at..]. Whether all have a normal.
  bool (*evaluate)(const Row& row, const Basis& basis, int first, int last, const Vertices& out, int at);

  // Vertices 0..count - 1 of a mesh, their normals of unit length or 0. Of both lists kVectorSlack more are read.
  void (*move)(const EyeMap& map, const float (*places)[3], const float (*normals)[3], int count, const Vertices& out);

  // Whether any of the vertices is outside.
  bool (*project)(const Projection& projection, const Vertices& vertices, int count);

  void (*examine)(const Examination& task, const Vertices& vertices, const Triangles& triangles, const Batch& batch,
                  Examined& out);

  // The triangle's identity and planes.
  void (*set)(const Vertices& vertices, const Corner3& corners, const ScreenShape& shape, const PatchIdentity& identity,
              Triangle& out);

  // Stores set-ups of those of the batch's decided triangles that `lanes` has bits for, and that have a box on a
  // wanted line. There must be room for all.
  void (*keep)(const Vertices& vertices, const Triangles& triangles, const Batch& batch, const Examined& examined,
               std::uint32_t lanes, const PatchIdentity& identity, SetUpSpace& out);

  // Draws `count` edge boxes of line `line`, in any order: a sample nearer than depth[x] takes over depth and id; of
  // two triangles as near the lower patch's is seen, within a patch the first. Says which columns the boxes span.
  Extent (*draw)(const Triangle* triangles, const EdgeBox* boxes, std::uint32_t count, std::uint32_t line,
                 float* depth, std::uint32_t* ids);

  // Shades the samples of line `line` within `extent` whose id is not kNoTriangle, their runs to `runs` and
  // their pixels to `pixels`; says how many of each.
  Shaded (*shade)(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, Run* runs,
                  std::uint32_t* pixels);
};

// The widest kernels that this CPU runs and that are not wider than `limit` ("sse2", "sse4", "avx2",
// "avx512";
// "" for no limit). Throws Failure for another name.
const Kernels& best_kernels(std::string_view limit);

}  // namespace mars::node
