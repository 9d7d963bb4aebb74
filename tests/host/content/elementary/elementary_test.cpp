// Against the C library's long double, whose 64 bits are 2048 times as fine; and bit for bit against what other
// processors and compilers made.
#include "host/content/elementary/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <string>

namespace mars::elementary {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kTries = 50000;

// Units in the last place between a result and the true value.
double error_of(double result, long double value) {
  int exponent = 0;
  std::frexp(value, &exponent);
  const long double unit = std::ldexp(1.0L, std::max(exponent - 53, -1074));
  return static_cast<double>(std::abs((result - value) / unit));
}

using Numbers = std::function<double(std::mt19937_64&)>;

Numbers even(double from, double to) {
  return [=](auto& random) { return std::uniform_real_distribution(from, to)(random); };
}

// Numbers of both signs, from 2^from to 2^to.
Numbers of_all_sizes(double from, double to) {
  return [=](auto& random) {
    const double size = std::exp2(std::uniform_real_distribution(from, to)(random));
    return random() % 2 == 0 ? size : -size;
  };
}

// An error that is NaN counts as infinite, or later ones would replace it.
double larger(double largest, double error) { return std::isnan(error) ? kInfinity : std::max(largest, error); }

double largest_error(const std::function<double(double)>& function,
                     const std::function<long double(long double)>& reference, const Numbers& numbers) {
  std::mt19937_64 random(1);
  double largest = 0;
  for (int i = 0; i < kTries; ++i) {
    const double x = numbers(random);
    largest = larger(largest, error_of(function(x), reference(x)));
  }
  return largest;
}

TEST(Elementary, SinesAndTheirKind) {
  for (const Numbers& angles : {even(-0.8, 0.8), even(-10, 10), even(-1e5, 1e5), of_all_sizes(-60, 20),
                                of_all_sizes(19, 21), of_all_sizes(20, 50)}) {
    EXPECT_LT(largest_error(sin, sinl, angles), 0.8);
    EXPECT_LT(largest_error(cos, cosl, angles), 0.8);
    EXPECT_LT(largest_error(tan, tanl, angles), 0.9);
  }
}

TEST(Elementary, SinesNextToMultiplesOfQuarterTurns) {
  const Numbers near = [](auto& random) {
    const double quarters = std::floor(std::uniform_real_distribution(-1e6, 1e6)(random));
    return static_cast<double>(quarters * 1.57079632679489661923132169163975144L);
  };
  EXPECT_LT(largest_error(sin, sinl, near), 0.8);
  EXPECT_LT(largest_error(cos, cosl, near), 0.8);
}

TEST(Elementary, SinesOfHugeAnglesAreThoseOfSomeAngle) {
  std::mt19937_64 random(3);
  const Numbers angles = of_all_sizes(50, 1024);
  for (int i = 0; i < kTries; ++i) {
    const double angle = angles(random), sine = sin(angle), cosine = cos(angle);
    ASSERT_NEAR(sine * sine + cosine * cosine, 1, 1e-15) << angle;
    ASSERT_TRUE(std::isfinite(tan(angle))) << angle;
  }
}

TEST(Elementary, ArcsOfSines) {
  for (const Numbers& sines : {even(-1, 1), of_all_sizes(-60, 0)}) {
    EXPECT_LT(largest_error(asin, asinl, sines), 0.51);
    EXPECT_LT(largest_error(acos, acosl, sines), 0.51);
  }
  EXPECT_EQ(acos(1), 0);
  EXPECT_EQ(acos(-1), std::acos(-1.0));
  EXPECT_TRUE(std::isnan(asin(std::nextafter(1, 2))));
  EXPECT_TRUE(std::isnan(acos(-1.5)));
}

TEST(Elementary, ArcsOfTangents) {
  EXPECT_LT(largest_error(atan, atanl, even(-5, 5)), 0.51);
  EXPECT_LT(largest_error(atan, atanl, of_all_sizes(-60, 60)), 0.51);
  EXPECT_LT(largest_error(atan, atanl, of_all_sizes(60, 1024)), 0.51);
  std::mt19937_64 random(2);
  double largest = 0;
  for (int i = 0; i < kTries; ++i) {
    const double y = of_all_sizes(-10, 10)(random), x = of_all_sizes(-10, 10)(random);
    largest = larger(largest, error_of(atan2(y, x), atan2l(y, x)));
  }
  EXPECT_LT(largest, 0.51);
}

TEST(Elementary, DirectionsOfAnyLength) {
  std::mt19937_64 random(4);
  for (const Numbers& lengths : {of_all_sizes(-1000, 1000), of_all_sizes(-1070, -1020), of_all_sizes(1000, 1003)}) {
    double largest = 0;
    for (int i = 0; i < kTries; ++i) {
      const double x = lengths(random), y = x * of_all_sizes(-20, 20)(random);
      if (x != 0 || y != 0) largest = larger(largest, error_of(atan2(y, x), atan2l(y, x)));
    }
    EXPECT_LT(largest, 0.51);
  }
  EXPECT_EQ(atan2(0, 1e305), 0);
  EXPECT_EQ(atan2(1e305, 0), std::atan2(1.0, 0.0));
}

TEST(Elementary, DirectionsAlongAxes) {
  for (const double y : {0.0, -0.0, 1.0, -1.0, kInfinity, -kInfinity})
    for (const double x : {0.0, -0.0, 1.0, -1.0, kInfinity, -kInfinity})
      EXPECT_EQ(std::bit_cast<std::uint64_t>(atan2(y, x)), std::bit_cast<std::uint64_t>(std::atan2(y, x)))
          << y << " " << x;
}

TEST(Elementary, Powers) {
  EXPECT_LT(largest_error(exp, expl, even(-1, 1)), 0.54);
  EXPECT_LT(largest_error(exp, expl, even(-700, 700)), 0.54);
  EXPECT_LT(largest_error(exp2, exp2l, even(-1000, 1000)), 0.54);
  for (const double exponent : {2.4, 1 / 2.4, 3.0, -7.5, 0.1})
    EXPECT_LT(largest_error([=](double x) { return pow(std::abs(x), exponent); },
                            [=](long double x) { return powl(std::abs(x), exponent); }, of_all_sizes(-30, 30)),
              0.54)
        << exponent;
  EXPECT_LT(
      largest_error([](double x) { return pow(10, x); }, [](long double x) { return powl(10, x); }, even(-300, 300)),
      0.54);
  EXPECT_EQ(pow(-2, 3), -8);
  EXPECT_EQ(pow(-2, -2), 0.25);
  EXPECT_TRUE(std::isnan(pow(-2, 0.5)));
  EXPECT_EQ(pow(0, 2), 0);
  EXPECT_EQ(pow(0, -1), kInfinity);
  EXPECT_EQ(pow(7, 0), 1);
  EXPECT_EQ(pow(1, 1e305), 1);
  EXPECT_EQ(pow(-1, 1e305), 1);
  EXPECT_EQ(pow(10, 400), kInfinity);
  EXPECT_EQ(pow(10, -400), 0);
  EXPECT_EQ(exp(-kInfinity), 0);
}

TEST(Elementary, LogarithmsAndRoots) {
  const auto log_of_size = [](double x) { return log10(std::abs(x)); };
  const auto reference = [](long double x) { return log10l(std::abs(x)); };
  EXPECT_LT(largest_error(log_of_size, reference, even(0.1, 10)), 0.51);
  EXPECT_LT(largest_error(log_of_size, reference, of_all_sizes(-900, 900)), 0.51);
  EXPECT_LT(largest_error(cbrt, cbrtl, of_all_sizes(-300, 300)), 0.54);
  EXPECT_LT(largest_error([](double x) { return hypot(x, 3); }, [](long double x) { return hypotl(x, 3); },
                          of_all_sizes(-20, 20)),
            0.51);
  EXPECT_EQ(log10(0), -kInfinity);
  EXPECT_TRUE(std::isnan(log10(-1)));
  EXPECT_EQ(cbrt(-27), -3);
}

TEST(Elementary, PowersOfTenAreExact) {
  for (int exponent = -30; exponent <= 30; ++exponent) {
    const double power = std::strtod(("1e" + std::to_string(exponent)).c_str(), nullptr);
    EXPECT_EQ(pow(10, exponent), power);
    EXPECT_EQ(log10(power), exponent);
  }
}

// The sum was made by GCC 12 for x86-64 with and without fused multiply-add.
TEST(Elementary, ResultsAreTheSameBitsEverywhere) {
  std::uint64_t sum = 0;
  const auto add = [&](double result) { sum = (sum ^ std::bit_cast<std::uint64_t>(result)) * 0x100000001b3u; };
  for (int i = -2000; i <= 2000; ++i) {
    const double x = i * 0.0137, part = i / 2001.0;
    for (const double result : {sin(x), cos(x), tan(x), asin(part), acos(part), atan(x), atan2(x, part), exp(x),
                                exp2(x), pow(std::abs(x), 2.4), log10(x * x + 1), cbrt(x), hypot(x, part)})
      add(result);
  }
  EXPECT_EQ(sum, 3449525566171568104u);
}

TEST(Elementary, NanGivesNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double result : {sin(nan), cos(nan), tan(nan), asin(nan), acos(nan), atan(nan), atan2(nan, 1),
                              atan2(1, nan), exp(nan), exp2(nan), pow(nan, 2), log10(nan), cbrt(nan), hypot(nan, 1)})
    EXPECT_TRUE(std::isnan(result));
  for (const double result : {sin(kInfinity), cos(kInfinity), tan(kInfinity), pow(kInfinity, 2), cbrt(kInfinity)})
    EXPECT_TRUE(std::isnan(result));
}

}  // namespace
}  // namespace mars::elementary
