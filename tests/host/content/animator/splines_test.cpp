// Splines through keys, slopes and eases of single parts: the curves, and that commands keep them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/direction.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/reading/film_version.h"
#include "host/content/animator/keys/keys.h"
#include "host/content/animator/listing/keys_table.h"
#include "host/content/animator/pose/limits_left.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/animator/keys/tangent.h"
#include "host/content/document/file.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::animator {
namespace {

// Of the same cubic as Bezier's, by de Casteljau; its slopes by Catmull and Rom.
double bezier_at(const Channel<double>& keys, std::uint32_t frame) {
  std::size_t i = 0;
  while (i + 2 < keys.size() && keys[i + 1].frame <= frame) ++i;
  const auto secant = [&](std::size_t a, std::size_t b) {
    return (keys[b].value - keys[a].value) / (double(keys[b].frame) - keys[a].frame);
  };
  const auto slope = [&](std::size_t k) { return secant(k == 0 ? 0 : k - 1, k + 1 == keys.size() ? k : k + 1); };
  const double span = double(keys[i + 1].frame) - keys[i].frame, t = (double(frame) - keys[i].frame) / span;
  double points[4] = {keys[i].value, keys[i].value + span / 3 * keys[i].out.value_or(slope(i)),
                      keys[i + 1].value - span / 3 * keys[i + 1].in.value_or(slope(i + 1)), keys[i + 1].value};
  for (int left = 3; left > 0; --left)
    for (int p = 0; p < left; ++p) points[p] = (1 - t) * points[p] + t * points[p + 1];
  return points[0];
}

TEST(Spline, GoesThroughKeysAsBeziersWithTheSameSlopesDo) {
  const Channel<double> keys = {
      {3, 1, kSpline}, {7, -2, kSpline}, {20, 5, kSpline, 0.25, -1.5}, {22, 5, kSpline}, {31, 0, kSpline, 2.0}};
  for (std::uint32_t frame = 3; frame <= 31; ++frame)
    EXPECT_NEAR(value_at(keys, frame), bezier_at(keys, frame), 1e-12) << frame;
  EXPECT_EQ(value_at(keys, 0), 1) << "before the first key it holds";
  EXPECT_EQ(value_at(keys, 40), 0);
  for (const Key<double>& key : keys) EXPECT_EQ(value_at(keys, key.frame), key.value);
}

TEST(Spline, TwoKeysWithSlopesAreAThrownBall) {
  const double speed = 0.7, fall = 0.031;
  const auto height = [&](double frame) { return speed * frame - fall / 2 * frame * frame; };
  const Channel<double> keys = {{0, 0, kSpline, {}, speed}, {50, height(50), kLinear, speed - fall * 50}};
  for (std::uint32_t frame = 0; frame <= 50; ++frame) EXPECT_NEAR(value_at(keys, frame), height(frame), 1e-9) << frame;
}

TEST(Spline, EqualKeysMayStillMove) {
  const Channel<double> up = {{0, 1, kSpline, {}, 0.5}, {10, 1, kSpline}, {20, 1, kSpline}};
  EXPECT_TRUE(moves_after(up, 0));
  EXPECT_FALSE(moves_after(up, 1)) << "neither slope leads away";
  EXPECT_GT(value_at(up, 3), 1.5);
  const Channel<double> by_neighbours = {{0, 0, kSpline}, {10, 1, kSpline}, {20, 1, kSpline}};
  EXPECT_TRUE(moves_after(by_neighbours, 1));
}

TEST(Spline, ALightsDirectionGoesByItsNumbersAndStaysAUnit) {
  const Channel<glm::dvec3> keys = {{0, {1, 0, 0}, kSpline}, {10, {0, 0, 1}, kSpline}};
  const glm::dvec3 quarter = direction_at(keys, 4);
  EXPECT_NEAR(glm::length(quarter), 1, 1e-15);
  EXPECT_NEAR(quarter.z / quarter.x, 0.4 / 0.6, 1e-12);
  const Channel<glm::dvec3> across = {{0, {1, 0, 0}, kSpline}, {10, {-1, 0, 0}, kSpline}};
  EXPECT_NEAR(glm::length(direction_at(across, 5)), 1, 1e-15);
}

constexpr const char* kSplineArm = R"({"frames": 61, "camera": {"eye": [0, -9, 2]}, "models": {"arm": {"joints": [
  {"name": "shoulder", "limits": {"x": [-90, 90], "y": [-90, 90], "z": [-90, 90]}},
  {"name": "elbow", "parent": "shoulder", "place": [1, 0, 0], "limits": {"y": [0, 150]}}]}},
  "actors": [{"name": "it", "model": "arm", "keys": )";

struct SplineArm {
  document::Json json;
  Film film;

  explicit SplineArm(const std::string& keys) : json(document::Json::parse(kSplineArm + keys + "}]}")) { read(); }

  void read() {
    const document::Document document(document::laid_out(json), "f.json");
    film = read_film(document.root(), {});
  }

  document::Json& actor() { return json["actors"][0]; }
  const document::Json& keys() const { return json["actors"][0]["keys"]; }
  ActorState at(std::uint32_t frame) const { return state_at(film, 0, frame); }

  template <typename Edit>
  Remarks operator()(Edit edit) {
    Remarks remarks = edit(json, film);
    read();
    return remarks;
  }
};

const Choice kSplined{false, "it", {}};

TEST(Spline, AnActorTurnsWholeTurns) {
  const SplineArm arm(
      R"([{"frame": 0, "turn": {"value": [0, 0, 0], "ease": "spline"}}, {"frame": 8, "turn": [0, 0, 720]}])");
  for (std::uint32_t frame = 0; frame <= 8; ++frame) {
    EXPECT_NEAR(arm.at(frame).turn.z, frame * 90.0, 1e-9);
    EXPECT_NEAR(arm.at(frame).root.turn[0][0], std::cos(frame * M_PI / 2), 1e-12) << frame;
  }
}

TEST(Spline, JointsStopAtTheirLimits) {
  const SplineArm arm(
      R"([{"frame": 0, "pose": {"shoulder": {"value": [0, 80, 0], "out": [0, 9, 2]}, "elbow": [0, 140, 0]},
    "ease": "spline"}, {"frame": 20, "pose": {"shoulder": [0, 80, 0], "elbow": {"value": [0, 140, 0], "in": [0, -8, 0]}}}])");
  double highest = 0, bent = 0;
  for (std::uint32_t frame = 0; frame <= 20; ++frame) {
    highest = std::max(highest, arm.at(frame).pose[0].y);
    bent = std::max(bent, arm.at(frame).pose[1].y);
  }
  EXPECT_EQ(highest, 90);
  EXPECT_EQ(bent, 150);
  EXPECT_TRUE(limits_left(arm.film).empty());
  EXPECT_TRUE(worst_excesses(arm.film).empty());
}

