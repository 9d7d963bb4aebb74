// Figures of other programs in MARS's motions: arms hang that are drawn held out, and joints that are no limbs come
// back from where an action takes them.
#include "tests/host/content/animator/motion/strangers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/motion/body/arms.h"
#include "host/content/animator/motion/body/body.h"
#include "host/content/animator/pose/joint_frames.h"

namespace mars::motion {
namespace {

constexpr double kArmLength = 54;  // from shoulder to wrist

std::size_t joint_of(const modeler::Model& model, const std::string& name) {
  std::size_t joint = 0;
  while (model.joints.at(joint).name != name) ++joint;
  return joint;
}

document::Json film_with_ball() {
  document::Json film = film_with(stranger());
  film["models"]["ball"] = {
      {"joints", document::Json::array({jointed("ball", "", {0, 0, 0}, {}, {{-6, -6, -6}, {6, 6, 6}}, "sphere")})}};
  const glm::dvec3 place = glm::dvec3(1, 2, 0) + canonical_turn(0, 0, 30) * glm::dvec3(30, -20, 6);
  film["actors"].push_back({{"name", "ball"}, {"model", "ball"}, {"place", {place.x, place.y, place.z}}});
  return film;
}

// How far the wrist is below the shoulder.
double hangs(const animator::Film& film, const std::string& side, std::uint32_t frame) {
  animator::JointFrames frames(film);
  const modeler::Model& model = film.models[film.actors[0].model];
  return frames.frame_of(0, joint_of(model, side + "-arm"), frame).place.z -
         frames.frame_of(0, joint_of(model, side + "-hand"), frame).place.z;
}

TEST(Strangers, JointsBetweenLimbsMoveSmoothlyAndComeBack) {
  document::Json json = film_with_ball();
  const Performed picked = act(json, "pick what ball", 0);
  const Performed walked = act(json, "walk steps 2");
  const animator::Film film = read(json);
  const modeler::Model& model = film.models[film.actors[0].model];
  double most = 0;
  for (const char* name : {"spine1", "left-collar", "right-collar"}) {
    const std::size_t joint = joint_of(model, name);
    glm::dvec3 before(0);
    for (std::uint32_t frame = 0; frame <= walked.last; ++frame) {
      const glm::dvec3 pose = posture_at(model, film.actors[0].motion, frame).pose[joint];
      EXPECT_LT(glm::distance(pose, before), 4) << name << " " << frame;
      EXPECT_LT(glm::length(pose), frame < picked.last ? 90 : 1e-6) << name << " " << frame;
      most = std::max(most, glm::length(pose));
      before = pose;
    }
  }
  EXPECT_GT(most, 0.5) << "none of them helps";
}

TEST(Strangers, WalksEndWithAStraightBackWhateverReachedBefore) {
  document::Json json = film_with_ball();
  act(json, "reach to 40 0 70", 0);
  act(json, "walk steps 2");
  const animator::Film film = read(json);
  const modeler::Model& model = film.models[film.actors[0].model];
  const Posture end = posture_at(model, film.actors[0].motion, animator::last_key(film.actors[0].motion));
  for (const char* name : {"spine1", "left-collar", "right-collar"})
    EXPECT_LT(glm::length(end.pose[joint_of(model, name)]), 1e-6) << name;
}

TEST(Strangers, ArmsThatAreDrawnHeldOutHangFromTheBeginning) {
  for (const char* action : {"wave hand left", "walk steps 2", "jump", "nod", "pick what ball"}) {
    document::Json json = film_with_ball();
    const Performed done = act(json, action, 10);
    const animator::Film film = read(json);
    for (const std::uint32_t frame : {0u, done.first, done.last}) {
      EXPECT_GT(hangs(film, "left", frame), 0.9 * kArmLength) << action << " " << frame;
      const bool carries = action == std::string("pick what ball") && frame == done.last;
      EXPECT_GT(hangs(film, "right", frame), carries ? 0 : 0.9 * kArmLength) << action << " " << frame;
    }
  }
}

TEST(Strangers, TheArmThatDoesNotWaveHangs) {
  document::Json json = film_with(stranger());
  const Performed done = act(json, "wave hand left", 0);
  const animator::Film film = read(json);
  for (std::uint32_t frame = 0; frame <= done.last; ++frame) EXPECT_GT(hangs(film, "right", frame), 0.9 * kArmLength);
}

TEST(Strangers, ArmsWithKeysStayAsTheyAre) {
  document::Json json = film_with(stranger());
  json["actors"][0]["keys"] = document::Json::parse(R"([{"frame": 0, "pose": {"right-arm": [0, 0, 0]}}])");
  act(json, "wave hand left", 0);
  EXPECT_NEAR(hangs(read(json), "right", 20), 0, 1e-6);
}

TEST(Strangers, ArmsHangBesideABroadBody) {
  for (const double wide : {15.0, 24.0, 27.0}) {
    document::Json json = film_with(stranger(wide));
    const Performed done = act(json, "walk steps 2", 0);
    const animator::Film film = read(json);
    const modeler::Model& model = film.models[film.actors[0].model];
    const Body body = body_of(model, "anna", "test");
    const Posture posture = posture_at(model, film.actors[0].motion, done.last);
    for (const modeler::Side side : kSides) {
      const std::size_t wrist = body.find(modeler::Limb::wrist, side);
      const glm::dvec3 from_middle =
          glm::transpose(canonical_turn(0, 0, body.heading_of(posture))) *
          (frame_in(model, posture, wrist).place - frame_in(model, posture, body.pelvis).place);
      EXPECT_GT(sign_of(side) * from_middle.y, wide + 1) << wide;
      EXPECT_LT(sign_of(side) * from_middle.y, wide + 16) << wide;
    }
  }
}

TEST(Strangers, SlimFiguresHangTheirArmsAsBefore) {
  const animator::Film film = read(film_with(human()));
  const Body body = body_of(film.models[film.actors[0].model], "anna", "test");
  for (const modeler::Side side : kSides) EXPECT_DOUBLE_EQ(hang_beside(body, side), kSlimHang);
}

}  // namespace
}  // namespace mars::motion
