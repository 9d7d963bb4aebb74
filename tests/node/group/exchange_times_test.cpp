#include "node/group/exchange_times.h"

#include <gtest/gtest.h>

namespace mars::group {
namespace {

constexpr double kDicing = 1e-3;
constexpr std::uint64_t kMillisecond = 1'000'000;

TEST(ExchangeTimes, AreNotKnownAtFirst) {
  const ExchangeTimes times = ExchangeRecord().expected(kDicing);
  EXPECT_EQ(times.sending, 0u);
  EXPECT_EQ(times.making, kMillisecond) << "as much as own ones";
  EXPECT_FALSE(is_sooner_again(times)) << "they are sent until it is known how long that takes";
}

TEST(ExchangeTimes, TheFirstTimeDoesNotCount) {
  ExchangeRecord record;
  record.note(false, 10);
  EXPECT_EQ(record.expected(kDicing).sending, 0u) << "connections were made";
  record.note(false, 9e-3);
  EXPECT_EQ(record.expected(kDicing).sending, 9 * kMillisecond);
  EXPECT_TRUE(is_sooner_again(record.expected(kDicing)));
  record.note(true, 10);
  EXPECT_EQ(record.expected(kDicing).making, kMillisecond) << "caches filled";
  record.note(true, 3e-3);
  EXPECT_EQ(record.expected(kDicing).making, 3 * kMillisecond);
  record.note(true, 6e-3);
  EXPECT_FALSE(is_sooner_again(record.expected(kDicing)));
  record.note(false, 20e-3);
  EXPECT_TRUE(is_sooner_again(record.expected(kDicing))) << "the last time counts";
}

// On 4 nodes at 500 Mbit/s with s3: sending takes 2.6 times as long as dicing. In a large group making takes long.
TEST(ExchangeTimes, MakingIsTriedWhereItMayBeMuchSooner) {
  ExchangeRecord record;
  for (int keyframe = 0; keyframe < 2; ++keyframe) record.note(false, 2.6e-3);
  EXPECT_TRUE(is_sooner_again(record.expected(kDicing)));
  for (int keyframe = 0; keyframe < 2; ++keyframe) record.note(true, 5e-3);
  EXPECT_FALSE(is_sooner_again(record.expected(kDicing)));
}

TEST(ExchangeTimes, WhatIsNearlyAsSoonIsSent) {
  EXPECT_FALSE(is_sooner_again({1000, 500}));
  EXPECT_TRUE(is_sooner_again({1000, 499}));
  EXPECT_FALSE(is_sooner_again({0, 0}));
}

}  // namespace
}  // namespace mars::group
