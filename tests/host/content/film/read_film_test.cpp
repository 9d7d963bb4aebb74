#include "host/content/animator/reading/read_film.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/film/small_film.h"

namespace mars::film {
namespace {

constexpr const char* kWhole = R"({
  "frames": 12, "rate": 25, "size": [320, 200], "background": [0.1, 0.2, 0.3], "intervals": "keyframes", "dice": 7,
  "camera": {"at": [0, 0, 1], "fov": 50, "near": 0.5, "far": 500,
             "keys": [{"frame": 0, "eye": [0, -9, 2]}, {"frame": 8, "eye": [1, -9, 2], "ease": "both"}]},
  "lights": [{"direction": [0, 0, 2], "intensity": 0.5}, {"keys": [{"frame": 0, "place": [1, 2, 3]}]}],
  "materials": {"gold": {"color": [1, 0.8, 0.2], "keys": [{"frame": 2, "exponent": 8}]}},
  "models": {"m": {"joints": [{"name": "root", "segment": {"shape": "sphere", "material": "gold"}},
                              {"name": "tip", "parent": "root", "limits": {"y": [0, 90]}}]}},
  "actors": [{"name": "one", "model": "m", "place": [1, 1, 1],
              "keys": [{"frame": 0, "pose": {"tip": [0, 10, 0]}, "ease": [0.2, 0, 0.8, 1]},
                       {"frame": 9, "turn": [0, 0, 90], "pose": {"tip": [0, 80, 0], "root": [1, 2, 3]}}]},
             {"name": "two", "model": "m", "matrices": [
               {"frame": 0, "segments": {"root": [[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7]]}}]}]
})";

TEST(ReadFilm, TakesEveryKey) {
  const animator::Film film = film_of(kWhole);
  EXPECT_EQ(film.frames, 12u);
  EXPECT_EQ(film.rate, 25);
  EXPECT_EQ(film.height, 200u);
  EXPECT_EQ(film.cutting, animator::Cutting::keyframes);
  EXPECT_EQ(film.dice, 7u);
  EXPECT_EQ(film.camera.eye.size(), 2u);
  EXPECT_EQ(film.camera.eye[1].ease, animator::kBoth);
  EXPECT_EQ(film.camera.up[0].value, glm::dvec3(0, 0, 1));
  EXPECT_EQ(film.lights[0].vector[0].value, glm::dvec3(0, 0, 1)) << "made a unit vector";
  EXPECT_EQ(film.lights[1].kind, wire::LightKind::point);
  const animator::Actor& actor = film.actors[0];
  EXPECT_EQ(actor.motion.place.size(), 1u);
  EXPECT_EQ(actor.motion.turn[0].frame, 9u) << "a key sets only what it names";
  EXPECT_EQ(actor.motion.pose[0].size(), 1u);
  EXPECT_EQ(actor.motion.pose[1].size(), 2u);
  EXPECT_EQ(actor.motion.pose[1][0].ease, (animator::Ease{0.2, 0, 0.8, 1}));
  EXPECT_EQ(film.actors[1].matrices[0][0].value.place, glm::dvec3(5, 6, 7));
}

struct Broken {
  const char* actor;
  const char* reported;
};

class BrokenActor : public testing::TestWithParam<Broken> {};