TEST(OwnEase, LegsAreEasedWhileThePlaceRunsEvenly) {
  SplineArm arm(R"([{"frame": 0, "place": [0, 0, 0], "pose": {"elbow": [0, 0, 0], "shoulder": [0, 0, 0]}},
              {"frame": 40, "place": [4, 0, 0], "pose": {"elbow": [0, 90, 0], "shoulder": [0, 0, 40]}}])");
  arm([](document::Json& j, const Film& f) {
    return ease_keys(j, f, {false, "it", {"elbow", "shoulder"}}, {0, 0}, kBoth);
  });
  EXPECT_EQ(arm.keys()[0].dump(), R"({"frame":0,"place":[0,0,0],"pose":{"elbow":{"value":[0,0,0],"ease":"both"},)"
                                  R"("shoulder":{"value":[0,0,0],"ease":"both"}}})");
  EXPECT_EQ(arm.at(10).place.x, 1);
  EXPECT_NEAR(arm.at(10).pose[1].y, 90 * eased(kBoth, 0.25), 1e-9);
  EXPECT_NEAR(arm.at(10).pose[0].z, 40 * eased(kBoth, 0.25), 1e-6);
  arm([](document::Json& j, const Film& f) { return ease_keys(j, f, {false, "it", {"place"}}, {0, 0}, kBoth); });
  EXPECT_EQ(arm.keys()[0].dump(),
            R"({"frame":0,"place":[0,0,0],"pose":{"elbow":[0,0,0],"shoulder":[0,0,0]},"ease":"both"})")
      << "what all share is the key's";
}

