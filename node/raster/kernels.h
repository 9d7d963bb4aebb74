// The inner loops of the raster step, each written once and compiled for several instruction sets (kernels/); the bits
// are the same for all of them. Plain structs and pointers only, as in shape/kernels.h.
#pragma once

#include <cstdint>

#include "node/raster/classified.h"
#include "node/raster/edge_box.h"
#include "node/shading/shading.h"

namespace mars::simd {
enum class InstructionSet;
}

namespace mars::raster {

struct RasterKernels {
  void (*classify)(const ClassifyTask& task, const shape::Vertices& vertices, const shape::Triangles& triangles,
                   const shape::Batch& batch, Classified& out);

  // The triangle's identity and planes.
  void (*set_up_planes)(const shape::Vertices& vertices, const shape::Corner3& corners, const ScreenShape& shape,
                        const PatchIdentity& identity, geometry::Triangle& out);

  // Stores set-ups of those of the batch's decided triangles that `lanes` has bits for, and that have a box on a
  // wanted line. They must all fit.
  void (*emit)(const shape::Vertices& vertices, const shape::Triangles& triangles, const shape::Batch& batch,
               const Classified& classified, std::uint32_t lanes, const PatchIdentity& identity, SetUpSpace& out);

  // Draws `count` edge boxes of line `line`, in any order: a sample nearer than depth[x] takes over depth and id; of
  // two triangles as near the lower patch's is seen, within a patch the first. Says which columns the boxes span.
  shading::Extent (*draw)(const geometry::Triangle* triangles, const EdgeBox* boxes, std::uint32_t count,
                          std::uint32_t line, float* depth, std::uint32_t* ids);
};

const RasterKernels& raster_kernels(simd::InstructionSet set);

}  // namespace mars::raster
