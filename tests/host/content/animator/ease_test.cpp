#include "host/content/animator/pose/ease.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/content/animator/pose/channel.h"

namespace mars::animator {
namespace {

TEST(Ease, BeginsAndEndsExactly) {
  for (const Ease& ease : {kLinear, kIn, kOut, kBoth, Ease{0.7, -2, 0.3, 3}}) {
    EXPECT_EQ(eased(ease, 0), 0);
    EXPECT_EQ(eased(ease, 1), 1);
  }
}

TEST(Ease, LinearIsTheTimeItself) {
  for (int i = 0; i <= 100; ++i) EXPECT_EQ(eased(kLinear, i / 100.0), i / 100.0);
}

TEST(Ease, StartsAndEndsSlowlyWhereItSays) {
  EXPECT_LT(eased(kIn, 0.1), 0.03);
  EXPECT_GT(1 - eased(kIn, 0.9), 0.1);
  EXPECT_GT(eased(kOut, 0.1), 0.1);
  EXPECT_LT(1 - eased(kOut, 0.9), 0.03);
  for (const double time : {0.1, 0.3, 0.5}) EXPECT_NEAR(eased(kBoth, time), 1 - eased(kBoth, 1 - time), 1e-12);
}

TEST(Ease, RunsForward) {
  for (const Ease& ease : {kIn, kOut, kBoth, Ease{1, 0, 0, 1}})
    for (int i = 0; i < 1000; ++i) EXPECT_LE(eased(ease, i / 1000.0), eased(ease, (i + 1) / 1000.0) + 1e-12);
}

TEST(Ease, AnticipatesAndOvershoots) {
  EXPECT_LT(eased({0.5, -1, 0.5, 2}, 0.2), 0);
  EXPECT_GT(eased({0.5, -1, 0.5, 2}, 0.8), 1);
}

TEST(Ease, ItsHalvesTogetherAreTheWhole) {
  for (const Ease& ease : {kLinear, kIn, kOut, kBoth, Ease{0.2, -0.4, 0.9, 1.1}})
    for (const double cut : {0.25, 0.5, 0.8}) {
      const auto halves = split(ease, cut);
      ASSERT_TRUE(halves);
      const double there = eased(ease, cut);
      for (int i = 0; i <= 20; ++i) {
        const double part = i / 20.0;
        EXPECT_NEAR(there * eased(halves->first, part), eased(ease, cut * part), 1e-12);
        EXPECT_NEAR(there + (1 - there) * eased(halves->second, part), eased(ease, cut + (1 - cut) * part), 1e-12);
      }
    }
}

TEST(Ease, WhereItIsBackAtTheStartItCannotBeSplit) {
  const Ease ease{0.5, -1, 0.5, 2};
  double low = 0.1, high = 0.5;
  for (int bit = 0; bit < 53; ++bit) (eased(ease, (low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  EXPECT_FALSE(split(ease, high));
}

TEST(Ease, ItsExtentIsWhereItTurns) {
  EXPECT_EQ(swing_of(kBoth).lowest, 0);
  EXPECT_EQ(swing_of(kLinear).highest, 1);
  const Ease ease{0.3, -0.7, 0.6, 1.4};
  double lowest = 0, highest = 1;
  for (int i = 0; i <= 100'000; ++i) {
    lowest = std::min(lowest, eased(ease, i / 1e5));
    highest = std::max(highest, eased(ease, i / 1e5));
  }
  EXPECT_NEAR(swing_of(ease).lowest, lowest, 1e-9);
  EXPECT_NEAR(swing_of(ease).highest, highest, 1e-9);
}

TEST(Ease, SwingsAsFarAsWanted) {
  for (const double back : {0.0, 0.1, 0.5, 1.0})
    for (const double beyond : {0.0, 0.1, 0.5, 1.0}) {
      const Swing swing = swing_of(swinging(back, beyond));
      EXPECT_NEAR(swing.lowest, -back, 1e-9);
      EXPECT_NEAR(swing.highest, 1 + beyond, 1e-9);
    }
}

TEST(Channel, HoldsOutsideItsKeysAndIsExactOnThem) {
  const Channel<double> channel = {{10, 0.1, kBoth}, {20, 0.7, kIn}, {21, 0.7, kLinear}, {30, 1.3, kLinear}};
  EXPECT_EQ(value_at(channel, 0), 0.1);
  EXPECT_EQ(value_at(channel, 10), 0.1);
  EXPECT_EQ(value_at(channel, 20), 0.7);
  EXPECT_EQ(value_at(channel, 30), 1.3);
  EXPECT_EQ(value_at(channel, 99), 1.3);
  EXPECT_NEAR(value_at(channel, 15), 0.4, 1e-12);
  EXPECT_NEAR(value_at(channel, 24), 0.9, 1e-12);
}

}  // namespace
}  // namespace mars::animator
