#include "host/render/events/course.h"

#include <gtest/gtest.h>

namespace mars::events {
namespace {

// A keyframe of 4 seconds, then three inbetweens of 2.
const Course kCourse(
    {{4, FrameKind::keyframe}, {6, FrameKind::inbetween}, {8, FrameKind::inbetween}, {10, FrameKind::inbetween}});

TEST(Course, KnowsBeforeTheFirstFrame) {
  const auto left = kCourse.left(0, 0);
  ASSERT_TRUE(left);
  EXPECT_DOUBLE_EQ(left->keyframes, 4);
  EXPECT_DOUBLE_EQ(left->inbetweens, 6);
}

TEST(Course, OfARunThatGoesAsExpectedIsWhatRemains) {
  const auto left = kCourse.left(2, 6);
  EXPECT_DOUBLE_EQ(left->keyframes, 0);
  EXPECT_DOUBLE_EQ(left->inbetweens, 4);
}

// Twice as slow so far: 4 seconds are left by the forecast, 8 by what was measured, of which the forecast is a little.
TEST(Course, IsCorrectedByWhatWasMeasured) {
  const double left = kCourse.left(2, 12)->inbetweens;
  EXPECT_GT(left, 7);
  EXPECT_LT(left, 8);
}

TEST(Course, EndsWithTheLastFrame) { EXPECT_DOUBLE_EQ(kCourse.left(4, 15)->inbetweens, 0); }

TEST(Course, SaysNothingWithoutAForecast) {
  EXPECT_FALSE(Course().left(0, 0));
  EXPECT_FALSE(kCourse.left(5, 15));
}

}  // namespace
}  // namespace mars::events
