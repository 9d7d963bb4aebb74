#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "host/content/animator/reading/film_version.h"
#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/camera_points.h"
#include "host/content/animator/pose/check.h"
#include "host/content/animator/motion/script/script.h"
#include "host/content/animator/reading/read_film.h"
#include "host/editing/edit_film.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::editing {
namespace {

constexpr const char* kCarryFilm = R"({"frames": 30, "camera": {"eye": [0, -9, 2]},
"models": {"arm": {"joints": [{"name": "a"}, {"name": "b", "parent": "a", "place": [1, 0, 0],
  "segment": {"shape": "box"}}]}},
"actors": [{"name": "ball", "model": "arm", "place": [1, 1, 0], "turn": [0, 0, 20]},
  {"name": "tom", "model": "arm", "keys": [{"frame": 0, "place": [0, 0, 0], "pose": {"a": [0, 0, 0]}},
    {"frame": 24, "place": [4, 0, 1], "pose": {"a": [10, 20, 90]}}]}]})";

class Carry : public testing::Test {
 protected:
  document::Json json = document::Json::parse(kCarryFilm);

  void execute(std::initializer_list<const char*> words) {
    Command command{"animate"};
    for (const char* word : words) command.emplace_back(word);
    edit_film(json, "/nowhere/f.json", std::span(&command, 1));
  }
  animator::Film film() const {
    const document::Document document(document::laid_out(json), "f.json");
    return animator::read_film(document.root(), "/nowhere");
  }
  modeler::Axes root(std::uint32_t frame) const { return animator::state_at(film(), 0, frame).root; }
  glm::dvec3 eye(std::uint32_t frame) const { return animator::eye_at(film(), frame); }
};

void expect_near(const modeler::Axes& a, const modeler::Axes& b) {
  EXPECT_LT(glm::distance(a.place, b.place), 1e-7);
  for (int axis = 0; axis < 3; ++axis) EXPECT_LT(glm::distance(a.turn[axis], b.turn[axis]), 1e-7);
}

TEST_F(Carry, AttachedNothingJumpsAndThenItGoesAlong) {
  const modeler::Axes before = root(6);
  execute({"attach", "ball", "--to", "tom/b", "--frame", "6"});
  expect_near(root(5), before);
  expect_near(root(6), before);
  EXPECT_GT(glm::distance(root(24).place, before.place), 1);
  EXPECT_TRUE(animator::check_film(film()).lines.empty());
}

TEST_F(Carry, AttachedAtAPlaceOfItsOwn) {
  execute({"attach", "ball", "--to", "tom/b", "--frame", "6", "--place", "0", "0", "0.5", "--turn", "0", "0", "0"});
  EXPECT_EQ(json["actors"][0]["keys"][0],
            document::Json::parse(R"({"frame": 6, "attach": {"actor": "tom", "joint": "b", "place": [0, 0, 0.5]}})"));
}

TEST_F(Carry, DetachedItStaysAndWhatWasBeforeIsAsItWas) {
  const modeler::Axes before = root(3);
  execute({"attach", "ball", "--to", "tom/b", "--frame", "6"});
  const modeler::Axes carried = root(12), there = root(15);
  execute({"detach", "ball", "--frame", "15"});
  for (const std::uint32_t frame : {0, 3, 5}) expect_near(root(frame), before);
  expect_near(root(12), carried);
  expect_near(root(15), there);
  expect_near(root(29), there);
  EXPECT_TRUE(animator::check_film(film()).lines.empty());
  EXPECT_TRUE(document::holds(document::failure_of([&] {
                                execute({"detach", "ball", "--frame", "20"});
                              }),
                              "is not attached at frame 20"));
}

TEST_F(Carry, FromHandToHand) {
  execute({"attach", "ball", "--to", "tom/b", "--frame", "6"});
  execute({"attach", "ball", "--to", "tom", "--frame", "12"});
  const modeler::Axes there = root(20);
  execute({"detach", "ball", "--frame", "20"});
  expect_near(root(20), there);
  EXPECT_EQ(root(2).place, glm::dvec3(1, 1, 0));
  EXPECT_TRUE(document::holds(document::failure_of([&] {
                                execute({"attach", "tom", "--to", "ball", "--frame", "14"});
                              }),
                              "would be carried by itself"));
}

TEST_F(Carry, AnActionWhoseKeysWouldCountForNothingIsRefused) {
  execute({"attach", "ball", "--to", "tom/b", "--frame", "6"});
  EXPECT_TRUE(document::holds(document::failure_of([&] {
                                execute({"go", "ball", "--at", "8", "--to", "0", "0", "0"});
                              }),
                              "is carried by 'tom'"));
}

