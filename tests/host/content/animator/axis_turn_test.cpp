// Turns about a joint's own present axes, and what `pose --local` makes of them.
#include "host/content/animator/pose/axis_turn.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "host/content/animator/keys/pose.h"
#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/figure.h"
#include "host/content/animator/reading/read_film.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::animator {
namespace {

using document::holds;

constexpr const char* kFilmOfTurns = R"({
  "frames": 49, "camera": {"eye": [0, -9, 2]},
  "models": {"lamp": {"joints": [
    {"name": "stem"},
    {"name": "left-arm", "parent": "stem", "limits": {"x": [-90, 90], "y": [-90, 90], "z": [-60, 60]}},
    {"name": "right-arm", "parent": "stem", "limits": {"x": [-90, 90], "y": [-90, 90], "z": [-60, 60]}},
    {"name": "hinge", "parent": "stem", "limits": {"y": [-500, 500]}},
    {"name": "skew", "parent": "stem", "y_axis": [0.5, 1, 0]}]}},
  "actors": [{"name": "it", "model": "lamp", "keys": [
    {"frame": 0, "pose": {"stem": [10, 20, 30]}}, {"frame": 20, "pose": {"stem": [40, -50, 60]}},
    {"frame": 24, "pose": {"stem": [50, -50, 60]}}, {"frame": 30, "pose": {"left-arm": [0, 0, 40]}}]}]})";

double distance(const glm::dmat3& a, const glm::dmat3& b) {
  double worst = 0;
  for (int i = 0; i < 3; ++i) worst = std::max(worst, glm::length(a[i] - b[i]));
  return worst;
}

class OwnTurns : public testing::Test {
 protected:
  OwnTurns() { read(); }

  void read() {
    const document::Document document(document::laid_out(json_), "f.json");
    film_ = read_film(document.root(), {});
  }

  Remarks turn(const std::vector<std::string>& settings, FrameRange range, Beyond beyond = Beyond::refused,
               std::uint32_t falloff = 0) {
    const Remarks remarks =
        animator::pose(json_, film_, "it", settings, range, {.beyond = beyond, .falloff = falloff, .local = true});
    read();
    return remarks;
  }

  std::string failure(const std::vector<std::string>& settings, FrameRange range = {40, 40}) {
    return document::failure_of([&] { turn(settings, range); });
  }

  const modeler::Joint& joint(std::size_t number) const { return film_.models[0].joints[number]; }

  glm::dvec3 pose_at(std::size_t number, std::uint32_t frame) const {
    return JointMotion(joint(number), film_.actors[0].motion.pose[number]).pose_at(frame);
  }

  glm::dmat3 turn_at(std::size_t number, std::uint32_t frame) const {
    return modeler::orientation(joint(number), pose_at(number, frame));
  }

  document::Json json_ = document::Json::parse(kFilmOfTurns);
  Film film_;
};

TEST(TurnedAboutOwn, IsTheTurnOnTheRightWithinTheLimitsAndNear) {
  const modeler::Joint& joint = free_joint();
  std::mt19937 dice(5);
  std::uniform_real_distribution<double> angle(-180, 180);
  const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 3'000; ++i) {
    const glm::dvec3 pose(angle(dice), angle(dice) / 2, angle(dice));
    const int axis = i % 3;
    const double degrees = angle(dice);
    const Turned turned = turned_about_own(joint, pose, axis, degrees);
    const glm::dmat3 before = modeler::orientation(joint, pose);
    const glm::dmat3 wanted = before * modeler::rotation_by_degrees(axes[axis], degrees);
    EXPECT_LT(distance(modeler::orientation(joint, turned.pose), wanted), 1e-7);
    EXPECT_TRUE(turned.reached());
    const Turned small = turned_about_own(joint, pose, axis, 1e-4);
    if (std::abs(pose.y) < 80) {
      EXPECT_LT(glm::distance(small.pose, pose), 1e-2) << "the branch of the pose before";
    }
    EXPECT_LT(glm::distance(present_axis(joint, pose, axis), before * axes[axis]), 1e-12);
    const Turned by_axis = turned_about(joint, pose, present_axis(joint, pose, axis), degrees, pose);
    EXPECT_LT(distance(modeler::orientation(joint, by_axis.pose), wanted), 1e-7);
  }
}

