// Values that hold and then jump, and cuts: the film before and after them.
#include <gtest/gtest.h>

#include "host/content/animator/keys/keys.h"
#include "host/content/animator/keys/pose.h"
#include "host/content/animator/keys/reduce.h"
#include "host/content/animator/pose/camera_points.h"
#include "host/content/animator/pose/direction.h"
#include "host/content/animator/reading/film_version.h"
#include "host/content/animator/reading/read_film.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::animator {
namespace {

TEST(Hold, StaysUntilTheNextKey) {
  const Channel<double> keys = {{0, 1, kHold}, {10, 5, kBoth}, {20, 7, kHold}, {30, 0, kLinear}};
  for (const std::uint32_t frame : {0u, 1u, 9u}) EXPECT_EQ(value_at(keys, frame), 1);
  EXPECT_EQ(value_at(keys, 10), 5);
  EXPECT_EQ(value_at(keys, 15), 6);
  for (const std::uint32_t frame : {20u, 29u}) EXPECT_EQ(value_at(keys, frame), 7);
  EXPECT_EQ(value_at(keys, 30), 0);
  const Channel<glm::dvec3> directions = {{0, {1, 0, 0}, kHold}, {10, {0, 0, 1}}};
  EXPECT_EQ(direction_at(directions, 9), glm::dvec3(1, 0, 0));
}

TEST(Hold, SplinesBesideItKnowNothingBeyondIt) {
  const Channel<double> keys = {{0, 0, kSpline}, {10, 1, kHold}, {11, 100, kSpline}, {21, 110}};
  EXPECT_NEAR(slope_at(keys, 1), 0.1, 1e-15);
  EXPECT_NEAR(slope_at(keys, 2), 1, 1e-15);
  EXPECT_NEAR(value_at(keys, 5), 0.5, 1e-12);
  EXPECT_NEAR(value_at(keys, 16), 105, 1e-12);
}

struct Shot {
  document::Json json;
  Film film;

  explicit Shot(const std::string& camera)
      : json(document::Json::parse(R"({"frames": 61, "camera": )" + camera + R"(,
          "models": {"stone": {"joints": [{"name": "body", "limits": {}}]}},
          "actors": [{"name": "stone", "model": "stone", "keys": [{"frame": 0, "place": [0, 0, 0]}, {"frame": 60, "place": [6, 0, 0]}]}]})")) {
    read();
  }

  void read() {
    write_version(json);
    const document::Document document(document::laid_out(json), "f.json");
    film = read_film(document.root(), {});
  }

  template <typename Edit>
  void operator()(Edit edit) {
    edit(json, film);
    read();
  }

  void cut(std::uint32_t frame, const std::vector<std::string>& parts = {}) {
    (*this)([&](document::Json& j, const Film& f) { return animator::cut(j, f, {false, "camera", parts}, frame); });
  }

  void pose(const std::string& setting, std::uint32_t frame) {
    const std::vector<std::string> settings = {setting};
    (*this)([&](document::Json& j, const Film& f) {
      return animator::pose(j, f, "camera", settings, {frame, frame}, {});
    });
  }

  const document::Json& keys() const { return json["camera"]["keys"]; }
  glm::dvec3 eye(std::uint32_t frame) const { return eye_at(film, frame); }
};

constexpr const char* kShots[] = {
    R"({"eye": [0, -9, 2]})",
    R"({"at": [0, 0, 1], "keys": [{"frame": 0, "eye": [0, -9, 2], "ease": "both"}, {"frame": 60, "eye": [8, -9, 4]}]})",
    R"({"at": [0, 0, 1], "keys": [{"frame": 12, "eye": [0, -9, 2], "ease": "spline"}, {"frame": 29, "eye": [3, -9, 2],
        "ease": "spline"}, {"frame": 30, "eye": [3, -7, 2], "ease": "spline"}, {"frame": 60, "eye": [8, -9, 4]}]})",
    R"({"at": [0, 0, 1], "keys": [{"frame": 0, "eye": [0, -9, 2], "ease": "spline"}, {"frame": 40, "eye": [3, -9, 2],
        "ease": "spline"}, {"frame": 60, "eye": [8, -9, 4]}]})",
    R"({"at": [0, 0, 1], "keys": [{"frame": 0, "eye": [0, -9, 2], "ease": "spline"}, {"frame": 20, "eye": [3, -9, 2]}]})",
    R"({"keys": [{"frame": 40, "eye": [0, -9, 2], "at": {"actor": "stone"}}, {"frame": 50, "eye": [0, -7, 2]}]})",
    // From along with an actor to a place, by an ease and by a spline.
    R"({"at": [0, 0, 1], "keys": [{"frame": 4, "eye": {"actor": "stone", "offset": [0, -9, 2]}, "ease": "both"},
        {"frame": 60, "eye": [9, -9, 5]}]})",
    R"({"at": [0, 0, 1], "keys": [{"frame": 4, "eye": {"actor": "stone", "offset": [0, -9, 2]}, "ease": "spline"},
        {"frame": 44, "eye": [9, -9, 5], "ease": "spline"}, {"frame": 60, "eye": [9, -5, 5]}]})",
    // Back at 29 where it began: that ease has no halves.
    R"({"at": [0, 0, 1], "keys": [{"frame": 0, "eye": [0, -9, 2], "ease": [0.42, -0.753, 0.58, 1.6]}, {"frame": 78,
        "eye": [8, -9, 4]}]})",
};

