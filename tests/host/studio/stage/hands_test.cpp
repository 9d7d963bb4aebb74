// Hands: what lies under a pixel, and where things go when they are dragged.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/rotation.h"
#include "host/content/film/moment.h"
#include "host/preview/drawing.h"
#include "host/preview/viewpoint.h"
#include "host/studio/stage/eye.h"
#include "host/studio/stage/hand.h"
#include "host/studio/stage/handles.h"
#include "host/studio/stage/picking.h"
#include "tests/host/content/film/small_film.h"
#include "tests/host/studio/stage/fakes.h"
#include "tests/host/studio/step_words.h"
#include "tests/processor_time.h"

namespace mars::studio {
namespace {

// A model of an arm along x: `upper` is free about z and y within limits, `lower` a hinge about y.
animator::Film arm() {
  animator::Film film =
      film::film_of(R"({"frames": 9, "size": [640, 480], "camera": {"eye": [1, -9, 2], "at": [1, 0, 0]},
    "models": {"arm": {"joints": [
      {"name": "upper", "limits": {"y": [-80, 80], "z": [-90, 60]},
       "segment": {"shape": "box", "sbb": [[0, -0.2, -0.2], [1.5, 0.2, 0.2]]}},
      {"name": "plate", "parent": "upper", "place": [1.5, 0, 0], "limits": {},
       "segment": {"shape": "box", "sbb": [[0, -0.3, -0.3], [0.1, 0.3, 0.3]]}},
      {"name": "lower", "parent": "plate", "place": [0.1, 0, 0], "limits": {"y": [-720, 720]},
       "segment": {"shape": "box", "sbb": [[0, -0.15, -0.15], [1.5, 0.15, 0.15]]}}]}},
    "actors": [{"name": "a", "model": "arm"}]})");
  return film;
}

// A joint that turns freely, on one that is turned.
animator::Film ball() {
  return film::film_of(R"({"frames": 9, "size": [640, 480], "camera": {"eye": [1, -9, 2], "at": [1, 0, 0]},
    "models": {"m": {"joints": [
      {"name": "base", "segment": {"shape": "box", "sbb": [[0, -0.2, -0.2], [1.5, 0.2, 0.2]]}},
      {"name": "ball", "parent": "base", "place": [1, 0, 0],
       "segment": {"shape": "box", "sbb": [[0, -0.2, -0.2], [0.5, 0.2, 0.2]]}}]}},
    "actors": [{"name": "a", "model": "m", "pose": {"base": [10, 20, 40], "ball": [20, 30, 40]}}]})");
}

struct HandScene : OnStage {
  explicit HandScene(animator::Film film, bool model = false, const std::string& from = "side")
      : OnStage(std::move(film), model) {
    const std::string orbit =
        from == "camera" ? "" : R"(, "orbit": {"center": [1.5, 0, 0], "turn": -90, "height": 0, "distance": 9})";
    view(0, kViewWidth, kViewHeight, from, "stick", orbit);
    eye = {From::side, {{1.5, 0, 0}, -90, 0, 9}};
    if (from == "free") eye.from = From::free;
  }

  void tool(const std::string& handles, const std::string& axes = "numbers") {
    view(0, kViewWidth, kViewHeight, eye.from == From::free ? "free" : "side", "stick",
         R"(, "orbit": {"center": [1.5, 0, 0], "turn": )" + std::to_string(eye.orbit.turn) + R"(, "height": )" +
             std::to_string(eye.orbit.height) + R"(, "distance": 9}, "axes": ")" + axes + R"(", "handles": ")" +
             handles + "\"");
  }
  Screen screen() const { return {camera_from(eye, 1), kViewWidth, kViewHeight}; }
  glm::dvec2 pixel(const glm::dvec3& place) const { return screen().pixel_of(place).value(); }
  void grab(const glm::dvec2& at) { take(R"({"do": "grab", "view": 0, )" + xy(at) + "}"); }
  void drag(const glm::dvec2& at, const char* keys = "[]") {
    take(R"({"do": "drag", )" + xy(at) + R"(, "keys": )" + keys + "}");
  }
  void drop() { take(R"({"do": "drop"})"); }
  // From where no other ring crosses.
  void turn_ring_y() {
    const Json points = shapes("ring:y").at(0)["points"];
    const auto at = [&](std::size_t i) { return glm::dvec2(points.at(i)[0], points.at(i)[1]); };
    const auto handle_under = [&](std::size_t i) {
      take(R"({"do": "hover", "view": 0, )" + xy(at(i)) + "}");
      return last("hovered")["handle"];
    };
    std::size_t held = 0;
    while (handle_under(held) != "ring:y") ++held;
    grab(at(held));
    for (std::size_t step = 2; step <= 6; step += 2) drag(at(held + step));
    drop();
  }
  animator::ActorState state() const { return animator::state_at(project.film(), 0, project.frame()); }
  // A place of the joint's frame, in the world.
  glm::dvec3 of_joint(std::size_t joint, const glm::dvec3& place) const {
    const animator::ActorState now = state();
    return now.joints[joint].turn * place + now.joints[joint].place;
  }

  Eye eye;
};

