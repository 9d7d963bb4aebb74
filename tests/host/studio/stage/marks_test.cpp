// The camera and lights as things: what is seen of them, what picks them, and which steps pulling them makes.
#include "host/studio/stage/marks.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "host/content/animator/pose/camera_points.h"
#include "host/content/animator/pose/direction.h"
#include "host/editing/edit_film.h"
#include "host/studio/stage/eye.h"
#include "tests/host/content/film/small_film.h"
#include "tests/host/studio/stage/fakes.h"
#include "tests/host/studio/step_words.h"

namespace mars::studio {
namespace {

animator::Film lit(const std::string& lens = R"("fov": 40)") {
  return film::film_of(R"({"frames": 9, "size": [640, 320],
    "camera": {"eye": [2, -4, 2], "at": [2, 0, 2], )" +
                       lens + R"(},
    "lights": [{"direction": [0, 0, 1]}, {"place": [-2, 0, 3], "reach": 1.5},
               {"place": [4, 0, 4], "at": [4, 0, 1], "cone": [20, 40]}],
    "models": {"box": {"joints": [{"name": "body", "segment": {"shape": "box"}}]}},
    "actors": [{"name": "box", "model": "box"}]})");
}

struct MarkScene : OnStage {
  explicit MarkScene(bool rig = false, const animator::Film& film = lit()) : OnStage(film) {
    project.rig_lights_ = rig;
    show();
  }

  void show(const std::string& from = "free", const std::string& more = R"(, "marks": true, "handles": "move")") {
    view(0, kViewWidth, kViewHeight, from, "stick",
         R"(, "orbit": {"center": [1, 0, 2], "turn": -70, "height": 15, "distance": 14})" + more);
    paint();
  }
  Screen screen() const { return {camera_from({From::free, {{1, 0, 2}, -70, 15, 14}}, 1), kViewWidth, kViewHeight}; }
  glm::dvec2 pixel(const glm::dvec3& place) const { return screen().pixel_of(place).value(); }
  std::set<std::string> ids() const {
    std::set<std::string> ids;
    const Json sent_last = last("handles");
    const Json& all = sent_last.is_object() ? sent_last["shapes"] : pictures.back().handles;
    for (const Json& shape : all) ids.insert(shape["id"]);
    return ids;
  }
  // Whether a line of this handle has a point there.
  bool passes(const std::string& id, const glm::dvec3& place) const {
    for (const Json& shape : shapes(id))
      for (const Json& point : shape["points"])
        if (glm::length(glm::dvec2(point[0].get<double>(), point[1].get<double>()) - pixel(place)) < 0.02) return true;
    return false;
  }
  void select(const std::string& thing) { take(R"({"do": "select", "thing": ")" + thing + "\"}"); }
  void pull(const glm::dvec3& from, const glm::dvec3& to) {
    take(R"({"do": "grab", "view": 0, )" + xy(pixel(from)) + "}");
    take(R"({"do": "drag", )" + xy(pixel(to)) + "}");
  }
  Json drop() {
    take(R"({"do": "drop"})");
    return effect_of(project.commits.back());
  }
};

