// Keys made, moved, copied, deleted and timed: what the film does afterwards, and what its file says.
#include "host/content/animator/keys/keys.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "host/content/animator/listing/keys_table.h"
#include "host/content/animator/keys/pose.h"
#include "host/content/animator/reading/read_film.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::animator {
namespace {

constexpr const char* kArm = R"(
  {"name": "shoulder", "limits": {"x": [-90, 90], "y": [-90, 90], "z": [-90, 90]}},
  {"name": "elbow", "parent": "shoulder", "place": [1, 0, 0], "limits": {"y": [0, 150]}},
  {"name": "turn", "parent": "elbow", "limits": {"z": [-20, 20]}},
  {"name": "bolt", "parent": "elbow", "limits": {}})";

// A film file as JSON and as it is read, with the edits of a person.
struct Scene {
  document::Json json;
  Film film;

  explicit Scene(const std::string& actor, const std::string& more = "")
      : json(document::Json::parse(R"({"frames": 49, "camera": {"eye": [0, -9, 2]}, "models": {"arm": {"joints": [)" +
                                   std::string(kArm) + R"(]}}, "actors": [{"name": "it", "model": "arm")" + actor +
                                   "}" + more + "]}")) {
    read();
  }

  void read() {
    const document::Document document(document::laid_out(json), "f.json");
    film = read_film(document.root(), {});
  }

  const document::Json& keys() const { return json["actors"][0]["keys"]; }
  std::string frames() const {
    std::string text;
    for (const document::Json& key : keys()) text += (text.empty() ? "" : " ") + key["frame"].dump();
    return text;
  }

  // Where the joint with this number stands, and how it is turned.
  modeler::Axes stands(std::size_t joint, std::uint32_t frame) const {
    Figure figure(film.models[0], film.actors[0].motion);
    figure.move_to(frame);
    return figure.frame_of(joint);
  }

  template <typename Edit>
  Remarks operator()(Edit edit) {
    Remarks remarks = edit(json, film);
    read();
    return remarks;
  }
};

const Choice kIt{false, "it", {}};

// Moves everything, on curves, in 0..24 and 24..48.
constexpr const char* kMoving = R"(, "keys": [
  {"frame": 0, "place": [0, 0, 0], "turn": [0, 0, 0], "pose": {"shoulder": [0, 0, 0], "elbow": [0, 10, 0]}, "ease": "both"},
  {"frame": 24, "place": [3, 0, 0], "turn": [10, 20, 30], "pose": {"shoulder": [30, -40, 50], "elbow": [0, 90, 0]}, "ease": "in"},
  {"frame": 48, "place": [3, 2, 0], "turn": [0, 0, 90], "pose": {"shoulder": [0, 10, 0], "elbow": [0, 0, 0]}}])";

double farthest_apart(const Scene& a, const Scene& b, std::uint32_t frame_of_a, std::uint32_t frame_of_b) {
  double worst = 0;
  for (std::size_t joint = 0; joint < 4; ++joint) {
    const modeler::Axes one = a.stands(joint, frame_of_a), other = b.stands(joint, frame_of_b);
    worst = std::max(worst, glm::length(one.place - other.place));
    for (int i = 0; i < 3; ++i) worst = std::max(worst, glm::length(one.turn[i] - other.turn[i]));
  }
  return worst;
}

TEST(Pose, SetsOneAxisAndKeepsTheOthers) {
  Scene scene(kMoving);
  const std::vector<std::string> settings = {"shoulder.y=-20", "place.z=1", "elbow=0,45,0"};
  scene([&](document::Json& j, const Film& f) { return pose(j, f, "it", settings, {24, 24}, {}); });
  EXPECT_EQ(
      scene.keys()[1].dump(),
      R"({"frame":24,"place":[3,0,1],"turn":[10,20,30],"pose":{"shoulder":[30,-20,50],"elbow":[0,45,0]},"ease":"in"})");
}