TEST(Picking, TheNearestSurfaceUnderThePixel) {
  HandScene scene(arm());
  const auto picked = [&](const glm::dvec3& place) {
    scene.take(R"({"do": "hover", "view": 0, )" + xy(scene.pixel(place)) + "}");
    return scene.last("hovered")["joint"];
  };
  EXPECT_EQ(picked({0.7, -0.2, 0}), "upper");
  EXPECT_EQ(picked({1.55, -0.3, 0.25}), "plate");
  EXPECT_EQ(picked({2.4, -0.15, 0.1}), "lower");
  EXPECT_EQ(picked({2.4, -0.15, 0.145}), "lower");
  EXPECT_TRUE(picked({2.4, -0.15, 0.16}).is_null()) << "beside it";
  EXPECT_TRUE(picked({2.4, 0, 2}).is_null());
  EXPECT_EQ(scene.last("hovered")["text"], "");
}

TEST(Picking, WhereNoSurfaceIsTheNearestJoint) {
  animator::Film film = arm();
  film.models[0].joints[1].segment.reset();
  HandScene scene(film);
  scene.take(R"({"do": "hover", "view": 0, )" + xy(scene.pixel({1.55, 0, 0}) + glm::dvec2(0, 9)) + "}");
  EXPECT_FALSE(scene.last("hovered")["joint"].is_null());
}

TEST(Picking, AMillionTrianglesTakeLittleTime) {
  wire::Patch flat;
  Triangles diced;
  for (std::size_t i = 0; i < 16; ++i) flat.points[i] = {float(i % 4) / 3, float(i / 4) / 3, 0.5f};
  add_diced(flat, kPatchSteps, diced);
  EXPECT_EQ(diced.corners.size(), 3u * 2 * kPatchSteps * kPatchSteps);
  animator::Film film = arm();
  modeler::Shape& shape = film.models[0].shapes[film.models[0].joints[2].segment->shape];
  shape.patches.clear();
  constexpr int kSide = 90;  // 8100 patches of 128 triangles
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      wire::Patch patch = flat;
      for (auto& point : patch.points)
        point = {(point[0] + float(column)) / kSide, 0.5f, (point[1] + float(row)) / kSide};
      shape.patches.push_back(patch);
    }
  FakeProject project(film);
  Moments moments(project);
  moments.renew();
  const Screen screen(camera_from({From::side, {{1.5, 0, 0}, -90, 0, 9}}, 1), kViewWidth, kViewHeight);
  double least = 1e9;
  for (int tries = 0; tries < 5; ++tries) {
    const test::ProcessorTime time;
    const auto hit =
        first_hit(moments, screen.ray_through(*screen.pixel_of({2.4, 0, 0.01})), [](std::size_t) { return true; });
    least = std::min(least, time.seconds());
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->segment, 2u);
    EXPECT_LT(glm::length(hit->place - glm::dvec3(2.4, 0, 0.01)), 1e-3);
  }
  EXPECT_LT(least, 0.2) << "of 20 ms";
}