glm::dvec3 vector_of(const Json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

TEST(Marks, AreSeenWhereTheyStand) {
  MarkScene scene;
  EXPECT_EQ(scene.ids(), (std::set<std::string>{"camera", "light/1", "light/2", "light/3"}));
  const double up = 4 * std::tan(20 * 3.14159265358979 / 180);
  for (const double x : {-2.0, 2.0})
    for (const double z : {-1.0, 1.0})
      EXPECT_TRUE(scene.passes("camera", {2 + x * up, 0, 2 + z * up})) << "a corner of what the film shows";
  EXPECT_TRUE(scene.passes("camera", {2, -4, 2}));
  EXPECT_TRUE(scene.passes("light/2", {-2, 0, 3}));
  EXPECT_TRUE(scene.passes("light/2", glm::dvec3(-2, 0, 3) + 1.5 * scene.screen().right())) << "its reach";
  EXPECT_TRUE(scene.passes("light/3", {4, 0, 4}));
  EXPECT_TRUE(scene.passes("light/3", {4, 3 * std::tan(20 * 3.14159265358979 / 180), 1})) << "its cone";
}

TEST(Marks, AreNotSeenFromTheFilmsCameraNorOfModelsNorOfRigLights) {
  MarkScene scene;
  scene.show("camera");
  EXPECT_TRUE(scene.pictures.back().handles.empty());
  scene.show("free", "");
  EXPECT_TRUE(scene.pictures.back().handles.empty()) << "nobody asked";
  MarkScene rig(true);
  EXPECT_EQ(rig.ids(), (std::set<std::string>{"camera"}));
  EXPECT_ANY_THROW(rig.select("light/1"));
  OnStage model(model_film("human.json"), true);
  model.view(0, kViewWidth, kViewHeight, "front", "stick", R"(, "marks": true)");
  EXPECT_TRUE(model.pictures.back().handles.empty());
  EXPECT_ANY_THROW(model.take(R"({"do": "select", "thing": "camera"})"));
}

TEST(Marks, AreSelectedByMessageAndByTheirSymbols) {
  MarkScene scene;
  scene.select("light/3");
  EXPECT_EQ(scene.last("selected"),
            Json::parse(R"({"is": "selected", "actor": null, "joint": null, "thing": "light/3", "more": []})"));
  EXPECT_TRUE(scene.ids().contains("light/3:at"));
  EXPECT_TRUE(scene.ids().contains("light/3:cone"));
  EXPECT_TRUE(scene.ids().contains("arrow:x"));
  EXPECT_TRUE(scene.ids().contains("at:x"));
  scene.take(R"({"do": "hover", "view": 0, )" + xy(scene.pixel({2, -4, 2})) + "}");
  EXPECT_EQ(scene.last("hovered")["thing"], "camera");
  EXPECT_EQ(scene.last("hovered")["text"], "camera");
  scene.take(R"({"do": "grab", "view": 0, )" + xy(scene.pixel({2, -4, 2})) + "}");
  EXPECT_EQ(scene.last("grabbed")["thing"], "camera");
  EXPECT_EQ(scene.last("selected")["thing"], "camera");
  EXPECT_EQ(scene.shapes("camera")[0]["selected"], true);
  scene.take(R"({"do": "drop"})");
  EXPECT_TRUE(scene.project.commits.empty()) << "a click moves nothing";
  scene.take(R"({"do": "select", "actor": "box", "joint": "body"})");
  EXPECT_TRUE(scene.last("selected")["thing"].is_null());
  for (const char* wrong : {"light/0", "light/4", "light/x", "sun", "light/"})
    EXPECT_ANY_THROW(scene.select(wrong)) << wrong;
  EXPECT_ANY_THROW(scene.take(R"({"do": "select", "thing": "camera", "actor": "box"})"));
}

TEST(Marks, TheCameraIsPulled) {
  MarkScene scene;
  scene.select("camera");
  const glm::dvec3 eye(2, -4, 2), at(2, 0, 2), by = 0.5 * scene.screen().right() - 0.25 * scene.screen().up();
  scene.pull(eye, eye + by);
  EXPECT_LT(glm::length(scene.project.film().camera.eye[0].value.offset - eye - by), 1e-5) << "it shows at once";
  Json step = scene.drop();
  EXPECT_EQ(step["of"], "camera");
  EXPECT_LT(glm::length(vector_of(step["eye"]) - eye - by), 1e-5);
  EXPECT_FALSE(step.contains("at"));
  scene.pull(at, at + by);
  step = scene.drop();
  EXPECT_LT(glm::length(vector_of(step["at"]) - at - by), 1e-5);
  const double pixels = 40 / scene.screen().scale_at(at + by);
  scene.pull(at + by + glm::dvec3(0, 0, pixels), at + by + glm::dvec3(0, 0, pixels + 0.3));
  step = scene.drop();
  EXPECT_LT(glm::length(vector_of(step["at"]) - at - by - glm::dvec3(0, 0, 0.3)), 1e-5) << step.dump();
}

// The words are those of the command, which does what the hand did.
TEST(Marks, ACameraThatGoesAlongIsPulledByItsOffset) {
  constexpr const char* kFilm = R"({"frames": 9, "size": [640, 320],
    "camera": {"eye": {"actor": "box", "joint": "body", "offset": [2, -4, 2], "level": true},
               "at": {"actor": "box", "offset": [2, 0, 2]}},
    "models": {"box": {"joints": [{"name": "body", "segment": {"shape": "box"}}]}},
    "actors": [{"name": "box", "model": "box", "keys": [{"frame": 0, "place": [0, 0, 1]},
                                                        {"frame": 8, "place": [8, 0, 1]}]}]})";
  const auto pulled_to = [&](bool aim, const glm::dvec3& by) {
    OnStage scene(film::film_of(kFilm));
    scene.project.set_frame(2);
    scene.view(0, kViewWidth, kViewHeight, "free", "stick",
               R"(, "orbit": {"center": [3, 0, 2], "turn": -70, "height": 15, "distance": 14}, "marks": true)");
    scene.take(R"({"do": "select", "thing": "camera"})");
    const Screen screen(camera_from({From::free, {{3, 0, 2}, -70, 15, 14}}, 1), kViewWidth, kViewHeight);
    const glm::dvec3 from = aim ? animator::at_at(scene.project.film(), 2) : animator::eye_at(scene.project.film(), 2);
    scene.take(R"({"do": "grab", "view": 0, )" + xy(screen.pixel_of(from).value()) + "}");
    scene.take(R"({"do": "drag", )" + xy(screen.pixel_of(from + by).value()) + "}");
    const auto commands = scene.project.previews.back().at("commands").get<std::vector<editing::Command>>();
    document::Json json = document::Json::parse(kFilm);
    editing::edit_film(json, "/nowhere/f.json", commands);
    const animator::Film film = film::film_of(json.dump());
    const glm::dvec3 now = aim ? animator::at_at(film, 2) : animator::eye_at(film, 2);
    EXPECT_LT(glm::length(now - from - by), 1e-5) << json["camera"].dump();
    const glm::dvec3 later = aim ? animator::at_at(film, 8) : animator::eye_at(film, 8);
    EXPECT_NEAR(later.x - now.x, 6, 1e-6) << "it goes along as before";
  };
  const Screen screen(camera_from({From::free, {{3, 0, 2}, -70, 15, 14}}, 1), kViewWidth, kViewHeight);
  pulled_to(false, 0.5 * screen.right() - 0.25 * screen.up());
  pulled_to(true, 0.5 * screen.up());
}