TEST(Pose, WhatHasNoKeyMovesFromFrame0On) {
  Scene scene(R"(, "place": [1, 2, 3], "pose": {"elbow": [0, 30, 0]})");
  const std::vector<std::string> settings = {"place.x=5", "elbow.y=60", "shoulder.z=7", "/turn.z=-4"};
  scene([&](document::Json& j, const Film& f) { return pose(j, f, "it", settings, {12, 12}, {.ease = kBoth}); });
  document::Json actor = scene.json["actors"][0];
  EXPECT_EQ(
      actor.dump(),
      R"({"name":"it","model":"arm","keys":[)"
      R"({"frame":0,"place":[1,2,3],"pose":{"elbow":[0,30,0],"shoulder":[0,0,0],"turn":[0,0,0]}},)"
      R"({"frame":12,"place":[5,2,3],"pose":{"elbow":[0,60,0],"shoulder":[0,0,7],"turn":[0,0,-4]},"ease":"both"}]})");
}

TEST(Pose, LimitsAreHeldAndTold) {
  Scene scene(kMoving);
  const document::Json before = scene.json;
  const auto wanted = [&](const std::string& setting, Beyond beyond) {
    const std::vector<std::string> settings = {setting};
    return document::failure_of([&] { pose(scene.json, scene.film, "it", settings, {10, 10}, {.beyond = beyond}); });
  };
  EXPECT_EQ(wanted("elbow.y=170", Beyond::refused),
            "actor 'it', joint 'elbow': turns 170 degrees about y, outside its limits 0 to 150 (--clamp takes the "
            "nearest allowed, or widen the limits in its model)");
  EXPECT_EQ(scene.json, before);
  EXPECT_EQ(wanted("elbow.y=170", Beyond::clamped), "");
  EXPECT_EQ(scene.keys()[1]["pose"]["elbow"].dump(), "[0,150,0]");
  const std::vector<std::string> settings = {"elbow.y=-170", "elbow.x=20"};
  EXPECT_EQ(pose(scene.json, scene.film, "it", settings, {10, 10}, {.beyond = Beyond::clamped}),
            (Remarks{"actor 'it', joint 'elbow': -170 degrees about y is beyond its limits 0 to 150: keyed as 0",
                     "actor 'it', joint 'elbow': 20 degrees about x, where it is locked at 0: keyed as 0"}));
}

TEST(Pose, TellsWhatItDoesNotUnderstand) {
  Scene scene(kMoving);
  const auto reported = [&](const std::string& setting) {
    const std::vector<std::string> settings = {setting};
    return document::failure_of([&] { pose(scene.json, scene.film, "it", settings, {10, 10}, {}); });
  };
  EXPECT_TRUE(document::holds(reported("elbow"), "write it like elbow.y=90"));
  EXPECT_TRUE(document::holds(reported("elbow=1"), "one number for one axis"));
  EXPECT_TRUE(document::holds(reported("elbow.y=1,2"), "has 2 numbers"));
  EXPECT_TRUE(document::holds(reported("elbow.y=nan"), "where a number belongs"));
  EXPECT_TRUE(document::holds(reported("elbow.y="), "where a number belongs"));
  EXPECT_TRUE(document::holds(reported("elbwo.y=1"), "did you mean"));
  EXPECT_TRUE(document::holds(reported("=1"), "write it like"));
  EXPECT_TRUE(document::holds(reported("-knee"), "'-knee': is not PART=NUMBERS"));
  EXPECT_TRUE(document::holds(reported("place=2"), "like place.y=0, or three for all: place="));
  const auto failure_of_two = [&](const std::vector<std::string>& settings) {
    return document::failure_of([&] { pose(scene.json, scene.film, "it", settings, {10, 10}, {}); });
  };
  EXPECT_EQ(failure_of_two({"elbow.y=20", "elbow.y=30"}),
            "'elbow.y=30': sets what an earlier word has set (give each part and axis once)");
  EXPECT_TRUE(document::holds(failure_of_two({"place=1,2,3", "place.z=3"}), "'place.z=3': sets what"));
  const std::vector<std::string> eye = {"eye=1,2"};
  EXPECT_TRUE(
      document::holds(document::failure_of([&] {
                        pose(scene.json, scene.film, "camera", eye, {3, 3}, {});
                      }),
                      "has 2 numbers (write one number for one axis, like eye.y=-9, or three for all: eye=0,-9,2)"));
}

