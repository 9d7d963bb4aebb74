#include "host/shell/launch/wanted_frames.h"

#include <gtest/gtest.h>

namespace mars::launch {
namespace {

TEST(WantedFrames, AreAsAskedButForThoseAside) {
  WantedFrames frames(film::FrameSet("20-,3,0-5"));
  EXPECT_EQ(frames.next(), film::FrameSet("20-,3,0-5"));
  frames.set_count(10);
  frames.set_aside(23);
  EXPECT_EQ(frames.next(), film::FrameSet("0-5,20-22"));
  frames.take_back(23);
  EXPECT_EQ(frames.next(), film::FrameSet("20-,3,0-5"));
}

TEST(WantedFrames, AreCompleteWithThoseAside) {
  WantedFrames frames{film::FrameSet()};
  EXPECT_FALSE(frames.complete()) << "nobody knows how many";
  frames.set_count(10);
  frames.count(6, 3);
  EXPECT_EQ(frames.there(), 9u);
  EXPECT_FALSE(frames.complete());
  frames.set_aside(4);
  EXPECT_TRUE(frames.complete());
  frames.take_back(4);
  EXPECT_EQ(frames.there(), 10u);
}

}  // namespace
}  // namespace mars::launch
