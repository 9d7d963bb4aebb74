// Joints that leave their limits between keys, found where they are known to; and what else is worth a word.
#include "host/content/animator/pose/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/limits_left.h"
#include "host/content/animator/reading/read_film.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/processor_time.h"

namespace mars::animator {
namespace {

Film film_of(const std::string& joint, const std::string& actor) {
  const std::string json =
      R"({"frames": 41, "camera": {"eye": [0, -9, 2]}, "models": {"m": {"joints": [{"name": "j", )" + joint +
      R"(, "segment": {"shape": "box"}}]}}, "actors": [{"name": "a b", "model": "m", )" + actor + "}]}";
  const document::Document document(json, "f.json");
  return read_film(document.root(), {});
}

constexpr const char* kSideways =
    R"("keys": [{"frame": 0, "pose": {"j": [0, 80, 0]}}, {"frame": 40, "pose": {"j": [90, 80, -90]}}])";

// z goes from near x (10 degrees off) a small turn to another such place, and is nearer to x half the way.
TEST(LimitsLeft, TheWorstIsWhereGeometrySaysItIs) {
  const Film film = film_of(R"("limits": {"x": [-180, 180], "y": [-81, 81], "z": [-180, 180]})", kSideways);
  const auto left = limits_left(film);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].worst.axis, 1);
  EXPECT_EQ(left[0].worst.frame, 20u);
  const modeler::Joint& joint = film.models[0].joints[0];
  const Turn turn = turn_between(modeler::orientation(joint, {0, 80, 0}), modeler::orientation(joint, {90, 80, -90}));
  const glm::dmat3 half = modeler::rotation(turn.axis, turn.angle / 2) * modeler::orientation(joint, {0, 80, 0});
  EXPECT_NEAR(left[0].worst.angle, std::asin(half[2][0]) * 180 / std::acos(-1.0), 1e-9) << "z's part along x is sin y";
  EXPECT_GT(left[0].worst.angle, 81);
  const std::string line = check_film(film).lines[0];
  EXPECT_TRUE(document::holds(line, "actor 'a b', joint 'j': turns ")) << line;
  EXPECT_TRUE(document::holds(line, "about y between keys, outside its limits -81 to 81, in frame 20, the worst of"))
      << line;
  EXPECT_TRUE(document::holds(line, "key 'a b' j --frame 20 --clamp")) << line;
  const auto warnings = warnings_of(film);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].starts_with("f.json: actor 'a b', joint 'j': turns ")) << warnings[0];
  EXPECT_TRUE(document::holds(warnings[0], "outside its limits -81 to 81, in frame 20 (")) << warnings[0];
  EXPECT_TRUE(document::holds(warnings[0], "mars animate f.json key 'a b' j --frame 20 --clamp")) << warnings[0];
}

TEST(LimitsLeft, NoneWhereTheyAreWideEnough) {
  EXPECT_TRUE(
      limits_left(film_of(R"("limits": {"x": [-180, 180], "y": [-90, 90], "z": [-180, 180]})", kSideways)).empty());
  EXPECT_TRUE(warnings_of(film_of(R"("limits": {"x": [0, 0], "y": [-81, 81], "z": [0, 0]})",
                                  R"("keys": [{"frame": 0, "pose": {"j": [0, 80, 0]}},
                                              {"frame": 40, "pose": {"j": [0, -80, 0]}}])"))
                  .empty());
}

TEST(LimitsLeft, ALockedAxisOfAJointWithTwoFreedomsTurnsOnTheWay) {
  const Film film =
      film_of(R"("limits": {"x": [-90, 90], "y": [-90, 90], "z": [0, 0]})",
              R"("keys": [{"frame": 0, "pose": {"j": [60, 0, 0]}}, {"frame": 20, "pose": {"j": [0, 60, 0]}}])");
  const auto left = limits_left(film);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].worst.axis, 2);
  EXPECT_EQ(left[0].first, 1u);
  EXPECT_EQ(left[0].last, 19u);
  EXPECT_EQ(left[0].frames, 19u);
  // The frames' angles, found without the inverse: the only z that undoes the rest of the turn.
  const modeler::Joint& joint = film.models[0].joints[0];
  JointMotion motion(joint, film.actors[0].motion.pose[0]);
  const glm::dvec3 pose = motion.pose_at(left[0].worst.frame);
  EXPECT_NEAR(pose.z, left[0].worst.angle, 1e-12);
  EXPECT_LT(turn_between(modeler::orientation(joint, pose), motion.at(left[0].worst.frame)).angle, 1e-9);
}

