// The kernels of this folder, each defined in a file of its own and compiled for one instruction set at a time.
#pragma once

#include <cstdint>

#include "node/shading/kernels.h"
#include "node/simd/vectors.h"

namespace mars::shading::MARS_SET {

Shaded shade(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, wire::Run* runs,
             std::uint32_t* pixels);

}  // namespace mars::shading::MARS_SET