TEST(Pose, TheCameraIsSetToo) {
  Scene scene("");
  const std::vector<std::string> settings = {"eye.x=4", "fov=30"};
  scene([&](document::Json& j, const Film& f) { return pose(j, f, "camera", settings, {10, 10}, {}); });
  EXPECT_EQ(scene.json["camera"].dump(),
            R"({"keys":[{"frame":0,"eye":[0,-9,2],"fov":40},{"frame":10,"eye":[4,-9,2],"fov":30}]})");
}

TEST(Pose, ExposureBelongsToCamerasOfLinearFilms) {
  Scene scene("");
  const std::vector<std::string> settings = {"exposure=-1.5"};
  const auto brighten = [&](document::Json& j, const Film& f) { return pose(j, f, "camera", settings, {10, 10}, {}); };
  scene(brighten);
  EXPECT_EQ(scene.film.camera.exposure.back().value, -1.5);
  Scene coded("", "], \"color\": \"coded\", \"lights\": [");
  EXPECT_TRUE(document::holds(document::failure_of([&] { coded(brighten); }), "its parts are: eye, at, up, fov"));
}

TEST(MakeKeys, LightsAndMaterialsHaveTheKeysThatTheyUse) {
  Scene scene("", R"(], "materials": {"tin": {"reflection": "metallic-roughness",
      "keys": [{"frame": 0, "roughness": 0.2}, {"frame": 20, "roughness": 0.4}]}},
      "lights": [{"place": [0, 0, 3], "at": [0, 0, 0], "keys": [{"frame": 0, "cone": 30}]}, {"direction": [0, 0, 1]})");
  const Choice all{true, "", {}};
  scene([&](document::Json& j, const Film& f) { return make_keys(j, f, all, 10, {}, Beyond::refused); });
  EXPECT_EQ(scene.json["lights"][0]["keys"][1].dump(), R"({"frame":10,"cone":[24,30]})");
  EXPECT_FALSE(scene.json["lights"][1].contains("keys"));
  EXPECT_EQ(scene.json["materials"]["tin"]["keys"][1]["roughness"].get<double>(), 0.3);
}

TEST(MakeKeys, TheFilmMovesAsBefore) {
  const Scene before(kMoving);
  Scene scene(kMoving);
  for (const std::uint32_t frame : {7u, 12u, 40u})
    EXPECT_TRUE(scene([&](document::Json& j, const Film& f) {
                  return make_keys(j, f, kIt, frame, {}, Beyond::refused);
                }).empty());
  EXPECT_EQ(scene.frames(), "0 7 12 24 40 48");
  for (std::uint32_t frame = 0; frame <= 48; ++frame)
    EXPECT_LT(farthest_apart(scene, before, frame, frame), 1e-7) << frame;
  EXPECT_FALSE(scene.keys()[1]["pose"].contains("bolt")) << "it has no freedom";
}

TEST(MakeKeys, OfSomePartsWithAnEase) {
  Scene scene(kMoving);
  scene([&](document::Json& j, const Film& f) {
    return make_keys(j, f, {false, "it", {"elbow", "place"}}, 24 + 12, kOut, Beyond::refused);
  });
  EXPECT_EQ(scene.keys()[2].size(), 4u);
  EXPECT_EQ(scene.keys()[2]["ease"], "out");
  EXPECT_EQ(scene.keys()[2]["pose"].size(), 1u);
}

TEST(MakeKeys, OfOnePartLeaveTheEaseOfOthers) {
  const Scene before(kMoving);
  Scene scene(kMoving);
  EXPECT_TRUE(scene([&](document::Json& j, const Film& f) {
                return make_keys(j, f, {false, "it", {"elbow"}}, 12, {}, Beyond::refused);
              }).empty());
  EXPECT_EQ(scene.keys()[0]["ease"], "both");
  EXPECT_TRUE(scene.keys()[0]["pose"]["elbow"]["ease"].is_array());
  EXPECT_EQ(scene.keys()[0]["pose"]["shoulder"].dump(), "[0,0,0]");
  for (std::uint32_t frame = 0; frame <= 48; ++frame)
    EXPECT_LT(farthest_apart(scene, before, frame, frame), 1e-7) << frame;
}