// y stands 45 degrees from x, so z never comes nearer to x than 45 degrees. The keys turn it there and as far
// beyond, through x itself.
TEST(LimitsLeft, SkewedAxesThatDoNotReachAreTold) {
  Film film = film_of(R"("y_axis": [1, 1, 0])",
                      R"("keys": [{"frame": 0, "pose": {"j": [0, 85, 0]}}, {"frame": 40, "pose": {"j": [0, 0, 0]}}])");
  const modeler::Joint& joint = film.models[0].joints[0];
  const glm::dmat3 first = modeler::orientation(joint, {0, 85, 0});
  const glm::dvec3 axis = glm::normalize(glm::cross(first[2], glm::dvec3(1, 0, 0)));
  const double to_x = std::acos(first[2].x);
  film.actors[0].motion.pose[0][1].value = pose_of(joint, modeler::rotation(axis, 2 * to_x) * first, {180, 85, 0});
  const auto left = limits_left(film);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].worst.axis, 3);
  EXPECT_EQ(left[0].worst.frame, 20u);
  EXPECT_NEAR(left[0].worst.angle, 45, 0.1);
  EXPECT_TRUE(document::holds(check_film(film).lines[0], "its skewed axes do not reach"));
}

TEST(LimitsLeft, AKeyThereMendsIt) {
  const Film film =
      film_of(R"("limits": {"x": [-180, 180], "y": [-81, 81], "z": [-180, 180]})",
              R"("keys": [{"frame": 0, "pose": {"j": [0, 80, 0]}}, {"frame": 20, "pose": {"j": [45, 81, 0]}},
                                        {"frame": 40, "pose": {"j": [90, 80, 0]}}])");
  for (const LimitsLeft& left : limits_left(film)) EXPECT_LT(left.worst.angle, 81.5);
}

// Every frame looked at is the twin of the search.
TEST(LimitsLeft, TheWorstIsFoundWithoutLookingAtEveryFrame) {
  std::mt19937 random(7);
  const auto number = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  const char* const limits[] = {R"("limits": {"x": [-90, 90], "y": [-80, 80], "z": [-90, 90]})",
                                R"("limits": {"x": [-60, 120], "y": [0, 170], "z": [-200, 200]})",
                                R"("limits": {"x": [-90, 90], "y": [-90, 90], "z": [20, 20]})",
                                R"("y_axis": [0.3, 1, 0], "limits": {"x": [-90, 90], "y": [-80, 80], "z": [-90, 90]})"};
  const Ease eases[] = {kLinear, kBoth, kHold, swinging(0.2, 0.3)};
  int outside = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Film film = film_of(limits[trial % 4], R"("keys": [{"frame": 0, "pose": {"j": [0, 10, 20]}}])");
    film.frames = 1 + std::uint32_t(number(10, 90));  // some end between keys
    const modeler::Joint& joint = film.models[0].joints[0];
    Channel<glm::dvec3>& poses = film.actors[0].motion.pose[0];
    poses.clear();
    for (std::uint32_t frame = 0; frame < 80; frame += 1 + std::uint32_t(number(0, 40))) {
      glm::dvec3 pose;
      for (int axis = 0; axis < 3; ++axis) pose[axis] = number(joint.limits[axis].lower, joint.limits[axis].upper);
      poses.push_back({frame, pose, eases[trial / 4 % 4]});
    }
    const auto all = limits_left(film);
    const auto worst = worst_excesses(film);
    const double excess = all.empty() ? 0 : all[0].worst.outside;
    outside += excess > kExcessSeen;
    ASSERT_EQ(worst.size(), excess > kExcessSeen ? 1u : 0u) << trial << ": " << excess;
    for (const WorstExcess& each : worst) EXPECT_NEAR(each.outside, excess, 0.01) << trial;
  }
  EXPECT_GT(outside, 100);
  EXPECT_LT(outside, 390);
}

TEST(Warnings, OfALongFilmTakeNoTime) {
  Film film = film_of(R"("limits": {"x": [-90, 90], "y": [-81, 81], "z": [-90, 90]})", kSideways);
  film.frames = 1'000'000;
  film.actors[0].motion.pose[0][1].frame = 999'999;
  film.actors.resize(400, film.actors[0]);
  // Frame by frame it would be 400 million poses, minutes.
  const test::ProcessorTime time;
  const auto lines = warnings_of(film);
  EXPECT_LT(time.seconds(), 5);
  ASSERT_EQ(lines.size(), 11u);
  EXPECT_EQ(lines[10], "f.json: 390 more joints leave their limits between keys (mars animate f.json check lists all)");
}