TEST(Hands, AHingeFollowsTheMouse) {
  HandScene scene(arm());
  const glm::dvec3 held(1.2, -0.15, 0.05);
  const glm::dvec3 start = scene.of_joint(2, held);
  scene.grab(scene.pixel(start));
  ASSERT_EQ(scene.last("grabbed")["joint"], "lower");
  EXPECT_EQ(scene.last("selected")["joint"], "lower");
  // On the circle of the place about its joint the mouse can be reached.
  const glm::dvec3 center = scene.state().joints[2].place;
  const double radius = glm::length(glm::dvec2(held.x, held.z));
  for (const double degrees : {5.0, 30.0, 80.0, 120.0, 60.0, -50.0}) {
    const double angle = degrees * modeler::kDegree;
    const glm::dvec3 wanted = center + glm::dvec3(radius * std::cos(angle), held.y, radius * std::sin(angle));
    scene.drag(scene.pixel(wanted));
    EXPECT_LT(glm::length(scene.pixel(scene.of_joint(2, held)) - scene.pixel(wanted)), 1) << degrees;
  }
  EXPECT_TRUE(scene.project.commits.empty()) << "nothing is written while the hand moves";
  scene.drop();
  ASSERT_EQ(scene.project.commits.size(), 1u);
  const Json effect = effect_of(scene.project.commits[0]);
  EXPECT_EQ(effect["does"], "pose");
  EXPECT_EQ(effect["of"], "a");
  EXPECT_TRUE(effect.contains("lower")) << effect;
}

TEST(Hands, SeveralFreedomsFollowTheMouseToo) {
  HandScene scene(arm(), false, "free");
  scene.eye.orbit.turn = -60;
  scene.eye.orbit.height = 25;
  scene.tool("none");
  const glm::dvec3 held(1.0, -0.2, 0.1);
  const glm::dvec2 from = scene.pixel(scene.of_joint(0, held));
  scene.grab(from);
  ASSERT_EQ(scene.last("grabbed")["joint"], "upper");
  for (const glm::dvec2& by : {glm::dvec2(8, -14), {12, -40}, {-6, -60}, {-4, 30}, {2, 36}}) {
    scene.drag(from + by);
    EXPECT_LT(glm::length(scene.pixel(scene.of_joint(0, held)) - from - by), 1) << by.x << ", " << by.y;
  }
}

TEST(Hands, StopAtLimits) {
  HandScene scene(arm(), false, "free");
  scene.tool("none");
  const glm::dvec2 from = scene.pixel(scene.of_joint(0, {1.2, -0.2, 0}));
  scene.grab(from);
  for (int i = 1; i <= 40; ++i) scene.drag(from + glm::dvec2(-6.0 * i, -12.0 * i));
  const glm::dvec3 pose = scene.state().pose[0];
  EXPECT_DOUBLE_EQ(pose.x, 0);
  EXPECT_GE(pose.y, -80);
  EXPECT_LE(pose.y, 80);
  EXPECT_NEAR(std::abs(pose.y), 80, 1e-9);
  scene.take(R"({"do": "let_go"})");
  EXPECT_EQ(scene.project.cancels, 1);
  EXPECT_EQ(scene.state().pose[0], glm::dvec3(0));
}

// A forearm that bends about y and twists about z, along which it lies: dragged where y stops, it does not twist.
TEST(Hands, StopAtALimitWithoutATwist) {
  HandScene scene(film::film_of(R"({"frames": 9, "size": [640, 480], "camera": {"eye": [1, -9, 2], "at": [1, 0, 0]},
    "models": {"m": {"joints": [{"name": "forearm", "limits": {"y": [0, 150], "z": [-90, 90]},
      "segment": {"shape": "box", "sbb": [[-0.2, -0.2, 0], [0.2, 0.2, 1.5]]}}]}},
    "actors": [{"name": "a", "model": "m", "pose": {"forearm": [0, 30, 10]}}]})"),
                  false, "free");
  scene.eye.orbit.turn = -70;
  scene.tool("none");
  const glm::dvec3 held = {0.05, -0.2, 1.2};
  scene.grab(scene.pixel(scene.of_joint(0, held)));
  ASSERT_EQ(scene.last("grabbed")["joint"], "forearm");
  const auto drag_to = [&](double degrees) {
    const double angle = degrees * modeler::kDegree;
    scene.drag(scene.pixel({1.2 * std::sin(angle), -0.2, 1.2 * std::cos(angle)}));
  };
  for (int degrees = 28; degrees >= -100; degrees -= 2) {
    drag_to(degrees);
    EXPECT_NEAR(scene.state().pose[0].z, 10, 1e-9) << degrees;
    if (degrees < -10) {
      EXPECT_EQ(scene.state().pose[0].y, 0) << degrees;
    }
  }
  for (int degrees = -98; degrees <= 40; degrees += 2) drag_to(degrees);
  EXPECT_NEAR(scene.state().pose[0].y, 40, 6);
  EXPECT_NEAR(scene.state().pose[0].z, 10, 1e-9);
}

