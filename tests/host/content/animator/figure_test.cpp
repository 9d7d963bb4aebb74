#include "host/content/animator/pose/figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "tests/host/content/document/failure_of.h"

namespace mars::animator {
namespace {

modeler::Joint joint_at(std::size_t parent, const glm::dvec3& place) {
  modeler::Joint joint;
  joint.name = "j";
  joint.parent = parent;
  joint.place = place;
  return joint;
}

// Upper arm, fore arm and hand, each one long in x, at rest.
struct Arm {
  modeler::Model model{
      {joint_at(modeler::kNone, {0, 0, 0}), joint_at(0, {1, 0, 0}), joint_at(1, {1, 0, 0})}, {}, {}, {}};
  FigureMotion motion{constant(glm::dvec3(0)), constant(glm::dvec3(0)), std::vector<Channel<glm::dvec3>>(3)};

  void key(std::size_t joint, std::uint32_t frame, const glm::dvec3& pose, const Ease& ease = kLinear) {
    motion.pose[joint].push_back({frame, pose, ease});
  }
};

double distance(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

double difference(const glm::dmat3& a, const glm::dmat3& b) {
  return std::max({glm::length(a[0] - b[0]), glm::length(a[1] - b[1]), glm::length(a[2] - b[2])});
}

TEST(Orientation, TurnsAboutXThenYThenZAsAlreadyTurned) {
  modeler::Joint joint;
  EXPECT_EQ(modeler::orientation(joint, {90, 90, 0}) * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
  EXPECT_EQ(modeler::orientation(joint, {0, 90, 90}) * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
  EXPECT_EQ(modeler::orientation(joint, {90, 0, 90}) * glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1));
}

TEST(Orientation, SkewAxesStillTurnRigidly) {
  modeler::Joint joint;
  joint.y_axis = glm::normalize(glm::dvec3(1, 1, 0));
  const glm::dmat3 turn = modeler::orientation(joint, {20, 30, 40});
  EXPECT_LT(difference(turn * glm::transpose(turn), glm::dmat3(1)), 1e-15);
  const double angle = 30 * std::acos(-1.0) / 180;
  EXPECT_LT(difference(modeler::orientation(joint, {0, 30, 0}), glm::mat3_cast(glm::angleAxis(angle, joint.y_axis))),
            1e-15);
}

TEST(Limits, BoundExactlyTheThreeNumbers) {
  modeler::Joint joint;
  joint.limits = {{{0, 0}, {-10, 150}, {-180, 180}}};
  EXPECT_FALSE(broken_limit(joint, {0, 150, -180}));
  EXPECT_EQ(*broken_limit(joint, {0, 150.5, 0}), "turns 150.5 degrees about y, outside its limits -10 to 150");
  EXPECT_TRUE(document::holds(*broken_limit(joint, {1e-9, 0, 0}), "its x axis is locked at 0, not 1e-09"));
}

TEST(SegmentFrame, SkewAxesShearTheSegmentButNoChild) {
  Arm arm;
  arm.model.joints[0].y_axis = glm::normalize(glm::dvec3(1, 1, 0));
  Figure figure(arm.model, arm.motion);
  figure.move_to(0);
  const modeler::Axes sheared = modeler::segment_frame(figure.frame_of(0), arm.model.joints[0]);
  EXPECT_LT(distance(sheared.turn * glm::dvec3(0, 1, 0), {std::sqrt(0.5), std::sqrt(0.5), 0}), 1e-15);
  EXPECT_LT(distance(sheared.turn * glm::dvec3(0, 0, 1), {0, 0, std::sqrt(0.5)}), 1e-15) << "Z = X x Y";
  EXPECT_EQ(figure.frame_of(1).turn, glm::dmat3(1));
}

TEST(TMatrix, TakesTheUnitCubeToTheBox) {
  const wire::Matrix matrix = modeler::t_matrix({glm::dmat3(1), {10, 0, 0}}, {{-1, -2, 3}, {1, 2, 7}});
  EXPECT_EQ(matrix.m[0], (std::array<double, 4>{2, 0, 0, 9}));
  EXPECT_EQ(matrix.m[1], (std::array<double, 4>{0, 4, 0, -2}));
  EXPECT_EQ(matrix.m[2], (std::array<double, 4>{0, 0, 4, 3}));
}

TEST(Figure, LimbsNeverComeApart) {
  Arm arm;
  for (std::size_t joint = 0; joint < 3; ++joint) {
    arm.key(joint, 0, {10, -170, 33});
    arm.key(joint, 7, {-80, 20, 179}, kBoth);
    arm.key(joint, 20, {180, 1, -90});
  }
  Figure figure(arm.model, arm.motion);
  for (std::uint32_t frame = 0; frame < 25; ++frame) {
    figure.move_to(frame);
    for (const std::size_t joint : {1u, 2u}) {
      EXPECT_NEAR(distance(figure.frame_of(joint).place, figure.frame_of(joint - 1).place), 1, 1e-14);
      const modeler::Axes& parent = figure.frame_of(joint - 1);
      EXPECT_LT(distance(figure.frame_of(joint).place, parent.turn * glm::dvec3(1, 0, 0) + parent.place), 1e-14);
    }
  }
}

TEST(Figure, FreeJointsFollowSlerpBetweenKeys) {
  Arm arm;
  arm.key(1, 0, {10, 20, 30});
  arm.key(1, 10, {-100, 60, 150});
  Figure figure(arm.model, arm.motion);
  const modeler::Joint& joint = arm.model.joints[1];
  const glm::dquat first = glm::quat_cast(modeler::orientation(joint, {10, 20, 30}));
  const glm::dquat last = glm::quat_cast(modeler::orientation(joint, {-100, 60, 150}));
  for (std::uint32_t frame = 0; frame <= 10; ++frame) {
    figure.move_to(frame);
    EXPECT_LT(difference(figure.frame_of(1).turn, glm::mat3_cast(glm::slerp(first, last, frame / 10.0))), 1e-12);
  }
}

TEST(Figure, HingesMakeWholeTurnsAndKeepTheirLimits) {
  Arm arm;
  arm.model.joints[0].limits = {{{0, 0}, {0, 0}, {-30, 720}}};
  arm.key(0, 0, {0, 0, 0}, {0.5, -2, 0.5, 3});
  arm.key(0, 8, {0, 0, 720});
  arm.model.joints[1].limits = {{{0, 0}, {-720, 720}, {0, 0}}};
  arm.key(1, 0, {0, 0, 0});
  arm.key(1, 8, {0, 720, 0});
  Figure figure(arm.model, arm.motion);
  figure.move_to(1);
  EXPECT_GE(std::atan2(figure.frame_of(0).turn[0].y, figure.frame_of(0).turn[0].x), -30.0001 * std::acos(-1.0) / 180)
      << "an ease that swings back stops at the limit";
  JointMotion hinge(arm.model.joints[1], arm.motion.pose[1]);
  for (std::uint32_t frame = 0; frame <= 8; ++frame)
    EXPECT_EQ(hinge.at(frame), modeler::orientation(arm.model.joints[1], {0, 90.0 * frame, 0}));
}

TEST(Figure, FramesDoNotDependOnTheOrderAskedFor) {
  Arm arm;
  arm.key(0, 0, {10, 20, 30}, kIn);
  arm.key(0, 50, {-100, 60, 150}, kOut);
  arm.key(0, 100, {0, 0, 0});
  arm.motion.place = {{0, {0, 0, 0}, kBoth}, {100, {5, 6, 7}, kLinear}};
  Figure forward(arm.model, arm.motion), backward(arm.model, arm.motion);
  std::vector<modeler::Axes> seen;
  for (std::uint32_t frame = 0; frame <= 100; ++frame) {
    forward.move_to(frame);
    seen.push_back(forward.frame_of(2));
  }
  for (std::uint32_t frame = 101; frame-- > 0;) {
    backward.move_to(frame);
    EXPECT_EQ(backward.frame_of(2).turn, seen[frame].turn);
    EXPECT_EQ(backward.frame_of(2).place, seen[frame].place);
  }
}

TEST(Figure, TellsWhatMoved) {
  Arm arm;
  arm.key(1, 5, {0, 0, 0});
  arm.key(1, 7, {0, 0, 90});
  Figure figure(arm.model, arm.motion);
  EXPECT_TRUE(figure.move_to(0));
  EXPECT_FALSE(figure.move_to(5));
  EXPECT_TRUE(figure.move_to(6));
  EXPECT_FALSE(figure.moved(0));
  EXPECT_TRUE(figure.moved(1));
  EXPECT_TRUE(figure.moved(2)) << "children go with their parents";
  EXPECT_TRUE(figure.move_to(7));
  EXPECT_FALSE(figure.move_to(8));
}

// A ball joint that keys take from 0 to 80 degrees about y and its limits stop at 90.
struct Ball {
  modeler::Joint joint;
  Channel<glm::dvec3> poses;

  explicit Ball(const Ease& ease) : poses{{0, {0, 0, 0}, ease}, {100, {0, 80, 0}, kLinear}} {
    joint.limits = {{{-45, 45}, {-5, 90}, {-45, 45}}};
  }
};

TEST(JointMotion, AnOvershootOfABallJointStopsAtItsLimits) {
  Ball ball(swinging(0.5, 0.5));
  JointMotion motion(ball.joint, ball.poses);
  double lowest = 0, highest = 0;
  for (std::uint32_t frame = 0; frame <= 100; ++frame) {
    const glm::dvec3 pose = motion.pose_at(frame);
    lowest = std::min(lowest, pose.y);
    highest = std::max(highest, pose.y);
  }
  EXPECT_NEAR(lowest, -5, 1e-4);
  EXPECT_NEAR(highest, 90, 1e-4);
}

TEST(JointMotion, WithinTheLimitsAnOvershootIsWhole) {
  Ball ball(swinging(0.05, 0.1));
  JointMotion motion(ball.joint, ball.poses);
  double lowest = 0, highest = 0;
  for (std::uint32_t frame = 0; frame <= 100; ++frame) {
    lowest = std::min(lowest, motion.pose_at(frame).y);
    highest = std::max(highest, motion.pose_at(frame).y);
  }
  EXPECT_NEAR(lowest, -4, 0.02);
  EXPECT_NEAR(highest, 88, 0.02);
}

TEST(JointMotion, ItsPoseGivesItsOrientation) {
  Ball ball(kBoth);
  ball.poses[1].value = {40, 60, -30};
  JointMotion motion(ball.joint, ball.poses), same(ball.joint, ball.poses);
  for (std::uint32_t frame = 0; frame <= 100; ++frame)
    EXPECT_LT(difference(modeler::orientation(ball.joint, motion.pose_at(frame)), same.at(frame)), 1e-12) << frame;
  EXPECT_EQ(motion.pose_at(100), ball.poses[1].value);
}

}  // namespace
}  // namespace mars::animator
