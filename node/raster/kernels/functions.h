// The kernels of this folder, each defined in a file of its own and compiled for one instruction set at a time.
#pragma once

#include <cstdint>

#include "node/raster/kernels.h"
#include "node/simd/vectors.h"

namespace mars::raster::MARS_SET {

void classify(const ClassifyTask& task, const shape::Vertices& vertices, const shape::Triangles& triangles,
              const shape::Batch& batch, Classified& out);
void set_up_planes(const shape::Vertices& vertices, const shape::Corner3& corners, const ScreenShape& shape,
                   const PatchIdentity& identity, geometry::Triangle& out);
void emit(const shape::Vertices& vertices, const shape::Triangles& triangles, const shape::Batch& batch,
          const Classified& classified, std::uint32_t lanes, const PatchIdentity& identity, SetUpSpace& out);
shading::Extent draw(const geometry::Triangle* triangles, const EdgeBox* boxes, std::uint32_t count, std::uint32_t line,
                     const shape::SamplePattern& pattern, const LineSamples& samples);

GroupCounts group(const shape::SamplePattern& pattern, const LineSamples& seen, shading::Extent extent,
                  const Groups& out);
void add_groups(const Groups& groups, const GroupCounts& counts, std::uint32_t samples, const Light& light);
void add_background(const std::uint32_t* masks, std::uint32_t pixels, std::uint32_t samples, const float* background,
                    const Light& light);

}  // namespace mars::raster::MARS_SET