TEST(Hands, WhatCannotTurnTurnsWhatItHangsOn) {
  HandScene scene(arm());
  scene.grab(scene.pixel({1.55, -0.3, 0.25}));
  ASSERT_EQ(scene.last("grabbed")["joint"], "plate");
  scene.drag(scene.pixel({1.4, -0.3, 0.7}));
  ASSERT_FALSE(scene.project.previews.empty());
  EXPECT_TRUE(effect_of(scene.project.previews.back()).contains("upper"));
}

TEST(Hands, AClickOnWhatCannotTurnSelectsWhatCan) {
  const glm::dvec3 on_plate(1.55, -0.3, 0.25);
  const auto selected = [&](animator::Film film, bool model) {
    HandScene scene(std::move(film), model);
    scene.grab(scene.pixel(on_plate));
    EXPECT_EQ(scene.last("grabbed")["joint"], "plate");
    return scene.last("selected")["joint"];
  };
  EXPECT_EQ(selected(arm(), false), "upper");
  EXPECT_EQ(selected(arm(), true), "plate") << "a model's joint has more than angles";
  animator::Film stiff = arm();
  for (modeler::Joint& joint : stiff.models[0].joints) joint.limits.fill({0, 0});
  ASSERT_EQ(stiff.models[0].joints[0].freedoms(), 0);
  EXPECT_TRUE(selected(stiff, false).is_null()) << "the actor as a whole";
}

TEST(Hands, ShiftIsFine) {
  HandScene scene(arm());
  const glm::dvec3 held(1.2, -0.15, 0);
  const glm::dvec2 from = scene.pixel(scene.of_joint(2, held));
  scene.grab(from);
  scene.drag(from + glm::dvec2(0, -50), R"(["shift"])");
  EXPECT_NEAR(scene.pixel(scene.of_joint(2, held)).y, from.y - 10, 1);
}

// The side view looks along y, the axis of the hinge, from -y: it faces away.
TEST(Hands, ARingIsTurnedSeveralTimes) {
  HandScene scene(arm());
  scene.take(R"({"do": "select", "actor": "a", "joint": "lower"})");
  scene.tool("turn");
  const glm::dvec2 center = scene.pixel(scene.state().joints[2].place);
  const auto at = [&](double degrees) {
    const double angle = degrees * modeler::kDegree;
    return center + ring_pixels(1) * glm::dvec2(std::cos(angle), -std::sin(angle));
  };
  scene.grab(at(20));
  ASSERT_EQ(scene.last("grabbed")["handle"], "ring:y");
  for (int degrees = 20; degrees >= -480; degrees -= 20) scene.drag(at(degrees));
  EXPECT_NEAR(scene.state().pose[2].y, 500, 1e-6);
  for (int degrees = -480; degrees >= -1000; degrees -= 20) scene.drag(at(degrees));
  EXPECT_NEAR(scene.state().pose[2].y, 720, 1e-9) << "its limit";
  scene.drop();
  EXPECT_NEAR(effect_of(scene.project.commits.at(0))["lower"][1].get<double>(), 720, 1e-9);
}

TEST(Hands, RingsShowLimitsAndAngles) {
  HandScene scene(arm());
  scene.take(R"({"do": "select", "actor": "a", "joint": "upper"})");
  scene.tool("turn");
  EXPECT_TRUE(scene.shapes("ring:x").empty()) << "it cannot turn about x";
  ASSERT_EQ(scene.shapes("ring:y").size(), 1u);
  ASSERT_EQ(scene.shapes("limit:y").size(), 2u);
  EXPECT_EQ(scene.shapes("limit:y")[0]["text"], "-80\u00b0");
  EXPECT_EQ(scene.shapes("label:y")[0]["text"], "y 0\u00b0");
  EXPECT_EQ(scene.shapes("joint:upper")[0]["selected"], true);
  EXPECT_FALSE(scene.shapes("joint:lower")[0].contains("selected"));
  const Json first = scene.shapes("ring:y")[0]["points"][0];
  scene.take(R"({"do": "hover", "view": 0, )" + xy({first[0].get<double>(), first[1].get<double>()}) + "}");
  EXPECT_EQ(scene.last("hovered")["handle"], "ring:y");
  EXPECT_EQ(scene.shapes("ring:y")[0]["hot"], true);
}

