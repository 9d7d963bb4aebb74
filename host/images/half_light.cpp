#include "host/images/half_light.h"

#include <array>
#include <cmath>
#include <memory>

#include "node/color/encoding.h"

namespace mars::images {
namespace {

float computed(std::uint32_t half) {
  constexpr int kBias = 15, kBits = 10;
  const auto exponent = static_cast<int>(half >> kBits & 0x1f);
  const auto mantissa = static_cast<float>(half & 0x3ff) / 1024;
  if ((half & 0x8000) != 0) return 0;
  if (exponent == 0x1f) return mantissa > 0 ? 0 : color::kMostHalf;
  return exponent == 0 ? std::ldexp(mantissa, 1 - kBias) : std::ldexp(1 + mantissa, exponent - kBias);
}

}  // namespace

float light_of_half(std::uint32_t half) {
  static const auto all = [] {
    auto table = std::make_unique<std::array<float, 1 << 16>>();
    for (std::uint32_t number = 0; number < table->size(); ++number) (*table)[number] = computed(number);
    return table;
  }();
  return (*all)[half & 0xffff];
}

}  // namespace mars::images
