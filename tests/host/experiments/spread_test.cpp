#include "host/experiments/spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mars::experiments {
namespace {

// Of renderings whose forecasts are 20 % too short in the middle.
std::vector<double> ratios(std::mt19937& random, int count, double noise) {
  std::normal_distribution<double> normal(std::log(1.2), noise);
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(std::exp(normal(random)));
  return all;
}

TEST(Spread, HasOneOfTwentyBeyondEitherEnd) {
  std::vector<double> from_1_to_39;
  for (int i = 39; i >= 1; --i) from_1_to_39.push_back(i);
  EXPECT_EQ(spread_of(2, true, from_1_to_39), (Spread{2, true, 2, 20, 38}));
  from_1_to_39.resize(19);  // 39 to 21
  EXPECT_EQ(spread_of(1, false, from_1_to_39), (Spread{1, false, 21, 30, 39}));
}

TEST(Spread, HoldsNineOfTenOthers) {
  std::mt19937 random(7);
  int held = 0, all = 0;
  for (int calibration = 0; calibration < 400; ++calibration) {
    const Spread spread = spread_of(1, false, ratios(random, 39, 0.1));
    for (const double ratio : ratios(random, 10, 0.1)) {
      held += spread.low <= ratio && ratio <= spread.high ? 1 : 0;
      ++all;
    }
  }
  EXPECT_NEAR(static_cast<double>(held) / all, kWithin, 0.02);
}

TEST(Spread, IsWiderWhereTheCalibrationWasNoisy) {
  std::mt19937 random(7);
  const Spread quiet = spread_of(1, false, ratios(random, 39, 0.05)),
               noisy = spread_of(1, false, ratios(random, 39, 0.3));
  EXPECT_GT(std::log(noisy.high / noisy.low), 3 * std::log(quiet.high / quiet.low));
  EXPECT_NEAR(quiet.middle, 1.2, 0.03);
}

TEST(Spread, OfNumbersBetweenIsBetween) {
  const std::vector<Spread> known{
      {8, false, 0.4, 1, 4}, {1, false, 0.8, 1, 1.25}, {2, false, 0.8, 1, 1}, {2, true, 0.5, 1, 2}};
  EXPECT_EQ(spread_for(known, 2, true), known[3]);
  EXPECT_EQ(spread_for(known, 1, false), known[1]);
  const Spread four = spread_for(known, 4, false).value();
  EXPECT_EQ(four.nodes, 4);
  EXPECT_NEAR(four.low, std::sqrt(0.8 * 0.4), 1e-9);
  EXPECT_NEAR(four.high, 2, 1e-9);
}

TEST(Spread, ItsMiddleIsThatOfTheNearest) {
  const std::vector<Spread> known{{1, false, 0.8, 1.5, 2}, {4, false, 0.8, 1.2, 2}, {1, true, 0.8, 3, 4}};
  EXPECT_EQ(middle_for(known, 1, false), 1.5);
  EXPECT_EQ(middle_for(known, 64, false), 1.2);
  EXPECT_EQ(middle_for(known, 64, true), 3);
  EXPECT_EQ(middle_for({}, 2, false), 1);
}

TEST(Spread, IsNotKnownBeyondWhatWasTried) {
  const std::vector<Spread> known{{2, false, 0.9, 1, 1.1}, {4, false, 0.9, 1, 1.1}};
  EXPECT_FALSE(spread_for(known, 1, false));
  EXPECT_FALSE(spread_for(known, 5, false));
  EXPECT_FALSE(spread_for(known, 2, true));
  EXPECT_FALSE(spread_for({}, 1, false));
}

}  // namespace
}  // namespace mars::experiments