TEST(Hands, RingsTurnAboutTheAxesChosen) {
  for (const std::string axes : {"joint", "parent", "world"}) {
    HandScene scene(ball(), false, "free");
    scene.eye.orbit.turn = -60;
    scene.eye.orbit.height = 25;
    scene.take(R"({"do": "select", "actor": "a", "joint": "ball"})");
    scene.tool("turn", axes);
    EXPECT_EQ(scene.shapes("label:y").at(0)["text"], "y") << "no number's angle";
    EXPECT_TRUE(scene.shapes("limit:y").empty());
    const animator::ActorState before = scene.state();
    scene.turn_ring_y();
    const glm::dvec3 wanted = axes == "joint"    ? before.joints[1].turn[1]
                              : axes == "parent" ? before.joints[0].turn[1]
                                                 : glm::dvec3(0, 1, 0);
    const animator::Turn turn = animator::turn_between(before.joints[1].turn, scene.state().joints[1].turn);
    EXPECT_LT(glm::distance(turn.axis, wanted), 1e-6) << axes;
    EXPECT_GT(turn.angle / modeler::kDegree, 5) << axes << ", however slanted the ring is seen";
    EXPECT_TRUE(effect_of(scene.project.commits.at(0)).contains("ball")) << "three numbers, as people can type them";
  }
}

// In a film the turns are one command, of a model a pose that is only shown.
TEST(Hands, ARingTurnsAllSelectedJointsEachAboutItsOwnAxis) {
  for (const bool model : {false, true}) {
    HandScene scene(ball(), model, "free");
    scene.eye.orbit.turn = -60;
    scene.eye.orbit.height = 25;
    scene.take(R"({"do": "select", "actor": "a", "joint": "ball", "more": ["base"]})");
    EXPECT_EQ(scene.last("selected")["more"], Json::array({"base"}));
    scene.tool("turn", "joint");
    EXPECT_EQ(scene.shapes("joint:base").at(0)["selected"], true);
    const animator::ActorState before = scene.state();
    scene.turn_ring_y();
    ASSERT_EQ(scene.project.commits.size(), 1u);
    const auto seen_from = [](std::size_t joint, const animator::ActorState& state) {
      return glm::transpose(modeler::orientation(animator::free_joint(), state.pose[joint]));
    };
    animator::Turn turns[2];
    for (std::size_t joint = 0; joint < 2; ++joint) {
      turns[joint] = animator::turn_between(seen_from(joint, scene.state()), seen_from(joint, before));
      EXPECT_LT(glm::distance(turns[joint].axis, glm::dvec3(0, 1, 0)), 1e-6) << joint;
    }
    EXPECT_GT(turns[0].angle / modeler::kDegree, 5);
    EXPECT_NEAR(turns[0].angle, turns[1].angle, 1e-7);
  }
}

TEST(Hands, OfSelectedJointsThoseTurnThatCan) {
  HandScene scene(arm());
  scene.take(R"({"do": "select", "actor": "a", "joint": "lower", "more": ["plate", "upper"]})");
  scene.tool("turn");
  scene.turn_ring_y();
  const Json effect = effect_of(scene.project.commits.at(0));
  EXPECT_EQ(effect["upper"], effect["lower"]) << "by their numbers";
  EXPECT_FALSE(effect.contains("plate"));
  for (const char* more : {R"(["nobody"])", R"(["lower"])", R"([3])", "3"})
    EXPECT_ANY_THROW(
        scene.take(R"({"do": "select", "actor": "a", "joint": "lower", "more": )" + std::string(more) + "}"));
  EXPECT_ANY_THROW(scene.take(R"({"do": "select", "actor": "a", "more": ["lower"]})"));
}

TEST(Hands, RingsOfHingesAreOfTheirNumber) {
  HandScene scene(arm());
  scene.take(R"({"do": "select", "actor": "a", "joint": "lower"})");
  scene.tool("turn", "world");
  EXPECT_TRUE(scene.shapes("ring:x").empty());
  EXPECT_EQ(scene.shapes("label:y").at(0)["text"], "y 0\u00b0");
}