TEST(Check, TellsKeysBehindTheEndAndThoseThatDoNothing) {
  const auto lines =
      check_film(film_of(R"("limits": {"x": [0, 9]})",
                         R"("keys": [{"frame": 3, "place": [1, 1, 1]}, {"frame": 50, "place": [1, 1, 1]}])"))
          .lines;
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(document::holds(lines[0], "actor 'a b': has keys up to frame 50, behind the film's last, 40"))
      << lines[0];
  EXPECT_TRUE(document::holds(lines[1], "never moves")) << lines[1];
}

TEST(Check, WhatNobodySeesIsOneLineAndNoTrouble) {
  const Film film =
      film_of(R"("limits": {"x": [-90, 90], "y": [-90, 90], "z": [0, 0]})",
              R"("keys": [{"frame": 0, "pose": {"j": [8, 0, 0]}}, {"frame": 20, "pose": {"j": [0, 8, 0]}}])");
  const Findings findings = check_film(film);
  EXPECT_FALSE(findings.trouble);
  ASSERT_EQ(findings.lines.size(), 1u);
  EXPECT_TRUE(document::holds(findings.lines[0], "1 joint is outside its limits between keys by less than"))
      << findings.lines[0];
  EXPECT_TRUE(warnings_of(film).empty());
}

TEST(Check, NamesAMissingSoundAndItsRepair) {
  Film film = film_of(R"("limits": {"x": [0, 9]})", R"("place": [0, 0, 0])");
  film.audio = "/nowhere/gone.wav";
  const Findings findings = check_film(film);
  EXPECT_TRUE(findings.trouble);
  ASSERT_EQ(findings.lines.size(), 1u);
  EXPECT_EQ(findings.lines[0],
            "audio: is '/nowhere/gone.wav', which does not exist: no video can be made (name another file: mars film "
            "f.json set audio=FILE)");
  EXPECT_EQ(warnings_of(film), std::vector<std::string>{"f.json: " + findings.lines[0]});
  film.audio = "/";
  EXPECT_TRUE(document::holds(check_film(film).lines[0], "which is not a regular file"));
}

TEST(Check, TellsJumps) {
  const auto lines_of = [](const char* keys) {
    return check_film(film_of(R"("limits": {"x": [0, 9]})", "\"keys\": [" + std::string(keys) + "]")).lines;
  };
  const std::vector<std::string> lines = lines_of(R"({"frame": 3, "place": [1, 1, 1]},
      {"frame": 4, "place": [1, 1, 4]}, {"frame": 9, "place": [1, 1, 5]})");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "actor 'a b': jumps 3 from frame 3 to the next, farther than it is long");
  // There and back.
  EXPECT_EQ(lines_of(R"({"frame": 3, "place": [1, 1, 1]}, {"frame": 4, "place": [1, 1, 4]},
      {"frame": 5, "place": [1, 1, 1]})")
                .size(),
            2u);
}

TEST(Check, TwoLeapsInARowAreNoFlight) {
  const Film film = film_of(R"("limits": {"x": [0, 9]})", R"("keys": [{"frame": 10, "place": [0, 0, 0]},
      {"frame": 11, "place": [100, 0, 0]}, {"frame": 12, "place": [200, 0, 0]}])");
  EXPECT_EQ(check_film(film).lines.size(), 2u);
}

TEST(Check, CallsNoFlightAJump) {
  // Thrown from rest at three units a frame, against a wall between two frames, and caught.
  const Film film = film_of(R"("limits": {"x": [0, 9]})", R"("keys": [{"frame": 2, "place": [0, 0, 0]},
      {"frame": 3, "place": [3, 0, 1]}, {"frame": 4, "place": [6, 0, 1.5]}, {"frame": 5, "place": [9, 0, 1.6]},
      {"frame": 6, "place": [10.3, 0, 1.5]}, {"frame": 7, "place": [7.9, 0, 1]}, {"frame": 8, "place": [5.5, 0, 0]}])");
  EXPECT_EQ(check_film(film).lines, std::vector<std::string>{});
}

}  // namespace
}  // namespace mars::animator
