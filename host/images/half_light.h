// The light that the half floats of EXR files stand for.
#pragma once

#include <array>
#include <cstdint>

namespace mars::images {

inline constexpr float kMostHalfLight = 65504;

// By a half float's 16 bits: what is negative or no number counts as 0, infinity as kMostHalfLight.
const std::array<float, 1 << 16>& lights_of_halfs();

}  // namespace mars::images