TEST(Hands, ArrowsMoveActorsOfFilms) {
  HandScene scene(arm());
  scene.project.set_frame(4);
  scene.take(R"({"do": "select", "actor": "a", "joint": null})");
  scene.tool("move");
  const glm::dvec3 held(0, 0, 0.5);
  scene.grab(scene.pixel(held));
  ASSERT_EQ(scene.last("grabbed")["handle"], "arrow:z");
  scene.drag(scene.pixel({0.4, 0, 0.9}));
  EXPECT_LT(glm::length(scene.state().place - glm::dvec3(0, 0, 0.4)), 2e-3) << "x is not its own";
  scene.drop();
  EXPECT_TRUE(effect_of(scene.project.commits.at(0)).contains("place"));
  EXPECT_FALSE(effect_of(scene.project.commits.at(0)).contains("falloff"));
  const glm::dvec3 there = scene.state().place + held;
  scene.take(R"({"do": "grab", "view": 0, "falloff": 8, )" + xy(scene.pixel(there)) + "}");
  scene.drag(scene.pixel(there + glm::dvec3(0, 0, 0.2)));
  scene.drop();
  EXPECT_EQ(effect_of(scene.project.commits.at(1))["falloff"], 8) << "blended over frames around";
}

TEST(Hands, ArrowsMoveJointsOfModels) {
  HandScene scene(arm(), true);
  scene.take(R"({"do": "select", "joint": "lower"})");
  scene.tool("move");
  const glm::dvec3 from = scene.state().joints[2].place;
  scene.grab(scene.pixel(from));
  ASSERT_EQ(scene.last("grabbed")["handle"], "plane");
  scene.drag(scene.pixel(from + glm::dvec3(0.3, 0, 0.2)));
  EXPECT_LT(glm::length(scene.state().joints[2].place - from - glm::dvec3(0.3, 0, 0.2)), 1e-6);
  scene.drop();
  const Json step = effect_of(scene.project.commits.at(0));
  EXPECT_EQ(step["does"], "set");
  EXPECT_FALSE(step.contains("actor"));
  EXPECT_NEAR(step["place"][0].get<double>(), 0.4, 1e-6);
}

TEST(Hands, BoxesArePulledByTheirFaces) {
  HandScene scene(arm(), true);
  scene.take(R"({"do": "select", "joint": "lower"})");
  scene.tool("box");
  const glm::dvec3 face = scene.of_joint(2, {1.5, 0, 0});
  scene.grab(scene.pixel(face));
  ASSERT_EQ(scene.last("grabbed")["handle"], "face:x+");
  scene.drag(scene.pixel(face + glm::dvec3(0.5, 0, 0.3)));
  const modeler::Box& sbb = scene.project.film().models[0].joints[2].segment->sbb;
  EXPECT_NEAR(sbb.max.x, 2, 2e-3);
  EXPECT_EQ(sbb.min, glm::dvec3(0, -0.15, -0.15)) << "the face opposite stays";
  scene.drag(scene.pixel(face - glm::dvec3(4, 0, 0)));
  EXPECT_GT(scene.project.film().models[0].joints[2].segment->sbb.max.x, 0) << "it keeps an inside";
}

TEST(Hands, ControlPointsFollowTheMouse) {
  HandScene scene(arm(), true);
  scene.take(R"({"do": "select", "joint": "lower"})");
  scene.tool("points");
  const auto& joint = scene.project.film().models[0].joints[2];
  const wire::Patch patch = scene.project.film().models[0].shapes[joint.segment->shape].patches[0];
  const glm::dvec3 extent = joint.segment->sbb.max - joint.segment->sbb.min;
  const glm::dvec3 in_cube(patch.points[5][0], patch.points[5][1], patch.points[5][2]);
  const glm::dvec3 place = scene.of_joint(2, joint.segment->sbb.min + in_cube * extent);
  ASSERT_EQ(scene.shapes("point:0:5").size(), 1u);
  scene.grab(scene.pixel(place));
  const std::string handle = scene.last("grabbed")["handle"];
  ASSERT_EQ(handle.substr(0, 6), "point:");
  scene.drag(scene.pixel(place + glm::dvec3(0.1, 0, 0.2)));
  const Json step = effect_of(scene.project.previews.back());
  const Json& to = step["to"];
  EXPECT_EQ(step["does"], "point");
  const std::size_t number = step["at"][1].get<std::size_t>() * 4 + step["at"][0].get<std::size_t>();
  const auto& before = scene.project.film()
                           .models[0]
                           .shapes[joint.segment->shape]
                           .patches[step["patch"].get<std::size_t>()]
                           .points[number];
  EXPECT_NEAR(before[0], to[0].get<double>(), 1e-6);
  EXPECT_TRUE(scene.project.pulled());
  scene.drag(scene.pixel(place + glm::dvec3(0.02, 0, 0.2)), R"(["shift"])");
  const Json along = effect_of(scene.project.previews.back())["to"];
  EXPECT_NEAR(along[0].get<double>(), to[0].get<double>() - 0.1 / extent.x, 2e-3) << "along z alone";
  scene.drag(scene.pixel(place + glm::dvec3(0, 0, 2)));
  EXPECT_EQ(effect_of(scene.project.previews.back())["to"][2].get<double>(), 1) << "shapes stay in their box";
}

