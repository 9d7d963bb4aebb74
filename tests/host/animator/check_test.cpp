// Joints that leave their limits between keys, found where they are known to; and what else is worth a word.
#include "host/animator/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "host/animator/angles.h"
#include "host/animator/read_film.h"
#include "tests/host/document/failure_of.h"

namespace mars::host {
namespace {

Film film_of(const std::string& joint, const std::string& actor) {
  const std::string json =
      R"({"frames": 41, "camera": {"eye": [0, -9, 2]}, "models": {"m": {"joints": [{"name": "j", )" + joint +
      R"(, "segment": {"shape": "box"}}]}}, "actors": [{"name": "a b", "model": "m", )" + actor + "}]}";
  const Document document(json, "f.json");
  return read_film(document.root(), {});
}

constexpr const char* kSideways =
    R"("keys": [{"frame": 0, "pose": {"j": [0, 80, 0]}}, {"frame": 40, "pose": {"j": [90, 80, -90]}}])";

// z goes from near x (10 degrees off) a small turn to another such place, and is nearer to x half the way.
TEST(LimitsLeft, TheWorstIsWhereGeometrySaysItIs) {
  const Film film = film_of(R"("limits": {"x": [-180, 180], "y": [-81, 81], "z": [-180, 180]})", kSideways);
  const auto left = limits_left(film);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].axis, 1);
  EXPECT_EQ(left[0].worst, 20u);
  const Joint& joint = film.models[0].joints[0];
  const Turn turn = turn_between(orientation(joint, {0, 80, 0}), orientation(joint, {90, 80, -90}));
  const glm::dmat3 half = rotation(turn.axis, turn.angle / 2) * orientation(joint, {0, 80, 0});
  EXPECT_NEAR(left[0].angle, std::asin(half[2][0]) * 180 / std::acos(-1.0), 1e-9) << "z's part along x is sin y";
  EXPECT_GT(left[0].angle, 81);
  const std::string line = check_film(film).lines[0];
  EXPECT_TRUE(holds(line, "actor 'a b', joint 'j': turns ")) << line;
  EXPECT_TRUE(holds(line, "about y between keys, outside its limits -81 to 81, in frame 20, the worst of")) << line;
  EXPECT_TRUE(holds(line, "key 'a b' j --frame 20 --clamp")) << line;
  EXPECT_TRUE(holds(limits_remark(film), "f.json: 1 joint leaves its limits between keys"));
}

TEST(LimitsLeft, NoneWhereTheyAreWideEnough) {
  EXPECT_TRUE(
      limits_left(film_of(R"("limits": {"x": [-180, 180], "y": [-90, 90], "z": [-180, 180]})", kSideways)).empty());
  EXPECT_EQ(limits_remark(film_of(
                R"("limits": {"x": [0, 0], "y": [-81, 81], "z": [0, 0]})",
                R"("keys": [{"frame": 0, "pose": {"j": [0, 80, 0]}}, {"frame": 40, "pose": {"j": [0, -80, 0]}}])")),
            "");
}

TEST(LimitsLeft, ALockedAxisOfAJointWithTwoFreedomsTurnsOnTheWay) {
  const Film film =
      film_of(R"("limits": {"x": [-90, 90], "y": [-90, 90], "z": [0, 0]})",
              R"("keys": [{"frame": 0, "pose": {"j": [60, 0, 0]}}, {"frame": 20, "pose": {"j": [0, 60, 0]}}])");
  const auto left = limits_left(film);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].axis, 2);
  EXPECT_EQ(left[0].first, 1u);
  EXPECT_EQ(left[0].last, 19u);
  EXPECT_EQ(left[0].frames, 19u);
  // The frames' angles, found without the inverse: the only z that undoes the rest of the turn.
  const Joint& joint = film.models[0].joints[0];
  JointMotion motion(joint, film.actors[0].motion.pose[0]);
  const glm::dvec3 pose = motion.pose_at(left[0].worst);
  EXPECT_NEAR(pose.z, left[0].angle, 1e-12);
  EXPECT_LT(turn_between(orientation(joint, pose), motion.at(left[0].worst)).angle, 1e-9);
}

// y stands 45 degrees from x, so z never comes nearer to x than 45 degrees. The keys turn it there and as far
// beyond, through x itself.
TEST(LimitsLeft, SkewedAxesThatDoNotReachAreTold) {
  Film film = film_of(R"("y_axis": [1, 1, 0])",
                      R"("keys": [{"frame": 0, "pose": {"j": [0, 85, 0]}}, {"frame": 40, "pose": {"j": [0, 0, 0]}}])");
  const Joint& joint = film.models[0].joints[0];
  const glm::dmat3 first = orientation(joint, {0, 85, 0});
  const glm::dvec3 axis = glm::normalize(glm::cross(first[2], glm::dvec3(1, 0, 0)));
  const double to_x = std::acos(first[2].x);
  film.actors[0].motion.pose[0][1].value = pose_of(joint, rotation(axis, 2 * to_x) * first, {180, 85, 0});
  const auto left = limits_left(film);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].axis, 3);
  EXPECT_EQ(left[0].worst, 20u);
  EXPECT_NEAR(left[0].angle, 45, 0.1);
  EXPECT_TRUE(holds(check_film(film).lines[0], "its skewed axes do not reach"));
}

TEST(LimitsLeft, AKeyThereMendsIt) {
  const Film film =
      film_of(R"("limits": {"x": [-180, 180], "y": [-81, 81], "z": [-180, 180]})",
              R"("keys": [{"frame": 0, "pose": {"j": [0, 80, 0]}}, {"frame": 20, "pose": {"j": [45, 81, 0]}},
                                        {"frame": 40, "pose": {"j": [90, 80, 0]}}])");
  for (const LimitsLeft& left : limits_left(film)) EXPECT_LT(left.angle, 81.5);
}

TEST(Check, TellsKeysBehindTheEndAndThoseThatDoNothing) {
  const auto lines =
      check_film(film_of(R"("limits": {"x": [0, 9]})",
                         R"("keys": [{"frame": 3, "place": [1, 1, 1]}, {"frame": 50, "place": [1, 1, 1]}])"))
          .lines;
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(holds(lines[0], "actor 'a b': has keys up to frame 50, behind the film's last, 40")) << lines[0];
  EXPECT_TRUE(holds(lines[1], "never moves")) << lines[1];
}

TEST(Check, WhatNobodySeesIsOneLineAndNoTrouble) {
  const Film film =
      film_of(R"("limits": {"x": [-90, 90], "y": [-90, 90], "z": [0, 0]})",
              R"("keys": [{"frame": 0, "pose": {"j": [8, 0, 0]}}, {"frame": 20, "pose": {"j": [0, 8, 0]}}])");
  const Findings findings = check_film(film);
  EXPECT_FALSE(findings.trouble);
  ASSERT_EQ(findings.lines.size(), 1u);
  EXPECT_TRUE(holds(findings.lines[0], "1 joint is outside its limits between keys by less than")) << findings.lines[0];
  EXPECT_EQ(limits_remark(film), "");
}

TEST(Check, TellsJumps) {
  const Film film = film_of(R"("limits": {"x": [0, 9]})", R"("keys": [{"frame": 3, "place": [1, 1, 1]},
      {"frame": 4, "place": [1, 1, 4]}, {"frame": 9, "place": [1, 1, 40]}])");
  const auto lines = check_film(film).lines;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "actor 'a b': jumps 3 from frame 3 to the next, farther than it is long");
}

}  // namespace
}  // namespace mars::host