// Until it is posed at the frame, nothing changes; then nothing before it does, and it is there at once.
TEST(Cut, LeavesWhatIsBeforeAsItIs) {
  for (const char* camera : kShots) {
    const Shot before(camera);
    Shot shot(camera);
    shot.cut(30);
    for (std::uint32_t frame = 0; frame <= 60; ++frame)
      EXPECT_LT(glm::distance(shot.eye(frame), before.eye(frame)), 1e-6) << camera << frame;
    shot.pose("eye=0,0,90", 30);
    for (std::uint32_t frame = 0; frame < 30; ++frame)
      EXPECT_LT(glm::distance(shot.eye(frame), before.eye(frame)), 1e-6) << camera << frame;
    EXPECT_EQ(shot.eye(30), glm::dvec3(0, 0, 90)) << camera;
  }
}

TEST(Cut, WhatCannotBeSplitIsKeyedAtEveryFrame) {
  Shot shot(kShots[6]);
  shot([](document::Json& j, const Film& f) {
    const Remarks remarks = animator::cut(j, f, {false, "camera", {"eye"}}, 30);
    EXPECT_EQ(remarks.size(), 1u);
    EXPECT_TRUE(remarks.at(0).starts_with("camera, eye: has a key at each of the frames 5 to 59")) << remarks.at(0);
    return remarks;
  });
}

TEST(Cut, OfALightsDirectionOnASpline) {
  document::Json json = document::Json::parse(R"({"frames": 40, "camera": {"eye": [0, -9, 2], "at": [0, 0, 1]},
      "lights": [{"keys": [{"frame": 0, "direction": [-1, 0.2, -0.1], "ease": "spline"},
                           {"frame": 39, "direction": [0.9, 0.3, 0.1]}]}], "actors": [], "models": {}})");
  const auto film_of = [](const document::Json& film) {
    return read_film(document::Document(document::laid_out(film), "f.json").root(), {});
  };
  write_version(json);
  const Film before = film_of(json);
  cut(json, before, {false, "light/1", {}}, 20);
  write_version(json);
  const Film after = film_of(json);
  for (std::uint32_t frame = 0; frame < 40; ++frame)
    EXPECT_LT(glm::distance(direction_at(after.lights[0].vector, frame), direction_at(before.lights[0].vector, frame)),
              1e-6)
        << frame;
}

TEST(Cut, ACameraThatStandsStillHoldsFromItsOwnKey) {
  Shot shot(R"({"eye": [0, -9, 2], "at": [0, 0, 1]})");
  shot.cut(30, {"eye"});
  EXPECT_EQ(shot.keys().dump(), R"([{"frame":0,"eye":[0,-9,2],"ease":"hold"},{"frame":30,"eye":[0,-9,2]}])");
  EXPECT_EQ(shot.json["version"], 2);
  shot.pose("eye=5,0,2", 30);
  shot([](document::Json& j, const Film& f) { return move_keys(j, f, {false, "camera", {}}, {30, 30}, 36); });
  EXPECT_EQ(shot.eye(35), glm::dvec3(0, -9, 2)) << "its key alone moves the cut";
  EXPECT_EQ(shot.eye(36), glm::dvec3(5, 0, 2));
  shot.cut(50);
  EXPECT_EQ(shot.keys().size(), 3u);
  EXPECT_EQ(document::failure_of([&] { shot.cut(0); }), "frame 0: has nothing before it (cut at a later frame)");
}

TEST(Cut, StaysACutWhereItIsStretchedAndReduced) {
  Shot shot(kShots[1]);
  shot.cut(30);
  shot.pose("eye=0,0,90", 30);
  Shot slow = shot;
  slow([](document::Json& j, const Film& f) { return stretch(j, f, {true, {}, {}}, {0, 60}, 2); });
  EXPECT_LT(glm::distance(slow.eye(59), shot.eye(29)), 1e-9);
  EXPECT_EQ(slow.eye(60), glm::dvec3(0, 0, 90));
  Shot dense = shot;
  for (std::uint32_t frame = 1; frame < 60; frame += 2)
    dense([&](document::Json& j, const Film& f) {
      return make_keys(j, f, {false, "camera", {"eye"}}, frame, {}, Beyond::refused);
    });
  Shot few = dense;
  few([](document::Json& j, const Film& f) {
    return reduce_keys(j, f, {false, "camera", {"eye"}}, {0, 60}, {1, 0.05}).remarks;
  });
  EXPECT_LT(few.keys().size(), dense.keys().size() / 2);
  for (std::uint32_t frame = 0; frame <= 60; ++frame)
    EXPECT_LT(glm::distance(few.eye(frame), shot.eye(frame)), 0.06) << frame;
}

TEST(Cut, AKeyOnAWayThatHoldsHoldsToo) {
  Shot shot(R"({"keys": [{"frame": 0, "eye": [0, -9, 2], "ease": "hold"}, {"frame": 40, "eye": [5, 0, 2]}]})");
  shot([](document::Json& j, const Film& f) {
    return make_keys(j, f, {false, "camera", {"eye"}}, 20, {}, Beyond::refused);
  });
  EXPECT_EQ(shot.keys()[1].dump(), R"({"frame":20,"eye":[0,-9,2],"ease":"hold"})");
  EXPECT_EQ(shot.eye(39), glm::dvec3(0, -9, 2));
}

}  // namespace
}  // namespace mars::animator