TEST_F(Carry, APlaceThatCountsForNothingIsRemarked) {
  execute({"attach", "ball", "--to", "tom/b", "--frame", "6"});
  const Command pose{"animate", "pose", "ball", "place=1,2,3", "--frame", "8"};
  const Done done = edit_film(json, "/nowhere/f.json", std::span(&pose, 1));
  ASSERT_EQ(done.remarks.size(), 1u);
  EXPECT_TRUE(document::holds(done.remarks[0], "'tom' carries it at frame 8"));
}

TEST_F(Carry, ScriptsHaveTheSameCommands) {
  const std::string script =
      "at 6 ball attach tom/b\nat 15 ball detach\nat 8 camera follow tom/b level\nat 8 camera look tom offset 0 0 1";
  document::Json by_script = json;
  motion::play_script(by_script, "/nowhere/f.json", script, "a.script");
  animator::write_version(by_script);
  execute({"attach", "ball", "--to", "tom/b", "--frame", "6"});
  execute({"detach", "ball", "--frame", "15"});
  execute({"follow", "tom/b", "--frame", "8", "--level"});
  execute({"look", "tom", "--frame", "8", "--offset", "0", "0", "1"});
  EXPECT_EQ(document::laid_out(by_script), document::laid_out(json));
  motion::play_script(by_script, "/nowhere/f.json", script, "a.script");
  animator::write_version(by_script);
  EXPECT_EQ(document::laid_out(by_script), document::laid_out(json));
  const auto refused = [&](const char* line) {
    return document::failure_of([&] { motion::play_script(by_script, "/nowhere/f.json", line, "a.script"); });
  };
  EXPECT_TRUE(document::holds(refused("at 6 ball attach tom/c"), "a.script:1: "));
  EXPECT_TRUE(document::holds(refused("at 6 camera look tom level"), "write offset X Y Z"));
}

TEST_F(Carry, TheCameraFollowsWithoutAJump) {
  execute({"follow", "tom/b", "--frame", "8", "--level"});
  const glm::dvec3 way =
      animator::state_at(film(), 1, 16).joints[1].place - animator::state_at(film(), 1, 8).joints[1].place;
  EXPECT_EQ(eye(0), glm::dvec3(0, -9, 2));
  EXPECT_EQ(eye(7), glm::dvec3(0, -9, 2));
  EXPECT_LT(glm::distance(eye(8), glm::dvec3(0, -9, 2)), 1e-7);
  EXPECT_LT(glm::distance(eye(16), glm::dvec3(way.x, way.y - 9, 2)), 1e-7);
  const glm::dvec3 there = eye(20), on_the_way = eye(17);
  execute({"follow", "--end", "--frame", "20"});
  EXPECT_EQ(eye(17), on_the_way);
  EXPECT_LT(glm::distance(eye(20), there), 1e-7);
  EXPECT_LT(glm::distance(eye(29), there), 1e-7);
}

TEST_F(Carry, TheCameraLooksAtAJoint) {
  execute({"look", "tom/b", "--frame", "0", "--offset", "0", "0", "0.2"});
  EXPECT_EQ(animator::at_at(film(), 9), animator::state_at(film(), 1, 9).joints[1].place + glm::dvec3(0, 0, 0.2));
  Command list{"animate", "list", "camera"};
  EXPECT_TRUE(document::holds(edit_film(json, "/nowhere/f.json", std::span(&list, 1)).report, "tom/b + 0 0 0.2"));
  EXPECT_TRUE(document::holds(document::failure_of([&] {
                                execute({"look", "tom/hand", "--frame", "0"});
                              }),
                              "is no joint of 'tom'"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { execute({"look", "--frame", "0"}); }), "is not given"));
}

// Turning one of its axes, a point that follows becomes a place.
TEST_F(Carry, KeysAndPosesOfACameraThatFollows) {
  execute({"follow", "tom", "--frame", "0"});
  const glm::dvec3 there = eye(12);
  execute({"key", "camera", "eye", "--frame", "12"});
  EXPECT_EQ(eye(20), animator::state_at(film(), 1, 20).place + glm::dvec3(0, -9, 2));
  execute({"pose", "camera", "eye.z=7", "--frame", "12"});
  EXPECT_LT(glm::distance(eye(12), glm::dvec3(there.x, there.y, 7)), 1e-7);
}

}  // namespace
}  // namespace mars::editing
