// sRGB's encoding (IEC 61966-2-1) as tables: its levels of light y at round(sqrt(y) * steps), so that steps are as fine
// in the dark as the eye is. Plain: kernels of several instruction sets share it. Tables are made once a process, with
// the same bits on every machine; of numbers as wide as vectors gather them.
#pragma once

#include <cstdint>

namespace mars::color {

inline constexpr std::uint32_t kSteps8 = 4095;
inline constexpr std::uint32_t kSteps16 = 65535;

const std::int32_t* srgb_levels8();   // kSteps8 + 1, up to 255
const std::int32_t* srgb_levels16();  // kSteps16 + 1, up to 65535

}  // namespace mars::color