TEST(Hands, OnePageAtATime) {
  HandScene scene(arm());
  scene.grab(scene.pixel({2.4, -0.15, 0}));
  scene.drag(scene.pixel({2.4, -0.15, 0.3}));
  scene.stage->take(
      2, Json::parse(R"({"do": "view", "view": 0, "width": 640, "height": 480, "from": "side", "as": "stick"})"));
  EXPECT_ANY_THROW(scene.stage->take(2, Json::parse(R"({"do": "grab", "view": 0, "x": 320, "y": 240})")));
  scene.stage->page_closed(1);
  EXPECT_EQ(scene.project.cancels, 1);
  EXPECT_NO_THROW(scene.stage->take(2, Json::parse(R"({"do": "grab", "view": 0, "x": 320, "y": 240})")));
}

TEST(Hands, LetGoOfWhatOthersChange) {
  HandScene scene(arm());
  const glm::dvec2 begin = scene.pixel({2.4, -0.15, 0.1});
  scene.grab(begin);
  scene.drag(begin + glm::dvec2(0, 9));
  ASSERT_EQ(scene.project.previews.size(), 1u);
  scene.project.change([](animator::Film& film) {
    film.models[0].joints.pop_back();
    film.models[0].joints.shrink_to_fit();
    film.actors[0].motion.pose.pop_back();
  });
  scene.stage->project_changed();
  scene.drag(begin + glm::dvec2(0, 20));
  scene.drop();
  EXPECT_EQ(scene.project.previews.size(), 1u);
  EXPECT_TRUE(scene.project.commits.empty());
  scene.grab(scene.pixel({0.7, -0.2, 0}));
  scene.drag(scene.pixel({0.7, -0.2, 0}) + glm::dvec2(0, 9));
  scene.drop();
  EXPECT_EQ(scene.project.commits.size(), 1u) << "a new gesture begins as ever";
}

TEST(Screen, LinesAreCutAtTheNearPlane) {
  wire::Camera camera = camera_from({From::free, {{0, 0, 0}, -90, 0, 2}}, 1);
  camera.near = 1;
  const Screen screen(camera, 200, 100);
  EXPECT_FALSE(screen.pixel_of({0, -1.5, 0}));
  const auto cut = screen.polylines({{0.1, 3, 0}, {0.1, -3, 0}, {0.1, 3, 0.1}});
  ASSERT_EQ(cut.size(), 2u);
  for (const Polyline& line : cut) {
    ASSERT_EQ(line.size(), 2u);
    for (const glm::dvec2& pixel : line) EXPECT_LT(glm::length(pixel - glm::dvec2(100, 50)), 50) << "none at infinity";
  }
  EXPECT_LT(glm::length(cut[0].back() - *screen.pixel_of({0.1, -1, 0})), 1e-6);
  EXPECT_TRUE(screen.polylines({{0, -3, 0}, {1, -4, 0}}).empty());
}

TEST(Screen, ProjectsAsThePreviewDraws) {
  const wire::Camera camera = camera_from({From::front, {{1, 2, 3}, 0, 0, 5}}, 1);
  const Screen screen(camera, 320, 200);
  preview::Drawing drawing(320, 200);
  drawing.begin(camera, {0, 0, 0}, 1, 200);
  const glm::dvec3 place(1.2, 2.6, 2.5);
  drawing.draw({{float(place.x), float(place.y), float(place.z)}, {}, 1}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
               {1, 1, 1});
  const glm::dvec2 pixel = screen.pixel_of(place).value();
  EXPECT_NE(drawing.image().pixels[std::size_t(pixel.y) * 320 + std::size_t(pixel.x)], 0u);
  const Ray ray = screen.ray_through(pixel);
  EXPECT_LT(glm::length(glm::cross(place - ray.from, glm::normalize(ray.way))), 1e-9);
}

