// Which strips are to come, and what nodes draw, by what they were given.
#include "host/render/farm/assignments.h"

#include <gtest/gtest.h>

namespace mars::farm {
namespace {

constexpr auto kKeyframe = wire::FrameKind::keyframe, kInbetween = wire::FrameKind::inbetween;

wire::Strip strip_of(int node, const Assignment& picture) {
  wire::Strip strip{};
  strip.node = node;
  strip.frame = picture.frame;
  strip.interval = picture.interval;
  strip.kind = picture.kind;
  strip.last = 1;
  return strip;
}

// Two nodes draw keyframe 4 of interval 1, and one inbetween each.
Assignments example() {
  Assignments assignments(3);
  for (const int node : {0, 1}) assignments.give(node, {4, 1, kKeyframe});
  assignments.give(0, {5, 1, kInbetween});
  assignments.give(1, {6, 1, kInbetween});
  return assignments;
}

// Each node's last strip of a picture once.
TEST(Assignments, HaveWhatANodeWasGivenAndHasNotDrawn) {
  Assignments assignments = example();
  const auto has = [&](int node, const Assignment& picture) { return assignments.has(strip_of(node, picture)); };
  for (const int node : {0, 1}) {
    EXPECT_TRUE(has(node, {4, 1, kKeyframe}));
    EXPECT_EQ(has(node, {5, 1, kInbetween}), node == 0);
    EXPECT_EQ(has(node, {6, 1, kInbetween}), node == 1);
  }
  EXPECT_FALSE(has(2, {4, 1, kKeyframe}));
  EXPECT_FALSE(has(0, {4, 2, kKeyframe})) << "of another interval";
  EXPECT_FALSE(has(0, {4, 1, kInbetween})) << "it is the keyframe";
  assignments.end(strip_of(1, {4, 1, kKeyframe}));
  EXPECT_FALSE(has(1, {4, 1, kKeyframe})) << "its last has come";
  EXPECT_TRUE(has(0, {4, 1, kKeyframe}));
  EXPECT_TRUE(has(1, {6, 1, kInbetween}));
}

TEST(Assignments, SayWhatANodeDraws) {
  Assignments assignments = example();
  EXPECT_EQ(assignments.drawn_by(0, -1), 4u);
  EXPECT_EQ(assignments.drawn_by(1, 6), 6u) << "it may have begun with it";
  EXPECT_EQ(assignments.drawn_by(1, 5), 4u) << "that is another's";
  EXPECT_EQ(assignments.drawn_by(2, 4), std::nullopt);
  assignments.end(strip_of(1, {4, 1, kKeyframe}));
  EXPECT_EQ(assignments.drawn_by(1, 4), 6u);
  assignments.end(strip_of(1, {6, 1, kInbetween}));
  EXPECT_EQ(assignments.drawn_by(1, 6), std::nullopt);
}

TEST(Assignments, CountInbetweensOfAnInterval) {
  Assignments assignments = example();
  assignments.give(0, {9, 2, kInbetween});
  EXPECT_EQ(assignments.inbetweens(0, 1), 1u);
  EXPECT_EQ(assignments.inbetweens(0, 2), 1u);
  EXPECT_EQ(assignments.inbetweens(2, 1), 0u);
}

TEST(Assignments, FindWhoIsIdleInTurn) {
  Assignments assignments = example();
  EXPECT_EQ(assignments.idle_from(0), 2);
  assignments.give(2, {7, 1, kInbetween});
  EXPECT_EQ(assignments.idle_from(0), std::nullopt);
  assignments.end(strip_of(2, {7, 1, kInbetween}));
  for (const Assignment& picture : {Assignment{4, 1, kKeyframe}, Assignment{5, 1, kInbetween}})
    assignments.end(strip_of(0, picture));
  EXPECT_EQ(assignments.idle_from(1), 2);
  EXPECT_EQ(assignments.idle_from(3), 0) << "after the last comes the first";
  EXPECT_FALSE(assignments.all_idle());
}

}  // namespace
}  // namespace mars::farm
