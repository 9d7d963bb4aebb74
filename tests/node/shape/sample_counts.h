// Numbers of samples a pixel that a film may have.
#pragma once

#include <cstdint>

namespace mars::shape {

inline constexpr std::uint32_t kSampleCounts[] = {1, 2, 4, 8, 16};

}  // namespace mars::shape
