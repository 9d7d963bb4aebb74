// Hands that pull limbs: whole limbs follow within limits, pinned joints stay, and what is written is one step.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "host/content/animator/pose/actor_state.h"
#include "host/studio/stage/eye.h"
#include "host/studio/stage/hand.h"
#include "host/studio/stage/reach_place.h"
#include "host/studio/stage/screen.h"
#include "host/studio/stage/selection.h"
#include "tests/host/studio/stage/fakes.h"
#include "tests/host/studio/step_words.h"
#include "tests/processor_time.h"
#include "tests/sanitizers/sanitized.h"

namespace mars::studio {
namespace {

// A person, seen from the left and somewhat from before, in the tool `reach`.
struct ReachScene : OnStage {
  explicit ReachScene(bool model = false) : OnStage(model_film("human.json"), model) {
    view(0, kViewWidth, kViewHeight, "free", "stick",
         R"(, "orbit": {"center": [0, 0, 2.5], "turn": 60, "height": 10, "distance": 14}, "handles": "reach")");
  }

  const modeler::Model& model() const { return project.film().models[project.film().actors[0].model]; }
  const std::string& actor() const { return project.film().actors[0].name; }
  std::size_t joint(const std::string& name) const {
    std::size_t number = 0;
    while (model().joints.at(number).name != name) ++number;
    return number;
  }
  Screen screen() const { return {camera_from({From::free, {{0, 0, 2.5}, 60, 10, 14}}, 1), kViewWidth, kViewHeight}; }
  glm::dvec2 pixel(const glm::dvec3& place) const { return screen().pixel_of(place).value(); }
  animator::ActorState state() const { return animator::state_at(project.film(), 0, project.frame()); }
  glm::dvec3 end(const std::string& name) const {
    const modeler::Axes frame = state().joints[joint(name)];
    return frame.turn * end_of(model(), joint(name)) + frame.place;
  }
  // What the mouse takes there.
  Held under(const glm::dvec2& pixel) const {
    Moments moments(project);
    moments.renew();
    const Picked picked = pick(project, moments, screen(), pixel);
    const modeler::Axes frame = state().joints[picked.selection.joint.value()];
    return {*picked.selection.joint, glm::transpose(frame.turn) * (picked.hit.value().place - frame.place)};
  }
  glm::dvec3 place_of(const Held& held) const {
    const modeler::Axes frame = state().joints[held.joint];
    return frame.turn * held.place + frame.place;
  }
  double drift(const std::string& name, const modeler::Axes& from) const {
    const modeler::Axes now = state().joints[joint(name)];
    double most = glm::length(now.place - from.place);
    for (int axis = 0; axis < 3; ++axis) most = std::max(most, glm::length(now.turn[axis] - from.turn[axis]));
    return most;
  }
  double beyond_limits() const {
    double most = 0;
    const animator::ActorState now = state();
    for (std::size_t i = 0; i < now.pose.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const modeler::Limits& limits = model().joints[i].limits[std::size_t(axis)];
        most = std::max({most, limits.lower - now.pose[i][axis], now.pose[i][axis] - limits.upper});
      }
    return most;
  }

