// The kernel of this folder, compiled for one instruction set at a time.
#pragma once

#include <cstdint>

#include "node/color/kernels.h"
#include "node/simd/vectors.h"

namespace mars::color::MARS_SET {

void encode(const Encoding& encoding, const float* const* light, std::uint32_t count, void* pixels);

}  // namespace mars::color::MARS_SET
