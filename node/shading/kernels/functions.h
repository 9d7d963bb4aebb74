// The kernels of this folder, each defined in a file of its own and compiled for one instruction set at a time.
#pragma once

#include <cstdint>

#include "node/shading/kernels.h"
#include "node/simd/vectors.h"

namespace mars::shading::MARS_SET {

Shaded shade(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, wire::Run* runs,
             void* pixels);

ShadedCounts shade_fragments(const Shading& shading, const Fragment* fragments, std::uint32_t count, std::uint32_t line,
                             float* const* light);

ShadedCounts shade_unsummed(const Shading& shading, const Fragment* fragments, std::uint32_t count, std::uint32_t line,
                            const UnsummedLight& out);
void sum_up(const Shading& shading, const UnsummedLight& in, const float* const* shares, std::uint32_t count,
            float* const* light);
void shade_vertices(const Shading& shading, std::uint32_t material, float side, const shape::Vertices& vertices,
                    std::uint32_t count, const shape::VertexColors& out);

}  // namespace mars::shading::MARS_SET
