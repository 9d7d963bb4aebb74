#include "node/color/agx_tables.h"

#include <algorithm>
#include <bit>
#include <vector>

namespace mars::color {
namespace {

// Of 2^-20 < value < 2^20, bit by bit: libraries' logarithms differ in their last bits.
double log2_of(double value) {
  double whole = 0;
  for (; value >= 2; value /= 2) ++whole;
  for (; value < 1; value *= 2) --whole;
  double bit = 0.5, part = 0;
  for (int step = 0; step < 48; ++step, bit /= 2) {
    value *= value;
    if (value < 2) continue;
    value /= 2;
    part += bit;
  }
  return whole + part;
}

// By Newton's method, for 0 < a <= 1.
double fifth_root(double a) {
  double root = 1;
  for (int step = 0; step < 60; ++step) {
    const double fourth = root * root * root * root;
    root -= (fourth * root - a) / (5 * fourth);
  }
  return root;
}

float curve(float light) {
  constexpr double kLowest = -12.47393, kHighest = 4.026069;  // stops
  const double x = std::clamp((log2_of(static_cast<double>(light)) - kLowest) / (kHighest - kLowest), 0.0, 1.0);
  const double y = (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
  return static_cast<float>(y);  // a little below 0 in the dark, which unmixing makes up for
}

std::vector<float> curves() {
  const std::uint32_t first = std::bit_cast<std::uint32_t>(kAgxDarkest);
  const std::uint32_t last = std::bit_cast<std::uint32_t>(kAgxBrightest);
  std::vector<float> all;
  for (std::uint32_t entry = 0; entry <= ((last - first) >> kAgxEntryBits) + 1; ++entry)
    all.push_back(curve(std::bit_cast<float>(first + (entry << kAgxEntryBits))));
  return all;
}

std::vector<float> powers() {
  std::vector<float> all{0};
  for (std::uint32_t step = 1; step <= kAgxSteps; ++step) {
    const double value = static_cast<double>(step) / kAgxSteps;
    all.push_back(static_cast<float>(value * value * fifth_root(value)));
  }
  all.push_back(all.back());
  return all;
}

}  // namespace

AgxTables agx_tables() {
  static const std::vector<float> kCurves = curves(), kPowers = powers();
  return {kCurves.data(), kPowers.data()};
}

}  // namespace mars::color