TEST(OwnEase, OfALastKeyStaysUntilOthersFollow) {
  SplineArm arm(
      R"([{"frame": 0, "place": [0, 0, 0], "pose": {"elbow": [0, 5, 0]}}, {"frame": 9, "place": [1, 0, 0]}])");
  arm([](document::Json& j, const Film& f) { return ease_keys(j, f, {false, "it", {"elbow"}}, {0, 0}, kIn); });
  EXPECT_EQ(arm.keys()[0]["pose"]["elbow"]["ease"], "in");
  const document::Json before = arm.json;
  put_tracks(arm.actor(), tracks_of(arm.actor()));
  EXPECT_EQ(arm.json.dump(), before.dump());
}

constexpr const char* kCurved = R"([
  {"frame": 0, "place": [0, 0, 0], "turn": [0, 0, 0], "pose": {"elbow": [0, 10, 0], "shoulder": [0, 0, 0]}, "ease": "spline"},
  {"frame": 12, "place": {"value": [2, 1, 0], "in": [0.3, 0, 0], "out": [0, 0.25, 0.5]}, "pose": {"elbow": [0, 90, 0]}, "ease": "spline"},
  {"frame": 30, "place": [3, 0, 0.5], "turn": [0, 0, 400], "pose": {"elbow": {"value": [0, 40, 0], "out": [0, -1, 0]}, "shoulder": [30, 20, 10]}, "ease": "spline"},
  {"frame": 45, "place": [3, 2, 0], "turn": [10, 0, 90], "pose": {"elbow": [0, 30, 0], "shoulder": [0, -20, 10]}, "ease": "spline"},
  {"frame": 60, "place": [0, 0, 0], "turn": [0, 0, 0], "pose": {"elbow": [0, 60, 0], "shoulder": [0, 0, 0]}}])";

double farthest(const ActorState& one, const ActorState& other) {
  double worst = glm::length(one.place - other.place) + glm::length(one.turn - other.turn) / 57;
  for (std::size_t joint = 0; joint < one.pose.size(); ++joint)
    worst = std::max(worst, glm::length(one.pose[joint] - other.pose[joint]) / 57);
  return worst;
}

TEST(Keys, MadeOnASplineKeepTheCurve) {
  const SplineArm before(kCurved);
  SplineArm arm(kCurved);
  for (const std::uint32_t frame : {5u, 17u, 29u, 50u, 53u})
    EXPECT_TRUE(arm([&](document::Json& j, const Film& f) {
                  return make_keys(j, f, kSplined, frame, {}, Beyond::refused);
                }).empty());
  for (std::uint32_t frame = 0; frame <= 60; ++frame)
    EXPECT_LT(farthest(arm.at(frame), before.at(frame)), 1e-6) << frame;
  EXPECT_TRUE(arm.keys()[1]["place"].contains("in"));
}

TEST(Hold, OnASplineStandsStillAndGoesOnAsBefore) {
  const SplineArm before(kCurved);
  for (const std::uint32_t at : {12u, 20u, 30u}) {
    SplineArm arm(kCurved);
    arm([&](document::Json& j, const Film& f) { return hold(j, f, kSplined, at, 7); });
    for (std::uint32_t frame = 0; frame <= 67; ++frame) {
      const std::uint32_t was = frame <= at ? frame : frame <= at + 7 ? at : frame - 7;
      EXPECT_LT(farthest(arm.at(frame), before.at(was)), 1e-6) << at << ": " << frame;
    }
  }
}

TEST(Stretch, OfASplineIsTheSameCurveSlower) {
  const SplineArm before(kCurved);
  SplineArm arm(kCurved);
  arm([&](document::Json& j, const Film& f) { return stretch(j, f, kSplined, {0, 60}, 3); });
  EXPECT_EQ(arm.keys()[1]["place"]["out"][1].get<double>(), 0.0833333333);
  for (std::uint32_t frame = 0; frame <= 60; ++frame)
    EXPECT_LT(farthest(arm.at(3 * frame), before.at(frame)), 1e-6) << frame;
}

