#include "host/shell/launch/wanted_frames.h"

#include <gtest/gtest.h>

namespace mars::launch {
namespace {

TEST(WantedFrames, AreAsAskedUntilTheyAreCounted) {
  WantedFrames frames(film::FrameSet("3-"));
  EXPECT_EQ(frames.next(), film::FrameSet("3-"));
  frames.set_count(4);
  EXPECT_EQ(frames.next(), film::FrameSet("3-6"));
}

TEST(WantedFrames, WhatIsThereOrAsideIsLeftOut) {
  WantedFrames frames(film::FrameSet("20-,3,0-5"));
  frames.set_count(10);
  EXPECT_EQ(frames.next(), film::FrameSet("0-5,20-23"));
  EXPECT_TRUE(frames.take(4));
  EXPECT_FALSE(frames.take(4));
  frames.set_aside(23);
  EXPECT_EQ(frames.next(), film::FrameSet("0-3,5,20-22"));
  EXPECT_EQ(frames.there(), 1u);
  frames.take_back(23);
  EXPECT_EQ(frames.next(), film::FrameSet("0-3,5,20-23"));
}

TEST(WantedFrames, EarlierRunsCount) {
  WantedFrames frames{film::FrameSet()};
  frames.set_count(10);
  frames.add_earlier(6);
  frames.take(9);
  EXPECT_EQ(frames.there(), 7u);
}

}  // namespace
}  // namespace mars::launch