TEST(MoveKeys, GoWithTheirEaseAndReplaceOthers) {
  Scene scene(kMoving);
  scene([&](document::Json& j, const Film& f) { return move_keys(j, f, kIt, {24, 24}, 30); });
  EXPECT_EQ(scene.frames(), "0 30 48");
  EXPECT_EQ(scene.keys()[1]["ease"], "in");
  scene([&](document::Json& j, const Film& f) { return move_keys(j, f, {false, "it", {"elbow"}}, {30, 48}, 32); });
  EXPECT_EQ(scene.frames(), "0 30 32 48 50");
  EXPECT_EQ(scene.keys()[2]["pose"].dump(), R"({"elbow":[0,90,0]})");
  scene([&](document::Json& j, const Film& f) { return move_keys(j, f, kIt, {0, 0}, 30); });
  EXPECT_EQ(scene.keys()[0]["place"].dump(), "[0,0,0]");
}

TEST(MoveKeys, NotBeforeTheFilmAndNotWhereNoneAre) {
  Scene scene(kMoving);
  const document::Json before = scene.json;
  EXPECT_EQ(document::failure_of([&] {
              move_keys(scene.json, scene.film, kIt, {1, 20}, 30);
            }),
            "actor 'it': has no key in frames 1 to 20 (its keys stand at 0, 24, 48)");
  EXPECT_TRUE(document::holds(document::failure_of([&] {
                                move_keys(scene.json, scene.film, kIt, {24, 48}, 1'000'000);
                              }),
                              "frame 1000024"));
  EXPECT_EQ(scene.json, before);
}

TEST(CopyKeys, OfARange) {
  const Scene before(kMoving);
  Scene scene(kMoving);
  scene([&](document::Json& j, const Film& f) { return copy_keys(j, f, kIt, {0, 24}, 48); });
  EXPECT_EQ(scene.frames(), "0 24 48 72");
  for (std::uint32_t frame = 0; frame < 24; ++frame)
    EXPECT_LT(farthest_apart(scene, before, 48 + frame, frame), 1e-12) << frame;
}

TEST(DeleteKeys, OfAJointOrOfAll) {
  Scene scene(kMoving);
  scene([&](document::Json& j, const Film& f) {
    return delete_keys(j, f, {false, "it", {"elbow", "place"}}, {0, 1'000'000});
  });
  EXPECT_EQ(scene.frames(), "0 24 48");
  EXPECT_FALSE(scene.keys()[0]["pose"].contains("elbow"));
  scene([&](document::Json& j, const Film& f) { return delete_keys(j, f, kIt, {0, 1'000'000}); });
  EXPECT_FALSE(scene.json["actors"][0].contains("keys"));
}

TEST(Hold, StandsStillAndGoesOnAsBefore) {
  const Scene before(kMoving);
  for (const std::uint32_t at : {10u, 24u}) {
    Scene scene(kMoving);
    scene([&](document::Json& j, const Film& f) { return hold(j, f, kIt, at, 6); });
    for (std::uint32_t frame = 0; frame <= 48 + 6; ++frame) {
      const std::uint32_t was = frame <= at ? frame : frame <= at + 6 ? at : frame - 6;
      EXPECT_LT(farthest_apart(scene, before, frame, was), 1e-7) << frame;
    }
  }
}

TEST(Stretch, WhatFollowsComesLater) {
  Scene scene(kMoving);
  scene([&](document::Json& j, const Film& f) { return stretch(j, f, kIt, {0, 24}, 1.5); });
  EXPECT_EQ(scene.frames(), "0 36 60");
  scene([&](document::Json& j, const Film& f) { return stretch(j, f, kIt, {0, 60}, 0.1); });
  EXPECT_EQ(scene.frames(), "0 4 6");
  EXPECT_TRUE(document::holds(document::failure_of([&] {
                                stretch(scene.json, scene.film, kIt, {0, 6}, 0.1);
                              }),
                              "two would stand"));
}

TEST(Shift, PassesNoKey) {
  Scene scene(kMoving);
  scene([&](document::Json& j, const Film& f) { return shift(j, f, kIt, 24, 5); });
  EXPECT_EQ(scene.frames(), "0 29 53");
  scene([&](document::Json& j, const Film& f) { return shift(j, f, kIt, 20, -8); });
  EXPECT_EQ(scene.frames(), "0 21 45");
  EXPECT_TRUE(
      document::holds(document::failure_of([&] { shift(scene.json, scene.film, kIt, 40, -30); }), "would lose keys"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { shift(scene.json, scene.film, kIt, 0, -30); }), "frame -9"));
}

