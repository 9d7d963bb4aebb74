#include "host/shell/launch/restarts.h"

#include <gtest/gtest.h>

#include <vector>

#include "host/shell/launch/deadly_frames.h"

namespace mars::launch {
namespace {

TEST(Restarts, PausesGrowWhileNoFrameComes) {
  Restarts restarts(7);
  std::vector<long> pauses;
  while (const auto pause = restarts.again(false)) pauses.push_back(pause->count());
  EXPECT_EQ(pauses, (std::vector<long>{1, 2, 4, 8, 15, 15, 15}));
}

TEST(Restarts, FramesMakeThemFree) {
  Restarts restarts(2);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(restarts.again(true), std::chrono::seconds(1));
    EXPECT_EQ(restarts.number(), 1u);
  }
  EXPECT_TRUE(restarts.again(false));
  EXPECT_FALSE(restarts.again(false));
  EXPECT_EQ(restarts.all(), 101u);
}

TEST(Restarts, NoneAreNone) { EXPECT_FALSE(Restarts(0).again(true)); }

TEST(DeadlyFrames, KillTwoNodesOrOneThreeTimes) {
  DeadlyFrames frames;
  EXPECT_FALSE(frames.count_death(7, 1));
  EXPECT_FALSE(frames.count_death(8, 2)) << "another frame";
  EXPECT_FALSE(frames.count_death(7, 1)) << "the node may be bad";
  EXPECT_TRUE(frames.count_death(7, 1));
  EXPECT_TRUE(frames.count_death(8, 3));
}

}  // namespace
}  // namespace mars::launch