TEST_P(BrokenActor, IsOneClearError) {
  const std::string failure = document::failure_of([] { film_of(arm_film(GetParam().actor)); });
  EXPECT_TRUE(document::holds(failure, "f.json:8: actors")) << failure;
  EXPECT_TRUE(document::holds(failure, GetParam().reported)) << failure;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BrokenActor,
    testing::Values(
        Broken{R"({"model": "arm"})", "has no 'name'"},
        Broken{R"({"name": "x", "model": "amr"})", "did you mean 'arm'?"},
        Broken{R"({"name": "x", "model": "arm"}, {"name": "x", "model": "arm"})", "second actor named 'x'"},
        Broken{R"({"name": "x", "model": "arm", "material": "rad"})", "did you mean 'red'?"},
        Broken{R"({"name": "x", "model": "arm", "materials": {"blue": "red"}})", "no material that a segment"},
        Broken{R"({"name": "x", "model": "arm", "place": [1e10, 0, 0]})", "actors[0].place[0]: is 1e+10"},
        Broken{R"({"name": "x", "model": "arm", "pose": {"knee": [0, 0, 0]}})", "no joint of the model 'arm'"},
        Broken{R"({"name": "x", "model": "arm", "pose": {"b": [0, 401, 0]}})",
               "actors[0].pose.b: joint 'b' turns 401 degrees about y, outside its limits -10 to 400"},
        Broken{R"({"name": "x", "model": "arm", "pose": {"b": 5}})",
               "is a number, not a list (write \"b\": [0, 90, 0])"},
        Broken{R"({"name": "x", "model": "arm", "pose": {"b": [5, 10, 0]}})",
               "joint 'b' turns about y only; its x axis is locked at 0, not 5"},
        Broken{R"({"name": "x", "model": "arm", "place": 3})",
               "is a number, not a list (write \"place\": [1, 0, 0.5])"},
        Broken{R"({"name": "x", "model": "arm", "place": [1, 2]})", "has 2 items (write \"place\": [1, 0, 0.5])"},
        Broken{R"({"name": "x", "model": "arm", "keys": {"frame": 3}})",
               "is an object, not a list (write \"keys\": [{\"frame\": 0}, {\"frame\": 24}])"},
        Broken{R"({"name": "x", "model": "arm", "keys": [{"pose": {}}]})", "has no 'frame'"},
        Broken{R"({"name": "x", "model": "arm", "keys": [{"frame": 5}, {"frame": 5}]})", "ascending"},
        Broken{R"({"name": "x", "model": "arm", "keys": [{"frame": -1}]})", "from 0"},
        Broken{R"({"name": "x", "model": "arm", "keys": [{"frame": 1.5}]})", "whole number"},
        Broken{R"({"name": "x", "model": "arm", "keys": [{"frame": 0, "ease": "bath"}]})", "did you mean 'both'?"},
        Broken{R"({"name": "x", "model": "arm", "keys": [{"frame": 0, "ease": [2, 0, 0, 1]}]})", "from 0 to 1"},
        Broken{R"({"name": "x", "model": "arm", "place": [0, 0, 0], "keys": [{"frame": 1, "place": [0, 0, 0]}]})",
               "is also set by keys"},
        Broken{
            R"({"name": "x", "model": "arm", "pose": {"b": [0, 0, 0]}, "keys": [{"frame": 1, "pose": {"b": [0, 1, 0]}}]})",
            "actors[0].pose.b: is also set by keys"},
        Broken{R"({"name": "x", "model": "arm", "matrices": []})", "has no matrix of 'a' at frame 0"},
        Broken{R"({"name": "x", "model": "arm", "matrices": [], "keys": []})", "stands beside matrices"},
        Broken{R"({"name": "x", "model": "arm", "matrices": [{"frame": 0, "segments": {"a": [[1, 0, 0]]}}]})",
               "has 1 items"}));

TEST(ReadFilm, TellsWhatElseIsWrong) {
  const auto reported = [](const std::string& json) { return document::failure_of([&] { film_of(json); }); };
  const std::string rest = R"(, "models": {}, "actors": []})";
  EXPECT_TRUE(document::holds(reported("{}"), "has no 'frames'"));
  EXPECT_TRUE(document::holds(reported("{\"frames\": 0}"), "from 1 to 1000000"));
  EXPECT_TRUE(document::holds(reported("{\"frames\": 1, \"size\": [0, 5]}"), "size[0]: is 0"));
  EXPECT_TRUE(document::holds(reported("{\"frames\": 1, \"size\": [99999, 5]}"), "to 16384"));
  EXPECT_TRUE(document::holds(reported("{\"frames\": 1, \"dice\": \"adaptiv\"}"), "did you mean 'adaptive'?"));
  EXPECT_TRUE(document::holds(reported(R"({"frames": 1, "camera": {})" + rest), "camera: has no 'eye'"));
  EXPECT_TRUE(document::holds(reported(R"({"frames": 1, "camera": {"eye": [0, 1, 0], "near": 5, "far": 5})" + rest),
                              "not beyond"));
  const std::string camera = R"({"frames": 1, "camera": {"eye": [0, 1, 0]}, "lights": [)";
  EXPECT_TRUE(document::holds(reported(camera + "{}]" + rest), "neither a direction nor a place"));
  EXPECT_TRUE(document::holds(reported(camera + R"({"place": [0, 0, 0], "direction": [0, 0, 1]}])" + rest),
                              "both a direction"));
  EXPECT_TRUE(document::holds(reported(camera + R"({"direction": [0, 0, 0]}])" + rest), "has no length"));
  EXPECT_TRUE(document::holds(reported(R"({"joints": [{"name": "a"}]})"),
                              "is a model, not a film (look at it with mars preview"));
  EXPECT_TRUE(document::holds(
      reported(R"({"frames": 1, "camera": {"eye": [0, 1, 0]}, "models": {"m": "m.json"}, "actors": []})"),
      "models.m: is '/nowhere/m.json', which does not exist"));
  const std::string materials = R"({"frames": 1, "camera": {"eye": [0, 1, 0]}, "materials": {"m": )";
  EXPECT_TRUE(document::holds(reported(materials + R"({"x": 1}})" + rest), "materials.m.x: is no key of a material"));
  EXPECT_TRUE(document::holds(reported(materials + R"({"keys": [{}]}})" + rest), "a key of a material needs it"));
  EXPECT_TRUE(document::holds(reported(materials + R"({"keys": [{"x": 1}]}})" + rest),
                              "x: does not belong to a key of a material"));
  const auto named = [&](const std::string& model) {
    return reported(R"({"frames": 1, "camera": {"eye": [0, 1, 0]}, "actors": [], "models": {"m": )" + model + "}}");
  };
  EXPECT_EQ(named(R"("/")"), "f.json:1: models.m: is '/', which is not a regular file (name a file on a disk)");
  EXPECT_TRUE(
      document::holds(named(R"("/dev/zero")"), "f.json:1: models.m: is '/dev/zero', which is not a regular file"));
  EXPECT_TRUE(document::holds(named(R"({"from": "none.json", "proportions": {}})"),
                              "f.json:1: models.m.from: is 'none.json', which does not exist"));
}