// The thesis's Rz Rx; by numbers it is Rx Rz, a third of a whole turn away.
TEST_F(OwnTurns, FollowOneAnother) {
  turn({"stem.x+=0"}, {40, 40});
  animator::pose(json_, film_, "it", std::vector<std::string>{"stem=0,0,90"}, {40, 40}, {});
  read();
  turn({"stem.x+=90"}, {40, 40});
  const glm::dmat3 rz = modeler::rotation_by_degrees({0, 0, 1}, 90), rx = modeler::rotation_by_degrees({1, 0, 0}, 90);
  EXPECT_LT(distance(turn_at(0, 40), rz * rx), 1e-12);
  EXPECT_EQ(pose_at(0, 40), glm::dvec3(0, 90, 90));
  animator::pose(json_, film_, "it", std::vector<std::string>{"stem=0,0,0"}, {40, 40}, {});
  read();
  turn({"stem.z+=90", "stem.x+=90"}, {40, 40});
  EXPECT_LT(distance(turn_at(0, 40), rz * rx), 1e-12) << "also in one command";
}

TEST_F(OwnTurns, AreOfAllMatchingJointsEachAboutItsOwnAxis) {
  const glm::dmat3 left = turn_at(1, 40), right = turn_at(2, 40);
  turn({"*-arm.x+=30"}, {40, 40});
  const glm::dmat3 rx = modeler::rotation_by_degrees({1, 0, 0}, 30);
  EXPECT_LT(distance(turn_at(1, 40), left * rx), 1e-9);
  EXPECT_LT(distance(turn_at(2, 40), right * rx), 1e-9);
  EXPECT_GT(std::abs(pose_at(1, 40).y), 1) << "three numbers changed";
}

TEST_F(OwnTurns, OfAllPartsAreOfThoseThatTurn) {
  const glm::dmat3 stem = turn_at(0, 40), skew = turn_at(4, 40);
  turn({"*.x+=30"}, {40, 40});
  const glm::dmat3 rx = modeler::rotation_by_degrees({1, 0, 0}, 30);
  EXPECT_LT(distance(turn_at(0, 40), stem * rx), 1e-9);
  EXPECT_LT(distance(turn_at(4, 40), skew * rx), 1e-9);
  EXPECT_FALSE(json_["actors"][0]["keys"].back().contains("place"));
  EXPECT_EQ(pose_at(3, 40), glm::dvec3(0)) << "the hinge does not turn about x";
}

TEST_F(OwnTurns, AreOfAllKeysOfARange) {
  std::vector<glm::dmat3> were;
  for (const std::uint32_t frame : {0u, 20u, 24u}) were.push_back(turn_at(0, frame));
  turn({"stem.y-=25"}, {0, 24});
  const glm::dmat3 ry = modeler::rotation_by_degrees({0, 1, 0}, -25);
  for (std::size_t i = 0; const std::uint32_t frame : {0u, 20u, 24u})
    EXPECT_LT(distance(turn_at(0, frame), were[i++] * ry), 1e-8) << frame;
}

// A key beside the frame takes a part of the turn, about its own axis.
TEST_F(OwnTurns, BlendAsTurns) {
  const glm::dmat3 was = turn_at(0, 24);
  turn({"stem.x+=40"}, {20, 20}, Beyond::refused, 8);
  EXPECT_LT(distance(turn_at(0, 24), was * modeler::rotation_by_degrees({1, 0, 0}, 20)), 1e-8);
}

TEST_F(OwnTurns, BlendTheSameWayRoundBeyondHalfATurn) {
  for (const double degrees : {200.0, -300.0, 360.0}) {
    json_ = document::Json::parse(kFilmOfTurns);
    read();
    const glm::dmat3 there = turn_at(0, 20), beside = turn_at(0, 24);
    turn({"stem.y+=" + document::shown(degrees)}, {20, 20}, Beyond::refused, 8);
    EXPECT_LT(distance(turn_at(0, 20), there * modeler::rotation_by_degrees({0, 1, 0}, degrees)), 1e-8);
    EXPECT_LT(distance(turn_at(0, 24), beside * modeler::rotation_by_degrees({0, 1, 0}, degrees / 2)), 1e-8) << degrees;
  }
}