TEST(Eyes, FrontSideAndTopAreParallel) {
  for (const From from : {From::side, From::top, From::front}) {
    const preview::Orbit orbit{{0, 0, 0}, from == From::front ? 0.0 : -90.0, from == From::top ? 90.0 : 0.0, 5};
    const Screen view(camera_from({from, orbit}, 1), 400, 300);
    const glm::dvec3 place(0.3, -0.4, 0.5), farther = place + 2.0 * view.ahead();
    EXPECT_LT(glm::length(view.pixel_of(place).value() - view.pixel_of(farther).value()), 1e-9);
    EXPECT_EQ(view.scale_at(place), view.scale_at(farther));
    EXPECT_LT(glm::length(view.towards_eye(place) + view.ahead()), 1e-12);
    const Ray ray = view.ray_through(view.pixel_of(place).value());
    EXPECT_LT(glm::length(glm::cross(place - ray.from, ray.way)), 1e-9);
    const glm::dvec3 step(0.01, 0.02, 0.03);
    const glm::dvec2 moved = view.pixel_of(place + step).value() - view.pixel_of(place).value();
    EXPECT_LT(glm::length(moved - view.motion_of(place, step)), 1e-9);
  }
  const Screen screen(camera_from({From::front, {{0, 0, 0}, 0, 0, 5}}, 1), 400, 400);
  const Screen free(camera_from({From::free, {{0, 0, 0}, 0, 0, 5}}, 1), 400, 400);
  EXPECT_NEAR(free.scale_at({0, 0, 0}) / screen.scale_at({0, 0, 0}), 1, 1e-9) << "what is in the center is as large";
}

TEST(Eyes, PanningAndZoomingOfParallelViewsKeepWhatIsUnderTheMouse) {
  preview::Orbit orbit{{0, 0, 0}, -90, 0, 5};
  const auto seen = [&] { return Screen(camera_from({From::side, orbit}, 1), 400, 300); };
  const glm::dvec3 place(0.4, 0.7, 0.2);
  const glm::dvec2 at = seen().pixel_of(place).value();
  pan(orbit, {30, -20}, 300);
  EXPECT_LT(glm::length(seen().pixel_of(place).value() - at - glm::dvec2(30, -20)), 1e-9);
  const glm::dvec2 before = seen().pixel_of(place).value();
  const double scale = seen().scale_at(place);
  zoom(orbit, {0, -200}, before - glm::dvec2(200, 150), 300);
  EXPECT_LT(glm::length(seen().pixel_of(place).value() - before), 1e-9);
  EXPECT_GT(seen().scale_at(place), 1.2 * scale);
}

TEST(Screen, ShiftMovesThePictureAsThePreviewDoes) {
  for (const From from : {From::front, From::free}) {
    wire::Camera camera = camera_from({from, {{1, 2, 3}, 0, 0, 5}}, 1);
    const glm::dvec3 place(1.2, 2.6, 2.5);
    const glm::dvec2 middle = Screen(camera, 320, 200).pixel_of(place).value();
    camera.shift_x = 0.25, camera.shift_y = -0.1;
    const Screen screen(camera, 320, 200);
    const glm::dvec2 pixel = screen.pixel_of(place).value();
    EXPECT_LT(glm::length(pixel - middle - glm::dvec2(-80, -20)), 1e-9) << "more is seen at the right and below";
    preview::Drawing drawing(320, 200);
    drawing.begin(camera, {0, 0, 0}, 1, 200);
    drawing.draw({{float(place.x), float(place.y), float(place.z)}, {}, 1}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                 {1, 1, 1});
    EXPECT_NE(drawing.image().pixels[std::size_t(pixel.y) * 320 + std::size_t(pixel.x)], 0u);
  }
}

TEST(Eyes, PanningMovesTheCenterByThePixels) {
  preview::Orbit orbit{{0, 0, 0}, -90, 20, 5};
  const Screen before(camera_from({From::free, orbit}, 1), 400, 300);
  const glm::dvec2 at = before.pixel_of({0, 0, 0}).value();
  pan(orbit, {30, -20}, 300);
  const Screen after(camera_from({From::free, orbit}, 1), 400, 300);
  EXPECT_LT(glm::length(after.pixel_of({0, 0, 0}).value() - at - glm::dvec2(30, -20)), 0.5);
}

}  // namespace
}  // namespace mars::studio
