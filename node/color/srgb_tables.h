// sRGB's encoding (IEC 61966-2-1) as tables (Encoding::srgb8, srgb16), made once a process, with the same bits on every
// machine; of numbers as wide as vectors gather them.
#pragma once

#include <cstdint>
#include <span>

namespace mars::color {

std::span<const std::int32_t> srgb_levels8();   // kSteps8 + 1, up to 255
std::span<const std::int32_t> srgb_levels16();  // kSteps16 + 1, up to 65535

}  // namespace mars::color
