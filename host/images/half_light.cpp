#include "host/images/half_light.h"

#include <cmath>
#include <memory>

namespace mars::images {
namespace {

float light_of(std::uint32_t half) {
  constexpr int kBias = 15, kBits = 10;
  const auto exponent = static_cast<int>(half >> kBits & 0x1f);
  const auto mantissa = static_cast<float>(half & 0x3ff) / 1024;
  if ((half & 0x8000) != 0) return 0;
  if (exponent == 0x1f) return mantissa > 0 ? 0 : kMostHalfLight;
  return exponent == 0 ? std::ldexp(mantissa, 1 - kBias) : std::ldexp(1 + mantissa, exponent - kBias);
}

}  // namespace

const std::array<float, 1 << 16>& lights_of_halfs() {
  static const auto all = std::make_unique<std::array<float, 1 << 16>>([] {
    std::array<float, 1 << 16> table{};
    for (std::uint32_t half = 0; half < table.size(); ++half) table[half] = light_of(half);
    return table;
  }());
  return *all;
}

}  // namespace mars::images
