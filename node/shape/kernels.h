// The inner loops of shape, each written once and compiled for several instruction sets (kernels/); the bits are the
// same for all of them. Plain structs and pointers only: nothing inline may be shared with code that is compiled for a
// lesser CPU.
#pragma once

#include "node/shape/vertices.h"

namespace mars::simd {
enum class InstructionSet;
}

namespace mars::shape {

struct ShapeKernels {
  // How a patch's inside bends, as it is seen: see rates (bezier.h).
  Fineness (*estimate_curvature)(const CurvatureWeights& weights, const float (*points)[3],
                                 const Projection& projection, const Tolerances& tolerances);

  // Vertices first..last - 1 of `row` at first/rate.. into out[at..]. Whether all have a normal.
  bool (*evaluate)(const Row& row, const Basis& basis, int first, int last, const Vertices& out, int at);

  // Vertices 0..count - 1 of a mesh, their normals of unit length or 0. Of both lists kVectorSlack more are read.
  void (*move)(const EyeMap& map, const float (*places)[3], const float (*normals)[3], int count, const Vertices& out);

  // The same with a skin. Of each bone's weights kVectorSlack more are read.
  void (*move_skin)(const EyeSkin& skin, const float (*places)[3], const float (*normals)[3], int count,
                    const Vertices& out);

  // Whether any of the vertices is outside.
  bool (*project)(const Projection& projection, const Vertices& vertices, int count);
};

const ShapeKernels& shape_kernels(simd::InstructionSet set);

}  // namespace mars::shape