  void select(const std::string& name) {
    const std::string joint = name.empty() ? "null" : "\"" + name + "\"";
    take(R"({"do": "select", "actor": ")" + actor() + R"(", "joint": )" + joint + "}");
  }
  void pin(const std::string& name, bool pinned = true) {
    take(R"({"do": "pin", "actor": ")" + actor() + R"(", "joint": ")" + name + R"(", "pinned": )" +
         (pinned ? "true}" : "false}"));
  }
  void grab(const glm::dvec2& at) { take(R"({"do": "grab", "view": 0, )" + xy(at) + "}"); }
  void drag(const glm::dvec2& at) { take(R"({"do": "drag", )" + xy(at) + "}"); }
};

TEST(Reaching, AHandIsPulledByItsWholeArm) {
  ReachScene scene;
  const glm::dvec2 from = scene.pixel(scene.end("left-hand")) - glm::dvec2(0, 3);
  const Held held = scene.under(from);
  ASSERT_EQ(held.joint, scene.joint("left-hand"));
  scene.grab(from);
  EXPECT_EQ(scene.last("grabbed")["joint"], "left-hand");
  for (const glm::dvec2& by : {glm::dvec2(6, -10), {20, -40}, {-20, -70}, {10, -50}}) {
    scene.drag(from + by);
    EXPECT_LT(glm::length(scene.pixel(scene.place_of(held)) - from - by), 0.5) << by.x << ", " << by.y;
    EXPECT_LE(scene.beyond_limits(), 0);
  }
  const Json step = effect_of(scene.project.previews.back());
  EXPECT_EQ(step["does"], "pose");
  EXPECT_EQ(step["of"], scene.actor());
  EXPECT_FALSE(step.contains("place"));
  EXPECT_TRUE(step.contains("left-upper-arm"));
  EXPECT_TRUE(step.contains("left-forearm"));
  for (const auto& [name, value] : step.items()) {
    if (value.is_array()) {
      EXPECT_TRUE(name.starts_with("left-")) << name;
    }
  }
  EXPECT_TRUE(scene.project.commits.empty());
  scene.take(R"({"do": "drop"})");
  ASSERT_EQ(scene.project.commits.size(), 1u);
  EXPECT_EQ(effect_of(scene.project.commits[0]), step);
}

TEST(Reaching, TheHandMayGoBeyondAndComeBack) {
  ReachScene scene;
  const glm::dvec2 from = scene.pixel(scene.state().joints[scene.joint("left-hand")].place);
  const animator::ActorState before = scene.state();
  scene.grab(from);
  for (int i = 1; i <= 12; ++i) scene.drag(from + glm::dvec2(30.0 * i, -40.0 * i));
  EXPECT_LE(scene.beyond_limits(), 0);
  EXPECT_GT(
      glm::length(scene.state().joints[scene.joint("left-hand")].place - before.joints[scene.joint("left-hand")].place),
      0.5);
  for (int i = 11; i >= 0; --i) scene.drag(from + glm::dvec2(30.0 * i, -40.0 * i));
  for (std::size_t i = 0; i < before.joints.size(); ++i)
    EXPECT_LT(glm::length(scene.state().joints[i].place - before.joints[i].place), 1e-3)
        << scene.model().joints[i].name;
  scene.take(R"({"do": "let_go"})");
  EXPECT_EQ(scene.project.cancels, 1);
}

TEST(Reaching, PinnedFeetStayWhileThePelvisIsPulled) {
  ReachScene scene;
  scene.select("pelvis");
  scene.pin("left-foot");
  scene.pin("right-foot");
  EXPECT_EQ(scene.last("pinned")["pins"].size(), 2u);
  EXPECT_EQ(scene.shapes("pin:left-foot").size(), 1u);
  EXPECT_EQ(scene.shapes("pin:left-foot")[0]["kind"], "pin");
  const animator::ActorState before = scene.state();
  const modeler::Axes left = before.joints[scene.joint("left-foot")], right = before.joints[scene.joint("right-foot")];
  ASSERT_EQ(scene.shapes("arrow:z").size(), 1u);
  const Json points = scene.shapes("arrow:z")[0]["points"];
  const glm::dvec2 tip(points[1][0].get<double>(), points[1][1].get<double>());
  scene.grab(tip);
  ASSERT_EQ(scene.last("grabbed")["handle"], "arrow:z");
  for (int down = 5; down <= 40; down += 5) {
    scene.drag(tip + glm::dvec2(0, down));
    EXPECT_LT(scene.drift("left-foot", left), 1e-6) << down;
    EXPECT_LT(scene.drift("right-foot", right), 1e-6) << down;
    EXPECT_LE(scene.beyond_limits(), 0);
  }
  EXPECT_LT(scene.state().joints[0].place.z, before.joints[0].place.z - 0.3) << "it goes down";
  EXPECT_GT(scene.state().pose[scene.joint("left-shin")].y, before.pose[scene.joint("left-shin")].y + 5)
      << "on its knees";
  const Json step = effect_of(scene.project.previews.back());
  EXPECT_TRUE(step.contains("place"));
  EXPECT_TRUE(step.contains("left-thigh"));
}

TEST(Reaching, AnUnpinnedFootGoesAlong) {
  ReachScene scene;
  scene.pin("left-foot");
  scene.pin("left-foot", false);
  EXPECT_TRUE(scene.last("pinned")["pins"].empty());
  scene.select("");
  EXPECT_TRUE(scene.shapes("pin:left-foot").empty());
  const animator::ActorState before = scene.state();
  const glm::dvec2 place = scene.pixel(before.place);
  scene.grab(place);
  ASSERT_EQ(scene.last("grabbed")["handle"], "plane");
  scene.drag(place + glm::dvec2(30, 20));
  EXPECT_LT(glm::length(scene.pixel(scene.state().place) - place - glm::dvec2(30, 20)), 0.1);
  EXPECT_GT(scene.drift("left-foot", before.joints[scene.joint("left-foot")]), 0.1);
  const Json step = effect_of(scene.project.previews.back());
  EXPECT_EQ(step.size(), 5u) << "does, of, place, frame and clamp: " << step;
  EXPECT_TRUE(step.contains("place"));
}

TEST(Reaching, APinnedHandStaysWhileTheActorMoves) {
  ReachScene scene;
  scene.pin("left-hand");
  scene.select("");
  const modeler::Axes hand = scene.state().joints[scene.joint("left-hand")];
  const glm::dvec2 place = scene.pixel(scene.state().place);
  scene.grab(place);
  ASSERT_EQ(scene.last("grabbed")["handle"], "plane");
  scene.drag(place + glm::dvec2(-4, 3));
  scene.drag(place + glm::dvec2(-8, 6));
  EXPECT_LT(glm::length(scene.state().joints[scene.joint("left-hand")].place - hand.place), 1e-6);
  EXPECT_LT(glm::length(scene.pixel(scene.state().place) - place - glm::dvec2(-8, 6)), 0.1);
}

TEST(Reaching, AFootIsPulledByItsLegAndBendsTheKnee) {
  ReachScene scene;
  const glm::dvec2 from = scene.pixel(scene.state().joints[scene.joint("left-toes")].place);
  scene.grab(from);
  const std::string grabbed = scene.last("grabbed")["joint"];
  ASSERT_TRUE(grabbed.starts_with("left-toe") || grabbed == "left-foot" || grabbed == "left-sole") << grabbed;
  const glm::dvec2 ankle = scene.pixel(scene.state().joints[scene.joint("left-foot")].place);
  for (const glm::dvec2& by : {glm::dvec2(2, -5), {5, -20}, {10, -40}, {3, -8}}) {
    scene.drag(from + by);
    const glm::dvec2 now = scene.pixel(scene.state().joints[scene.joint("left-foot")].place);
    EXPECT_LT(glm::length(now - ankle - by), 1.5) << by.x << ", " << by.y;
    EXPECT_GT(scene.state().pose[scene.joint("left-shin")].y, 5);
    EXPECT_LE(scene.beyond_limits(), 0);
  }
}

TEST(Reaching, OfAModelLimbsFollowAndNothingElse) {
  ReachScene scene(true);
  const glm::dvec2 from = scene.pixel(scene.state().joints[scene.joint("left-foot")].place);
  scene.grab(from);
  scene.drag(from + glm::dvec2(10, -20));
  const Json step = effect_of(scene.project.previews.back());
  EXPECT_EQ(step["does"], "turn");
  EXPECT_FALSE(step.contains("of"));
  EXPECT_FALSE(step.contains("place"));
  EXPECT_TRUE(step.contains("left-shin"));
  scene.take(R"({"do": "let_go"})");
  scene.select("");
  EXPECT_TRUE(scene.shapes("plane").empty()) << "a model has no place of its own";
}

TEST(Reaching, WhatIsNoJointIsNotPinned) {
  ReachScene scene;
  EXPECT_ANY_THROW(scene.pin("left-wing"));
  EXPECT_ANY_THROW(scene.take(R"({"do": "pin", "actor": "nobody", "joint": "left-hand", "pinned": true})"));
}

TEST(Reaching, APullTakesLittleTime) {
  ReachScene scene;
  scene.pin("left-foot");
  scene.pin("right-foot");
  const glm::dvec2 from = scene.pixel(scene.state().joints[scene.joint("left-hand")].place);
  scene.grab(from);
  double least = 1e9;
  for (int i = 1; i <= 20; ++i) {
    const test::ProcessorTime time;
    scene.drag(from + glm::dvec2(3.0 * i, -2.0 * i));
    least = std::min(least, time.seconds());
  }
  EXPECT_LT(least, 0.02 * sanitizers::kSlowness);
}

}  // namespace
}  // namespace mars::studio