TEST(Marks, TheCameraIsZoomedByItsUpperEdge) {
  MarkScene scene;
  scene.select("camera");
  const double degree = 3.14159265358979 / 180, half = 4 * std::tan(20 * degree), wider = 4 * std::tan(30 * degree);
  scene.pull({2, 0, 2 + half}, {2, 0, 2 + wider});
  const Json step = scene.drop();
  EXPECT_NEAR(step["fov"].get<double>(), 60, 1e-4);
  EXPECT_FALSE(step.contains("eye"));
}

// What it shows is a box, moved by its lens shift, whose height is pulled at its upper edge.
TEST(Marks, AnOrthographicCameraShowsABox) {
  MarkScene scene(false, lit(R"("projection": "orthographic", "height": 3, "shift": [0.25, 0])"));
  for (const double x : {-1.5, 4.5})
    for (const double z : {0.5, 3.5})
      for (const double y : {-4.0, 0.0})
        EXPECT_TRUE(scene.passes("camera", {2 + x, y, z})) << x << ' ' << y << ' ' << z;
  scene.select("camera");
  scene.pull({2, 0, 3.5}, {2, 0, 4});
  const Json step = scene.drop();
  EXPECT_NEAR(step["height"].get<double>(), 4, 1e-4);
  scene.take(R"({"do": "put_camera", "view": 0})");
  const Json effect = effect_of(scene.project.commits.back());
  const preview::Orbit orbit{{1, 0, 2}, -70, 15, 14};
  EXPECT_NEAR(effect["height"].get<double>(), preview::height_of(orbit), 1e-5) << "shows what the view shows";
  EXPECT_LT(glm::length(vector_of(effect["at"]) - glm::dvec3(1, 0, 2)), 1e-6);
}

TEST(Marks, LightsArePulled) {
  MarkScene scene;
  const glm::dvec3 by = 0.5 * scene.screen().right() + 0.3 * scene.screen().up();
  scene.pull({-2, 0, 3}, glm::dvec3(-2, 0, 3) + by);
  EXPECT_LT(glm::length(scene.project.film().lights[1].vector[0].value - glm::dvec3(-2, 0, 3) - by), 1e-5);
  Json step = scene.drop();
  EXPECT_EQ(step["of"], "light/2");
  EXPECT_LT(glm::length(vector_of(step["place"]) - glm::dvec3(-2, 0, 3) - by), 1e-5);
  const glm::dvec3 edge = glm::dvec3(-2, 0, 3) + by + 1.5 * scene.screen().right();
  scene.pull(edge, edge + 0.5 * scene.screen().right());
  EXPECT_NEAR(scene.drop()["reach"].get<double>(), 2, 1e-5);
  scene.select("light/3");
  scene.pull({4, 0, 1}, glm::dvec3(4, 0, 1) + by);
  step = scene.drop();
  EXPECT_EQ(step["of"], "light/3");
  EXPECT_LT(glm::length(vector_of(step["at"]) - glm::dvec3(4, 0, 1) - by), 1e-5);
}

