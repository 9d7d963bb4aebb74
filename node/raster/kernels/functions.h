// The kernels of this folder, each defined in a file of its own and compiled for one instruction set at a time.
#pragma once

#include "node/simd/vectors.h"
#include "node/raster/kernels.h"

namespace mars::node::MARS_SET {

void classify(const ClassifyTask& task, const Vertices& vertices, const Triangles& triangles, const Batch& batch,
              Classified& out);
void set_up_planes(const Vertices& vertices, const Corner3& corners, const ScreenShape& shape,
                   const PatchIdentity& identity, Triangle& out);
void emit(const Vertices& vertices, const Triangles& triangles, const Batch& batch, const Classified& classified,
          std::uint32_t lanes, const PatchIdentity& identity, SetUpSpace& out);
Extent draw(const Triangle* triangles, const EdgeBox* boxes, std::uint32_t count, std::uint32_t line, float* depth,
            std::uint32_t* ids);

}  // namespace mars::node::MARS_SET
