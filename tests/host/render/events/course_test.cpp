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

TEST(Course, HasBoundsThatNarrowAsTheRunGoesOn) {
  const Course course({{4, FrameKind::keyframe}, {6, FrameKind::inbetween}, {10, FrameKind::inbetween}},
                      RatioBounds{0.8, 1.5});
  const auto width = [&](std::size_t done, double seconds) {
    const auto left = course.left(done, seconds);
    EXPECT_LT(left->between->front(), left->seconds());
    return left->between->back() / left->between->front();
  };
  EXPECT_EQ(course.left(0, 0)->between, (std::array{8.0, 15.0}));
  EXPECT_LT(width(1, 4), width(0, 0));
  EXPECT_LT(width(2, 6), width(1, 4));
  EXPECT_FALSE(kCourse.left(0, 0)->between) << "without bounds";
}

}  // namespace
}  // namespace mars::events