TEST(Marks, WhatHasNoKeysIsChangedForTheWholeFilm) {
  MarkScene scene;
  scene.project.has_keys_ = false;
  scene.pull({-2, 0, 3}, {-2, 0, 3.5});
  scene.take(R"({"do": "drop"})");
  const Json words = scene.project.commits.at(0)["commands"][0];
  EXPECT_EQ(Json(std::vector<Json>(words.begin(), words.begin() + 4)), Json::parse(R"(["film", "light", "set", "2"])"));
  EXPECT_TRUE(words[4].get<std::string>().starts_with("place="));
}

TEST(Marks, TheCameraGoesWhereAFreeViewLooksFrom) {
  MarkScene scene;
  scene.take(R"({"do": "put_camera", "view": 0})");
  const Json effect = effect_of(scene.project.commits.at(0));
  EXPECT_EQ(effect["of"], "camera");
  EXPECT_LT(glm::length(vector_of(effect["at"]) - glm::dvec3(1, 0, 2)), 1e-6);
  const preview::Orbit orbit{{1, 0, 2}, -70, 15, 14};
  wire::Camera there = preview::camera_of(orbit);
  there.focal = 1 / std::tan(20 * 3.14159265358979 / 180);
  for (int row = 0; row < 3; ++row) {  // turned as the view's, and at that eye
    auto& m = there.world_to_eye.m[row];
    m[3] = -glm::dot(glm::dvec3(m[0], m[1], m[2]), vector_of(effect["eye"]));
  }
  const preview::Orbit again = preview::orbit_near(there, {{1, 0, 2}, 1});
  EXPECT_NEAR(again.distance, orbit.distance, 1e-5) << "shows its middle as large";
  EXPECT_NEAR(again.turn, orbit.turn, 1e-5);
  scene.show("side");
  EXPECT_ANY_THROW(scene.take(R"({"do": "put_camera", "view": 0})"));
}

TEST(Marks, ASpotsConeOpensAndItsInnerOneAlong) {
  MarkScene scene;
  scene.select("light/3");
  const Json point = scene.shapes("light/3:cone").at(0)["points"][0];
  const glm::dvec2 at(point[0].get<double>(), point[1].get<double>()), middle = scene.pixel({4, 0, 1});
  scene.take(R"({"do": "grab", "view": 0, )" + xy(at) + "}");
  ASSERT_EQ(scene.last("grabbed")["handle"], "light/3:cone");
  scene.take(R"({"do": "drag", )" + xy(at + 0.5 * (at - middle)) + "}");
  const Json cone = scene.drop()["cone"];
  EXPECT_GT(cone[1].get<double>(), 48);
  EXPECT_LT(cone[1].get<double>(), 65);
  EXPECT_NEAR(cone[0].get<double>(), cone[1].get<double>() / 2, 1e-6);
}

TEST(Marks, ASunKeepsItsDistanceAndChangesItsDirection) {
  MarkScene scene;
  Moments moments(scene.project);
  moments.renew();
  const MarkState sun = state_of(scene.project, moments, Mark{0});
  ASSERT_LT(glm::length(glm::normalize(sun.place - sun.center) - glm::dvec3(0, 0, 1)), 1e-9);
  const glm::dvec3 by = 0.6 * scene.screen().right();
  scene.pull(sun.place, sun.place + by);
  const glm::dvec3 expected = glm::normalize(sun.place + by - sun.center);
  EXPECT_LT(glm::length(animator::direction_at(scene.project.film().lights[0].vector, 0) - expected), 1e-5);
  const Json step = scene.drop();
  EXPECT_LT(glm::length(vector_of(step["direction"]) - expected), 1e-5);
  EXPECT_FALSE(step.contains("place"));
}

}  // namespace
}  // namespace mars::studio
