// Half floats as light.
#pragma once

#include <cstdint>

namespace mars::images {

// Of a half float's 16 bits: 0 where it is negative or no number, at most color::kMostHalf.
float light_of_half(std::uint32_t half);

}  // namespace mars::images