TEST(Tangent, SetsSlopesOfAxesAndMakesSplines) {
  SplineArm arm(
      R"([{"frame": 0, "place": [0, 0, 0]}, {"frame": 10, "place": [1, 0, 0]}, {"frame": 20, "place": [4, 0, 0]}])");
  const auto set = [&](const std::string& part, const SlopeChange& change) {
    arm([&](document::Json& j, const Film& f) { return set_slopes(j, f, "it", part, {10, 10}, change); });
    return arm.keys()[1]["place"].dump();
  };
  EXPECT_EQ(set("place.z", {{}, "0.5"}), R"({"value":[1,0,0],"out":[0.2,0,0.5]})");
  EXPECT_EQ(arm.keys()[1]["ease"], "spline");
  EXPECT_FALSE(arm.keys()[0].contains("ease")) << "the way there stays as it was";
  EXPECT_EQ(set("place.x", {"-1", "2"}), R"({"value":[1,0,0],"in":[-1,0,0],"out":[2,0,0.5]})");
  EXPECT_EQ(arm.keys()[0]["ease"], "spline");
  EXPECT_EQ(set("place.x", {{}, {}, false, true}), R"({"value":[1,0,0],"in":[0.2,0,0],"out":[0.2,0,0.5]})");
  EXPECT_EQ(set("place", {{}, {}, true}), R"({"value":[1,0,0],"in":[0,0,0],"out":[0,0,0]})");
  EXPECT_EQ(set("place", {{}, {}, false, true}), "[1,0,0]");
  EXPECT_TRUE(document::holds(document::failure_of([&] {
                                set("elbow.y", {{}, {}, true});
                              }),
                              "has no key of 'elbow.y' at frame 10"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { set("place", {"1", {}}); }), "has 1 number"));
}

TEST(OwnEase, WhatCarriesAnActorHasNone) {
  SplineArm arm(R"([{"frame": 0, "place": [0, 0, 0], "ease": "spline"}, {"frame": 20, "place": [1, 0, 0]}])");
  arm.json["actors"].push_back({{"name", "rod"}, {"model", "arm"}});
  arm.actor()["keys"][0]["attach"] = {{"actor", "rod"}};
  arm.actor()["keys"][1]["attach"] = nullptr;
  arm.read();
  arm([](document::Json& j, const Film& f) { return make_keys(j, f, kSplined, 8, kBoth, Beyond::refused); });
  arm([](document::Json& j, const Film& f) { return hold(j, f, kSplined, 4, 3); });
  for (const document::Json& key : arm.keys())
    EXPECT_FALSE(key.value("attach", document::Json()).contains("value")) << key;
}

TEST(PutKeys, TakeSlopesAndLeaveTheEaseOfOthers) {
  SplineArm arm(
      R"([{"frame": 0, "pose": {"elbow": [0, 5, 0]}, "ease": "both"}, {"frame": 9, "pose": {"elbow": [0, 50, 0]}}])");
  ActorKey first{0, glm::dvec3(0, 0, 1), {}, {}, kSpline}, last{9, glm::dvec3(3, 0, 1), {}, {}, {}};
  first.out["place"] = {1, 0, 2};
  const ActorKey keys[] = {first, last};
  put_keys(arm.json, "it", keys);
  EXPECT_EQ(
      arm.keys()[0].dump(),
      R"({"frame":0,"place":{"value":[0,0,1],"ease":"spline","out":[1,0,2]},"pose":{"elbow":[0,5,0]},"ease":"both"})");
}

