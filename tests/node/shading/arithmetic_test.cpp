// The kernels' own powers and exponential against the C library's.
#include <gtest/gtest.h>

#include <cmath>

#include "node/shading/kernels/arithmetic.h"

namespace mars::shading::MARS_SET {
namespace {

float first_lane(Floats vector) {
  alignas(64) float lanes[kLanes];
  hn::Store(vector, kFloats, lanes);
  return lanes[0];
}

TEST(Arithmetic, Exponential) {
  double worst = 0;
  for (double x = 0; x < 80; x += 0.0037) {
    const auto at = static_cast<float>(x);
    const double right = std::exp(-static_cast<double>(at));
    worst = std::max(worst, std::abs(static_cast<double>(first_lane(exp_of_minus(constant(at)))) / right - 1));
  }
  EXPECT_LT(worst, 5e-7);
  EXPECT_EQ(first_lane(exp_of_minus(constant(0))), 1);
  EXPECT_EQ(first_lane(exp_of_minus(constant(1e30f))), first_lane(exp_of_minus(constant(80))));
}

TEST(Arithmetic, Powers) {
  for (const float exponent : {0.0f, 0.5f, 1.0f, 7.25f, 32.0f, 1000.0f})
    for (double square = 0.01; square <= 1; square += 0.01) {
      const double right = std::pow(static_cast<double>(static_cast<float>(square)), exponent / 2.0);
      EXPECT_NEAR(first_lane(raise(constant(static_cast<float>(square)), exponent)), right, 1e-4 * right + 1e-37);
    }
  EXPECT_EQ(first_lane(raise(zero(), 0)), 0);
  EXPECT_NEAR(first_lane(fifth_power(constant(0.5f))), 0.03125f, 1e-9);
}

}  // namespace
}  // namespace mars::shading::MARS_SET
