#include "host/animator/ease.h"

#include <gtest/gtest.h>

#include "host/animator/channel.h"

namespace mars::host {
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
  for (const double time : {0.1, 0.3, 0.5})
    EXPECT_NEAR(eased(kBoth, time), 1 - eased(kBoth, 1 - time), 1e-12);
}

TEST(Ease, RunsForward) {
  for (const Ease& ease : {kIn, kOut, kBoth, Ease{1, 0, 0, 1}})
    for (int i = 0; i < 1000; ++i) EXPECT_LE(eased(ease, i / 1000.0), eased(ease, (i + 1) / 1000.0) + 1e-12);
}

TEST(Ease, AnticipatesAndOvershoots) {
  EXPECT_LT(eased({0.5, -1, 0.5, 2}, 0.2), 0);
  EXPECT_GT(eased({0.5, -1, 0.5, 2}, 0.8), 1);
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
}  // namespace mars::host