TEST(EaseKeys, OfAllThatIsKeyedThere) {
  Scene scene(kMoving);
  scene([&](document::Json& j, const Film& f) { return ease_keys(j, f, kIt, {0, 24}, swinging(0.1, 0)); });
  EXPECT_TRUE(scene.keys()[0]["ease"].is_array());
  EXPECT_EQ(scene.keys()[0]["ease"], scene.keys()[1]["ease"]);
  EXPECT_FALSE(scene.keys()[2].contains("ease"));
}

TEST(All, IsCameraLightsMaterialsAndActorsButMatrices) {
  Scene scene(kMoving, R"(, {"name": "pot", "model": "arm", "matrices": [{"frame": 0, "segments": {}}]})");
  scene.json["camera"] = document::Json::parse(R"({"keys": [{"frame": 10, "eye": [1, 1, 1]}]})");
  scene.json["lights"] = document::Json::parse(R"([{"keys": [{"frame": 2, "direction": [0, 0, 2]}]}])");
  scene.json["materials"] = document::Json::parse(R"({"red": {"keys": [{"frame": 3, "color": [1, 0, 0]}]}})");
  scene.read();
  const Remarks remarks = scene([&](document::Json& j, const Film& f) { return shift(j, f, {true, "", {}}, 0, 7); });
  EXPECT_EQ(remarks, Remarks{"actor 'pot' is moved by matrices and stays as it is"});
  EXPECT_TRUE(document::holds(document::failure_of([&] {
                                shift(scene.json, scene.film, {false, "pot", {}}, 0, 7);
                              }),
                              "actor 'pot': is moved by matrices, which have no keys"));
  EXPECT_EQ(scene.frames(), "7 31 55");
  EXPECT_EQ(scene.json["camera"]["keys"][0]["frame"], 17);
  EXPECT_EQ(scene.json["lights"][0]["keys"][0].dump(), R"({"frame":9,"direction":[0,0,2]})");
  EXPECT_EQ(scene.json["materials"]["red"]["keys"][0]["frame"], 10);
}

TEST(EaseKeys, ALastKeyTakesAnotherEaseToo) {
  Scene scene(R"(, "keys": [{"frame": 0, "pose": {"elbow": [0, 0, 0]}},
                            {"frame": 10, "pose": {"elbow": [0, 50, 0]}, "ease": "in"}])");
  ease_keys(scene.json, scene.film, {false, "it", {}}, {10, 10}, kOut);
  EXPECT_EQ(scene.keys()[1]["ease"], "out");
}

TEST(KeysTable, ShowsWhatIsFree) {
  Scene scene(kMoving);
  const std::string table = keys_table(scene.json, scene.film, {true, "", {}}, {20, 48});
  EXPECT_EQ(table,
            "actor 'it'\n"
            "  frame  part      value              ease\n"
            "     24  place     x 3  y 0  z 0      in\n"
            "         turn      x 10  y 20  z 30\n"
            "         shoulder  x 30  y -40  z 50\n"
            "         elbow     y 90\n"
            "     48  place     x 3  y 2  z 0\n"
            "         turn      x 0  y 0  z 90\n"
            "         shoulder  x 0  y 10  z 0\n"
            "         elbow     y 0\n"
            "no keys: camera\n");
}

Remarks posed(Scene& scene, const std::string& setting, std::uint32_t frame, std::optional<Ease> ease = {}) {
  const std::vector<std::string> settings = {setting};
  return scene([&](document::Json& j, const Film& f) {
    return pose(j, f, "it", settings, {frame, frame}, {.ease = ease});
  });
}

