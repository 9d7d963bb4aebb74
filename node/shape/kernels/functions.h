// The kernels of this folder, each defined in a file of its own and compiled for one instruction set at a time.
#pragma once

#include "node/shape/kernels.h"
#include "node/simd/vectors.h"

namespace mars::shape::MARS_SET {

Fineness estimate_curvature(const CurvatureWeights& weights, const float (*points)[3], const Projection& projection,
                            const Tolerances& tolerances);
bool evaluate(const Row& row, const Basis& basis, int first, int last, const Vertices& out, int at);
void move(const EyeMap& map, const float (*places)[3], const float (*normals)[3], int count, const Vertices& out);
void move_skin(const EyeSkin& skin, const float (*places)[3], const float (*normals)[3], int count,
               const Vertices& out);
bool project(const Projection& projection, const Vertices& vertices, int count);

}  // namespace mars::shape::MARS_SET