std::string outcome_of(const std::string& json) {
  try {
    compiled(json);
    return "film";
  } catch (const Failure& failure) {
    return failure.what();
  }
}

TEST(ReadFilm, CutShortAnywhereIsOneClearError) {
  const std::string whole = kWhole;
  EXPECT_EQ(outcome_of(whole), "film");
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_TRUE(document::holds(outcome_of(whole.substr(0, length)), whole.find_first_not_of(" \n") < length
                                                                         ? "it ends before its last bracket"
                                                                         : "is empty"))
        << length;
}

TEST(ReadFilm, FlippedBytesAreAFilmOrOneError) {
  std::mt19937 random(7);
  for (int round = 0; round < 20'000; ++round) {
    std::string json = kWhole;
    for (int flips = 1 + round % 3; flips > 0; --flips) json[random() % json.size()] = char(random());
    const std::string outcome = outcome_of(json);
    EXPECT_TRUE(outcome == "film" || document::holds(outcome, "f.json") || document::holds(outcome, "/nowhere"))
        << outcome;
  }
}

TEST(ReadFilm, LimitsOfTheWrongFormShowTheRightOne) {
  const auto reported = [](const std::string& limits) {
    return document::failure_of([&] {
      film_of(R"({"frames": 1, "camera": {"eye": [0, -9, 2]}, "actors": [], "models": {"m": {"joints": [
                 {"name": "j", "limits": )" +
              limits + "}]}}}");
    });
  };
  EXPECT_TRUE(document::holds(reported("[-30, 30]"),
                              R"(joints[0].limits: is a list, not an object (write "limits": {"x": [-30, 30]}))"));
  EXPECT_TRUE(document::holds(reported(R"({"y": 30})"), R"(limits.y: is a number, not a list (write "y": [-30, 30]))"));
  EXPECT_TRUE(document::holds(reported(R"({"x": [1, 2, 3]})"), R"(has 3 items (write "x": [-30, 30]))"));
  EXPECT_TRUE(document::holds(reported(R"({"x": ["a", 3]})"),
                              R"(limits.x[0]: is a text, not a number (write "x": [-30, 30]))"));
  EXPECT_TRUE(document::holds(reported(R"({"x": [30, -30]})"), R"("x": [-30, 30])"));
}

TEST(ReadFilm, ColoursUpTo255AreToldToDivide) {
  const auto reported = [](const std::string& color) {
    return document::failure_of([&] {
      film_of(R"({"frames": 1, "camera": {"eye": [0, -9, 2]}, "actors": [], "models": {}, "background": )" + color +
              "}");
    });
  };
  EXPECT_EQ(reported("[255, 128, 51]"),
            "f.json:1: background: has 255, above 1, where colours go from 0 to 1 (divide by 255: [1, 0.502, 0.2])");
  EXPECT_EQ(reported("[1e18, 0, 0]"), "f.json:1: background[0]: is 1e+18 (write a number from 0 to 1)");
  EXPECT_EQ(reported("[256, 0, 0]"), "f.json:1: background[0]: is 256 (write a number from 0 to 1)");
  EXPECT_EQ(reported("[200, -1, 0]"), "f.json:1: background[0]: is 200 (write a number from 0 to 1)");
  EXPECT_TRUE(document::holds(reported("[0, 1]"), R"(has 2 items (write "background": [0.1, 0.2, 0.3]))"));
  EXPECT_EQ(reported("[0, 1.5, 0]"), "f.json:1: background[1]: is 1.5 (write a number from 0 to 1)");
  EXPECT_EQ(reported("[0, 1, 0.5]"), "");
  EXPECT_TRUE(document::holds(
      document::failure_of(
          [] { film_of(arm_film("", R"("frames": 2, "lights": [{"direction": [0, 0, 1], "color": [0, 0, 200]}])")); }),
      "lights[0].color: has 200, above 1"));
}

}  // namespace
}  // namespace mars::film