TEST(KeysTable, ShowsEaseAndSlopesOfEachPart) {
  SplineArm arm(R"([{"frame": 0, "place": {"value": [1, 0, 0], "out": [0, 2, 0]}, "pose": {"elbow": {"value": [0, 5, 0],
    "ease": "in"}}, "ease": "spline"}, {"frame": 9, "place": [0, 0, 0], "pose": {"elbow": [0, 6, 0]}}])");
  EXPECT_EQ(keys_table(arm.json, arm.film, {false, "it", {}}, {0, 9}),
            "actor 'it'\n"
            "  frame  part   value          ease\n"
            "      0  place  x 1  y 0  z 0  spline  out 0 2 0\n"
            "         elbow  y 5            in\n"
            "      9  place  x 0  y 0  z 0\n"
            "         elbow  y 6\n");
}

TEST(Version, IsWrittenWhereItIsNeeded) {
  SplineArm arm(R"([{"frame": 0, "pose": {"elbow": [0, 5, 0]}, "ease": "both"}])");
  document::Json old = arm.json;
  write_version(old);
  EXPECT_EQ(old.dump(), arm.json.dump());
  for (const char* keys : {R"([{"frame": 0, "place": [0, 0, 0], "ease": "spline"}])",
                           R"([{"frame": 0, "pose": {"elbow": {"value": [0, 5, 0]}}}])",
                           R"([{"frame": 0, "turn": {"value": [0, 5, 0], "ease": "in"}}])"}) {
    SplineArm newer(keys);
    newer.json["version"] = 1;
    EXPECT_TRUE(document::holds(document::failure_of([&] { newer.read(); }), "came with version 2")) << keys;
    write_version(newer.json);
    EXPECT_EQ(newer.json.begin().key(), "version");
    EXPECT_EQ(newer.json["version"], 2);
    EXPECT_NO_THROW(newer.read());
  }
}

TEST(Version, OfTheFutureIsRefused) {
  SplineArm arm("[]");
  arm.json["version"] = 3;
  arm.json["clouds"] = true;
  EXPECT_TRUE(document::holds(document::failure_of([&] { arm.read(); }),
                              "version: is 3, but this MARS reads films up to version 2 (use a newer MARS"));
}

TEST(Tracks, FilmsThatNobodyChangedAreWrittenAsTheyStand) {
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(MARS_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() != ".json") continue;
    document::Json film = document::read_json(entry.path());
    const std::string before = film.dump();
    const auto again = [](document::Json& thing) { put_tracks(thing, tracks_of(thing)); };
    again(film["camera"]);
    for (const char* group : {"lights", "materials", "actors"})
      if (film.contains(group))
        for (document::Json& thing : film[group]) again(thing);
    EXPECT_TRUE(film.dump() == before) << entry.path();
  }
  SplineArm arm(kCurved);
  const std::string before = arm.json.dump();
  put_tracks(arm.actor(), tracks_of(arm.actor()));
  EXPECT_EQ(arm.json.dump(), before);
}

struct Wrong {
  const char* place;
  const char* reported;
};

class WrongPart : public testing::TestWithParam<Wrong> {};

TEST_P(WrongPart, IsOneClearError) {
  const std::string keys = R"([{"frame": 0, "place": )" + std::string(GetParam().place) + "}]";
  const std::string failure = document::failure_of([&] { SplineArm arm(keys); });
  EXPECT_TRUE(document::holds(failure, "keys[0].place")) << failure;
  EXPECT_TRUE(document::holds(failure, GetParam().reported)) << failure;
}

INSTANTIATE_TEST_SUITE_P(Table, WrongPart,
                         testing::Values(Wrong{R"({"ease": "in"})", "has no 'value'"},
                                         Wrong{R"({"value": [0, 0, 0], "eas": "in"})", "did you mean 'ease'?"},
                                         Wrong{R"({"value": [0, 0, 0], "ease": "spline3"})", "did you mean 'spline'?"},
                                         Wrong{R"({"value": [0, 0], "in": [0, 0, 0]})", "place.value: has 2 items"},
                                         Wrong{R"({"value": [0, 0, 0], "in": 3})", R"("in": [1, 0, 0.5])"},
                                         Wrong{R"({"value": [0, 0, 0], "out": [0, 0, 1e10]})",
                                               "place.out[2]: is 1e+10"},
                                         Wrong{R"({"value": {"value": [0, 0, 0]}})", R"("value": [1, 0, 0.5])"}));

}  // namespace
}  // namespace mars::animator