TEST(SideEffects, ATurnThatGoesBackIsToldAndHowToGoRound) {
  Scene scene("");
  const Remarks back = posed(scene, "turn.z=270", 20);
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(
      back[0],
      "actor 'it': turn goes 90 degrees back from frame 0 to 20, not 270 degrees about z: from key to key it takes "
      "the smallest turn (to go round, also pose it turn.z=135 --frame 10)");
  EXPECT_TRUE(posed(scene, "turn.z=135", 10).empty());
  EXPECT_TRUE(posed(scene, "turn.z=280", 24).empty());
  // Without the key between it goes back again.
  const Remarks deleted = scene([&](document::Json& j, const Film& f) {
    return delete_keys(j, f, {false, "it", {"/turn", "turn"}}, {10, 10});
  });
  ASSERT_EQ(deleted.size(), 1u);
  EXPECT_TRUE(document::holds(deleted[0], "goes 90 degrees back from frame 0 to 20")) << deleted[0];
  // What was so before is not reported again.
  EXPECT_TRUE(scene([&](document::Json& j, const Film& f) {
                return make_keys(j, f, {false, "it", {"turn"}}, 8, {}, Beyond::refused);
              }).empty());
  EXPECT_TRUE(scene([&](document::Json& j, const Film& f) {
                return shift(j, f, {false, "it", {"turn"}}, 8, 4);
              }).empty());
}

struct Turned {
  const char* setting;
  const char* reported;
};

class OtherWay : public testing::TestWithParam<Turned> {};

TEST_P(OtherWay, IsTold) {
  Scene scene("");
  const Remarks remarks = posed(scene, GetParam().setting, 20);
  if (std::string(GetParam().reported).empty()) {
    EXPECT_TRUE(remarks.empty()) << remarks[0];
  } else {
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_TRUE(document::holds(remarks[0], GetParam().reported)) << remarks[0];
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, OtherWay,
    testing::Values(Turned{"turn.z=180", ""}, Turned{"turn.z=-180", "goes 180 degrees back"}, Turned{"turn.x=179", ""},
                    Turned{"turn.z=450", "goes 90 degrees on from frame 0 to 20, not 450 degrees about z"},
                    Turned{"turn.y=360", "does not turn from frame 0 to 20, not 360 degrees about y"},
                    Turned{"turn.y=360", "pose it turn.y=120 --frame 7, pose it turn.y=240 --frame 13)"},
                    Turned{"turn=10,20,400", "turn goes only "}, Turned{"turn=100,80,-170", ""},
                    Turned{"elbow.y=150", ""}, Turned{"shoulder=90,-90,90", ""}));

TEST(SideEffects, AHingeGoesRoundByItself) {
  Scene scene("");
  scene.json["models"]["arm"]["joints"][1]["limits"]["y"] = {-1000, 1000};
  scene.read();
  EXPECT_TRUE(posed(scene, "elbow.y=900", 20).empty());
}

TEST(Pose, AnEaseIsOfTheNamedPartsAlone) {
  Scene scene(kMoving);
  EXPECT_TRUE(posed(scene, "elbow.y=60", 24, kBoth).empty());
  EXPECT_EQ(scene.keys()[1].dump(), R"({"frame":24,"place":[3,0,0],"turn":[10,20,30],"pose":{"shoulder":[30,-40,50],)"
                                    R"("elbow":{"value":[0,60,0],"ease":"both"}},"ease":"in"})");
  posed(scene, "elbow.y=60", 24, kIn);
  EXPECT_EQ(scene.keys()[1]["pose"]["elbow"].dump(), "[0,60,0]");
}

TEST(Pose, AnEaseOfOneJointIsNoneOfOthersThatMoveLater) {
  Scene scene("");
  for (const char* still : {"elbow.y=0", "shoulder.z=0"}) posed(scene, still, 0);
  posed(scene, "elbow.y=20", 20);
  scene([](document::Json& j, const Film& f) { return ease_keys(j, f, {false, "it", {"elbow"}}, {0, 0}, kBoth); });
  posed(scene, "shoulder.z=15", 20);
  posed(scene, "turn.z=40", 20);
  const FigureMotion& motion = scene.film.actors[0].motion;
  EXPECT_NEAR(JointMotion(scene.film.models[0].joints[0], motion.pose[0]).pose_at(5).z, 3.75, 1e-9);
  EXPECT_NEAR(JointMotion(scene.film.models[0].joints[1], motion.pose[1]).pose_at(5).y, 20 * eased(kBoth, 0.25), 1e-9);
  EXPECT_EQ(motion.turn[0].ease, kLinear);
}

}  // namespace
}  // namespace mars::animator
