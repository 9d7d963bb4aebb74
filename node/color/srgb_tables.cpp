#include "node/color/srgb_tables.h"

#include <cmath>
#include <vector>

namespace mars::color {
namespace {

// By Newton's method, for 0.05 < a <= 1; eight steps from 1 reach the last bits.
double cube_root(double a) {
  double root = 1;
  for (int step = 0; step < 8; ++step) root -= (root * root * root - a) / (3 * root * root);
  return root;
}

// y^(1 / 2.4) is y^(1/4) y^(1/6): roots only, for libraries' powers differ in their last bits.
double srgb(double y) {
  if (y <= 0.0031308) return 12.92 * y;
  const double root = std::sqrt(y);
  return 1.055 * (std::sqrt(root) * cube_root(root)) - 0.055;
}

std::vector<std::int32_t> levels(std::uint32_t steps, double most) {
  std::vector<std::int32_t> out(steps + 1);
  std::int32_t* level = out.data();
  for (std::uint32_t i = 0; i <= steps; ++i) {
    const double root = static_cast<double>(i) / steps;
    level[i] = static_cast<std::int32_t>(srgb(root * root) * most + 0.5);
  }
  return out;
}

}  // namespace

const std::int32_t* srgb_levels8() {
  static const auto kLevels = levels(kSteps8, 255);
  return kLevels.data();
}

const std::int32_t* srgb_levels16() {
  static const auto kLevels = levels(kSteps16, 65535);
  return kLevels.data();
}

}  // namespace mars::color