TEST_F(OwnTurns, OfTwoAxesBlendAsTheOneTurnThatTheyMake) {
  const glm::dmat3 was = turn_at(0, 20);
  const glm::dmat3 beside = turn_at(0, 24);
  turn({"stem.x+=30", "stem.z+=40"}, {20, 20}, Beyond::refused, 8);
  const Turn whole = turn_between(glm::transpose(turn_at(0, 20)), glm::transpose(was));
  EXPECT_LT(distance(turn_at(0, 24), beside * modeler::rotation(whole.axis, whole.angle / 2)), 1e-8);
}

TEST_F(OwnTurns, KeepLimitsOrAreClampedByNumber) {
  const std::string said = failure({"left-arm.x+=150"});
  EXPECT_TRUE(holds(said, "joint 'left-arm'")) << said;
  EXPECT_TRUE(holds(said, "turned 150 degrees about its own x, turns ")) << said;
  EXPECT_TRUE(holds(said, "outside its limits") && holds(said, "--clamp")) << said;
  const Remarks remarks = turn({"left-arm.x+=150"}, {40, 40}, Beyond::clamped);
  ASSERT_FALSE(remarks.empty());
  EXPECT_TRUE(holds(remarks[0], "turned 150 degrees about its own x, ") && holds(remarks[0], "keyed as")) << remarks[0];
  EXPECT_EQ(largest_excess(joint(1), pose_at(1, 40)), 0);
}

TEST_F(OwnTurns, OfHingesAreTheirNumber) {
  turn({"hinge.y+=400"}, {40, 40});
  EXPECT_EQ(pose_at(3, 40), glm::dvec3(0, 400, 0));
  EXPECT_TRUE(holds(failure({"hinge.y+=400"}), "outside its limits -500 to 500"));
}

// The number of z turns after that of x: about x as it then stands the first hinge cannot turn.
TEST(TurnedAboutOwn, IsOfAHingeItsNumberOnlyWhereNothingTurnsAfterIt) {
  modeler::Joint hinge;
  hinge.limits = {modeler::Limits{-500, 500}, {0, 0}, {30, 30}};
  const glm::dvec3 pose(10, 0, 30);
  const Turned turned = turned_about_own(hinge, pose, 0, 20);
  const glm::dmat3 wanted = modeler::orientation(hinge, pose) * modeler::rotation_by_degrees({1, 0, 0}, 20);
  EXPECT_LT(distance(modeler::orientation(hinge, turned.pose), wanted), 1e-7);
  EXPECT_GT(largest_excess(hinge, turned.pose), 1) << "which its limits refuse";
  hinge.limits = {modeler::Limits{30, 30}, {-500, 500}, {0, 0}};
  EXPECT_EQ(turned_about_own(hinge, {30, 10, 0}, 1, 400).pose, glm::dvec3(30, 410, 0));
}

TEST_F(OwnTurns, OfAWholeActorAreOfItsTurn) {
  turn({"turn.z+=90", "turn.x+=90"}, {40, 40});
  EXPECT_EQ(film_.actors[0].motion.turn.back().value, glm::dvec3(0, 90, 90));
}

TEST_F(OwnTurns, ThatSkewedAxesDoNotReachAreRefused) {
  const std::vector<std::string> beyond{"skew.y+=90", "skew.x-=24"};
  const std::string said = failure(beyond);
  EXPECT_TRUE(holds(said, "turned -24 degrees about its own x, stands as its skewed axes do not reach")) << said;
  EXPECT_FALSE(turn(beyond, {40, 40}, Beyond::clamped).empty());
}

TEST_F(OwnTurns, AreAboutOneAxisOfAJoint) {
  EXPECT_TRUE(holds(failure({"stem.x=30"}), "with --local write it like elbow.x+=30"));
  EXPECT_TRUE(holds(failure({"stem+=1,2,3"}), "is no turn about one axis"));
  EXPECT_TRUE(holds(failure({"place.x+=3"}), "is no joint that could turn about its own axis"));
}

}  // namespace
}  // namespace mars::animator
