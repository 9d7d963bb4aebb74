// From orientations back to poses: round trips over all poses, known answers where two ways lead there.
#include "host/content/animator/pose/angles.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "host/content/animator/pose/figure.h"

namespace mars::animator {
namespace {

modeler::Joint joint_of(modeler::Limits x, modeler::Limits y, modeler::Limits z, const glm::dvec3& y_axis = {0, 1, 0}) {
  modeler::Joint joint;
  joint.y_axis = glm::normalize(y_axis);
  joint.limits = {x, y, z};
  return joint;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double most = 1e-9) {
  EXPECT_LE(glm::length(a - b), most) << a.x << " " << a.y << " " << a.z << ", not " << b.x << " " << b.y << " " << b.z;
}

double turn_distance(const glm::dmat3& a, const glm::dmat3& b) {
  double worst = 0;
  for (int i = 0; i < 3; ++i) worst = std::max(worst, glm::length(a[i] - b[i]));
  return worst;
}

class RoundTrip : public testing::TestWithParam<glm::dvec3> {};

TEST_P(RoundTrip, EveryPoseComesBack) {
  const modeler::Joint joint = joint_of({-180, 180}, {-180, 180}, {-180, 180}, GetParam());
  std::mt19937 dice(7);
  std::uniform_real_distribution<double> angle(-180, 180);
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec3 pose(angle(dice), angle(dice), angle(dice));
    const glm::dmat3 turn = modeler::orientation(joint, pose);
    expect_near(pose_of(joint, turn, pose), pose, 1e-6);
    const glm::dvec3 far = pose_of(joint, turn, {angle(dice), angle(dice), angle(dice)});
    EXPECT_LT(turn_distance(modeler::orientation(joint, far), turn), 1e-7)
        << "whatever it is near to, it is a way there";
    EXPECT_EQ(largest_excess(joint, far), 0) << far.x << " " << far.y << " " << far.z;
  }
}

INSTANTIATE_TEST_SUITE_P(Axes, RoundTrip,
                         testing::Values(glm::dvec3(0, 1, 0), glm::dvec3(0.3, 1, 0), glm::dvec3(-0.9, 0.4, 0.3)));

TEST(PoseOf, PosesAtAQuarterTurnComeBackToo) {
  const modeler::Joint joint = joint_of({-180, 180}, {-180, 180}, {-180, 180});
  for (const glm::dvec3& pose : {glm::dvec3(20, 90, 30), glm::dvec3(-50, -90, 10), glm::dvec3(0, 90, 0),
                                 glm::dvec3(20, 89.9999999, 30), glm::dvec3(20, 90.001, 30)})
    expect_near(pose_of(joint, modeler::orientation(joint, pose), pose), pose, 1e-6);
}

TEST(PoseOf, TakesTheWayThatLimitsAllow) {
  const modeler::Joint wide = joint_of({-180, 180}, {-180, 180}, {-180, 180});
  const glm::dmat3 turn = modeler::orientation(wide, {10, 100, 20});
  expect_near(pose_of(wide, turn, {0, 90, 0}), {10, 100, 20});
  expect_near(pose_of(joint_of({-180, 180}, {-90, 90}, {-180, 180}), turn, {0, 90, 0}), {-170, 80, -160});
  expect_near(pose_of(joint_of({-30, 30}, {-90, 90}, {-30, 30}), turn, {0, 90, 0}), {10, 100, 20});
}

TEST(PoseOf, AddsWholeTurnsWhereLimitsAskForThem) {
  const modeler::Joint joint = joint_of({0, 0}, {0, 0}, {350, 800});
  const glm::dmat3 turn = modeler::orientation(joint, {0, 0, 20});
  expect_near(pose_of(joint, turn, {0, 0, 400}), {0, 0, 380});
  expect_near(pose_of(joint, turn, {0, 0, 2000}), {0, 0, 740});
}

TEST(PoseOf, WhereTwoTurnsAreOneTheySplitAsLimitsAllow) {
  const modeler::Joint joint = joint_of({-30, 30}, {-90, 90}, {-30, 30});
  const glm::dmat3 turn = modeler::orientation(joint, {25, 90, 25});
  const glm::dvec3 pose = pose_of(joint, turn, {0, 90, 0});
  EXPECT_NEAR(pose.x + pose.z, 50, 1e-9);
  EXPECT_EQ(largest_excess(joint, pose), 0);
}

TEST(PoseOf, SkewedAxesThatDoNotReachComeNear) {
  const modeler::Joint joint = joint_of({-180, 180}, {-180, 180}, {-180, 180}, {0.5, 1, 0});
  const glm::dmat3 turn =
      modeler::orientation(joint_of({}, {}, {}), {0, 90, 0});  // takes z to x, nearer than y's turns do
  const glm::dvec3 pose = pose_of(joint, turn, {0, 0, 0});
  EXPECT_NEAR(pose.y, 90, 1e-9);
  EXPECT_LT(turn_distance(modeler::orientation(joint, pose), turn), 0.6);
}

TEST(Excess, IsDegreesOutsideTheLimits) {
  const modeler::Joint joint = joint_of({0, 10}, {-5, 5}, {0, 0});
  EXPECT_EQ(excess_of(joint, {12, -9, 0}), glm::dvec3(2, 4, 0));
  EXPECT_EQ(largest_excess(joint, {12, -9, 0}), 4);
  EXPECT_EQ(clamped(joint, {12, -9, 3}), glm::dvec3(10, -5, 0));
}

}  // namespace
}  // namespace mars::animator
