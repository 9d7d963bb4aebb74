// Settings as people type them: relative ones, over ranges, by patterns, of lights and materials.
#include "host/content/animator/keys/pose.h"

#include <gtest/gtest.h>

#include "host/content/animator/pose/check.h"
#include "host/content/animator/reading/read_film.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::animator {
namespace {

constexpr const char* kFilm = R"({
  "frames": 49, "camera": {"eye": [0, -9, 2]},
  "lights": [{"direction": [0, 0, 1]}, {"place": [0, 0, 4], "at": [0, 0, 0], "cone": [20, 30]}],
  "materials": {"skin": {"color": [0.5, 0.5, 0.5]}},
  "models": {"legs": {"joints": [
    {"name": "hip"},
    {"name": "left-shin", "parent": "hip", "limits": {"y": [0, 150]}},
    {"name": "right-shin", "parent": "hip", "limits": {"y": [0, 150]}},
    {"name": "bolt-shin", "parent": "hip", "limits": {}}]}},
  "actors": [{"name": "it", "model": "legs", "keys": [
    {"frame": 0, "pose": {"left-shin": [0, 10, 0]}}, {"frame": 24, "pose": {"left-shin": [0, 90, 0]}}]}]})";

class Poses : public testing::Test {
 protected:
  void read() {
    const document::Document document(document::laid_out(json_), "f.json");
    film_ = read_film(document.root(), {});
  }

  Remarks pose(const std::string& thing, const std::vector<std::string>& settings, FrameRange range,
               Beyond beyond = Beyond::refused, std::uint32_t falloff = 0) {
    read();
    const Remarks remarks =
        animator::pose(json_, film_, thing, settings, range, {.beyond = beyond, .falloff = falloff});
    read();
    return remarks;
  }

  std::string failure(const std::string& thing, const std::vector<std::string>& settings, FrameRange range) {
    return document::failure_of([&] { pose(thing, settings, range); });
  }

  const document::Json& key(std::size_t number) { return json_["actors"][0]["keys"][number]["pose"]; }

  document::Json json_ = document::Json::parse(kFilm);
  Film film_;
};

TEST_F(Poses, TurnOnFromWhatIsThere) {
  pose("it", {"left-shin.y+=7", "place.x-=2"}, {12, 12});
  EXPECT_EQ(key(1), document::Json::parse(R"({"left-shin": [0, 57, 0]})"));
  EXPECT_EQ(json_["actors"][0]["keys"][1]["place"], document::Json::parse("[-2, 0, 0]"));
  pose("it", {"left-shin+=0,-7,0"}, {12, 12});
  EXPECT_EQ(key(1), document::Json::parse(R"({"left-shin": [0, 50, 0]})"));
}

TEST_F(Poses, ChangeAllKeysOfARange) {
  pose("it", {"left-shin.y-=10"}, {0, 48});
  EXPECT_EQ(key(0)["left-shin"][1], 0);
  EXPECT_EQ(key(1)["left-shin"][1], 80);
  EXPECT_NE(failure("it", {"left-shin.y-=10"}, {1, 23}).find("finds no key of actor 'it' in frames 1 to 23"),
            std::string::npos);
  EXPECT_NE(failure("it", {"left-shin.y=10"}, {0, 23}).find("+="), std::string::npos);
  EXPECT_NE(failure("it", {"left-shin.y-=10"}, {0, 48}).find("outside its limits 0 to 150"), std::string::npos);
  EXPECT_EQ(pose("it", {"left-shin.y-=10"}, {0, 48}, Beyond::clamped).size(), 1u);
}

TEST_F(Poses, ByPatternsAreOfAllPartsThatCanTurnThere) {
  pose("it", {"*-shin.y+=5"}, {12, 12});
  EXPECT_EQ(key(1), document::Json::parse(R"({"left-shin": [0, 55, 0], "right-shin": [0, 5, 0]})"));
  pose("it", {"*.y+=5"}, {12, 12});
  EXPECT_FALSE(key(1).contains("place")) << "degrees are no lengths";
  EXPECT_EQ(key(1)["left-shin"], document::Json::parse("[0, 60, 0]"));
  EXPECT_NE(failure("it", {"*-shin.x+=5"}, {12, 12}).find("like it are: left-shin, right-shin"), std::string::npos);
  EXPECT_NE(failure("it", {"*-shim.y+=5"}, {12, 12}).find("its parts are: place, turn"), std::string::npos);
  EXPECT_NE(failure("it", {"*-shin.y+=5", "left-shin.y=1"}, {12, 12}).find("an earlier word"), std::string::npos);
  read();
  const auto parts = choose(json_, film_, {false, "it", {"/*"}}).front().parts;
  EXPECT_EQ(parts, (std::vector<std::string>{"/hip", "/left-shin", "/right-shin"}));
}

TEST_F(Poses, OfLightsAndMaterials) {
  pose("light/2", {"cone=10,12", "color.x=0.5", "intensity=3"}, {24, 24});
  EXPECT_EQ(json_["lights"][1]["keys"][1]["cone"], document::Json::parse("[10, 12]"));
  EXPECT_EQ(json_["lights"][1]["keys"][0]["color"], document::Json::parse("[1, 1, 1]"));
  EXPECT_EQ(json_["lights"][1]["keys"][1]["color"], document::Json::parse("[0.5, 1, 1]"));
  pose("material/skin", {"color.z+=0.1"}, {0, 0});
  EXPECT_EQ(json_["materials"]["skin"]["keys"][0]["color"], document::Json::parse("[0.5, 0.5, 0.6]"));
  EXPECT_NE(failure("light/2", {"intensity=3000"}, {24, 24}).find("from 0 to 1000"), std::string::npos);
}

// A light without a reach has the same brightness at all distances, which no number says: no key is made before.
TEST_F(Poses, GiveALightWhatItDoesNotHaveYet) {
  EXPECT_NE(failure("light/2", {"reach+=2"}, {24, 24}).find("has no reach yet"), std::string::npos);
  EXPECT_NE(failure("light/2", {"reech=2"}, {24, 24}).find("did you mean 'reach'?"), std::string::npos);
  EXPECT_NE(failure("light/1", {"reach=2"}, {24, 24}).find("direction, color, intensity"), std::string::npos);
  read();
  EXPECT_NE(document::failure_of([&] {
              choose(json_, film_, {false, "light/2", {"reach"}});
            }).find("no reach yet"),
            std::string::npos);
  pose("light/2", {"reach=5"}, {24, 24});
  EXPECT_EQ(json_["lights"][1]["keys"], document::Json::parse(R"([{"frame": 24, "reach": 5}])"));
  EXPECT_EQ(film_.lights[1].reach.size(), 1u);
  pose("light/2", {"reach+=2"}, {30, 30});
  EXPECT_EQ(json_["lights"][1]["keys"][1]["reach"], 7);
}

TEST_F(Poses, NameLightsAndMaterialsThatThereAre) {
  EXPECT_NE(failure("light/3", {"intensity=3"}, {0, 0}).find("light/1 to light/2"), std::string::npos);
  EXPECT_NE(failure("light/1", {"cone=3,4"}, {0, 0}).find("direction, color, intensity"), std::string::npos);
  EXPECT_NE(failure("light/2", {"cone=3"}, {0, 0}).find("cone=20,30"), std::string::npos);
  EXPECT_NE(failure("material/skni", {"color=1,1,1"}, {0, 0}).find("did you mean 'skin'?"), std::string::npos);
  json_.erase("lights");
  EXPECT_NE(failure("light/1", {"intensity=3"}, {0, 0}).find("mars film FILM light rig"), std::string::npos);
}

TEST_F(Poses, MoveWhatGoesAlongByItsOffset) {
  json_["camera"]["at"] = {{"actor", "it"}, {"offset", {0, 0, 2}}};
  pose("camera", {"at.z+=1"}, {24, 24});
  EXPECT_EQ(json_["camera"]["keys"][1]["at"], document::Json::parse(R"({"actor": "it", "offset": [0, 0, 3]})"));
  EXPECT_EQ(json_["camera"]["keys"][0]["at"], document::Json::parse(R"({"actor": "it", "offset": [0, 0, 2]})"));
}

// Keys at every frame, as a walk or a recording has them: the shin swings by two degrees a frame.
constexpr const char* kDense = R"({
  "frames": 49, "camera": {"eye": [0, -9, 2]},
  "models": {"legs": {"joints": [{"name": "hip"}, {"name": "shin", "parent": "hip", "limits": {"y": [0, 150]}}]}},
  "actors": [{"name": "it", "model": "legs", "keys": []}]})";

class DensePoses : public Poses {
 protected:
  DensePoses() {
    json_ = document::Json::parse(kDense);
    for (int frame = 0; frame < 49; ++frame)
      json_["actors"][0]["keys"].push_back(
          {{"frame", frame}, {"place", {0.1 * frame, 0, 0}}, {"pose", {{"shin", {0, 2 * frame, 0}}}}});
  }

  double shin(std::uint32_t frame) { return figure_at(frame).y; }
  glm::dvec3 figure_at(std::uint32_t frame) { return value_at(film_.actors[0].motion.pose[1], frame); }
};

TEST_F(DensePoses, RemarkWhatPops) {
  const Remarks remarks = pose("it", {"shin.y=88", "hip.z=3", "place.z=0.4"}, {24, 24});
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0],
            "actor 'it': shin pops by 40 degrees between its keys at frames 23 and 25, with 1 other part (--falloff 8 "
            "blends the change over 8 frames to both sides)");
  EXPECT_TRUE(pose("it", {"shin.y+=6"}, {10, 10}).empty()) << "little faster than it swings";
  json_ = document::Json::parse(kFilm);
  EXPECT_TRUE(pose("it", {"left-shin.y=130"}, {12, 12}).empty()) << "keys are far away";
  EXPECT_TRUE(pose("it", {"left-shin.y=30"}, {14, 14}).empty()) << "and so are those of a pose held to there";
}

TEST_F(DensePoses, BlendTheirChangeToBothSides) {
  EXPECT_TRUE(pose("it", {"shin.y+=40"}, {24, 24}, Beyond::refused, 8).empty());
  EXPECT_EQ(shin(24), 88);
  double before = 0;
  for (const std::uint32_t away : {8u, 7u, 6u, 5u, 4u, 3u, 2u, 1u, 0u}) {
    const double changed = shin(24 - away) - 2 * (24 - away);
    EXPECT_NEAR(changed, shin(24 + away) - 2 * (24 + away), 1e-6) << "the same to both sides";
    EXPECT_GE(changed, before);
    EXPECT_LE(changed - before, 1.5 * 40 / 8) << away;
    before = changed;
  }
  EXPECT_EQ(shin(16), 32);
  EXPECT_EQ(shin(40), 80);
  EXPECT_EQ(json_["actors"][0]["keys"].size(), 49u);
}

TEST_F(DensePoses, BlendBesideARangeAndWithinLimits) {
  EXPECT_NE(document::failure_of([&] {
              pose("it", {"shin.y=149"}, {44, 44}, Beyond::refused, 20);
            }).find("outside its limits 0 to 150"),
            std::string::npos);
  EXPECT_EQ(pose("it", {"shin.y+=60"}, {40, 46}, Beyond::clamped, 4).size(), 1u) << "at frame 46";
  EXPECT_EQ(shin(40), 140);
  EXPECT_EQ(shin(46), 150);
  EXPECT_EQ(shin(36), 72);
  EXPECT_GT(shin(37), 74);
  EXPECT_GT(shin(48), 96) << "the film ends before the blend does";
  const Remarks clamped = pose("it", {"shin.y=149"}, {30, 30}, Beyond::clamped, 16);
  ASSERT_EQ(clamped.size(), 1u);
  EXPECT_NE(clamped[0].find("keyed as 150, and so "), std::string::npos) << clamped[0];
}

// Where keys are far apart, two more keep what is beyond the blend.
TEST_F(Poses, BlendAmongFewKeys) {
  read();
  std::vector<double> were;
  const auto shin = [&](std::uint32_t frame) { return value_at(film_.actors[0].motion.pose[1], frame).y; };
  for (std::uint32_t frame = 0; frame < 49; ++frame) were.push_back(shin(frame));
  pose("it", {"left-shin.y+=20"}, {12, 12}, Beyond::refused, 5);
  EXPECT_NEAR(shin(12), were[12] + 20, 1e-6);
  for (std::uint32_t frame = 0; frame < 49; ++frame) {
    if (frame <= 7 || frame >= 17) {
      EXPECT_NEAR(shin(frame), were[frame], 1e-6) << frame;
    }
  }
  EXPECT_EQ(pose("it", {"right-shin.y=30"}, {3, 3}, Beyond::refused, 5).size(), 0u);
  EXPECT_EQ(value_at(film_.actors[0].motion.pose[2], 8).y, 0);
}

// What a blend leaves alone: what stood still after a spline, and parts that stand still beside one.
TEST_F(Poses, BlendBesideSplines) {
  json_["actors"][0]["keys"] = document::Json::parse(R"([{"frame": 0, "place": [0, 0, 0], "ease": "spline"},
      {"frame": 10, "place": [3, 0, 0], "ease": "spline"}, {"frame": 45, "pose": {"left-shin": [0, 50, 0]}}])");
  pose("it", {"place.y=1"}, {40, 40}, Beyond::refused, 5);
  for (std::uint32_t frame = 10; frame <= 35; ++frame)
    EXPECT_LT(glm::distance(value_at(film_.actors[0].motion.place, frame), glm::dvec3(3, 0, 0)), 1e-9) << frame;
  pose("it", {"left-shin.y=20", "place.z+=1"}, {7, 7}, Beyond::refused, 3);
  for (std::uint32_t frame = 10; frame <= 45; ++frame)
    EXPECT_NEAR(value_at(film_.actors[0].motion.pose[1], frame).y, 50, 1e-9) << frame;
}

// An actor whose place is cut.
class CutPoses : public Poses {
 protected:
  void keys(const char* keys) {
    json_["actors"][0]["keys"] = document::Json::parse(keys);
    read();
    before_ = film_;
  }

  void blend(std::uint32_t frame) { pose("it", {"place.z+=3"}, {frame, frame}, Beyond::refused, 8); }

  double moved(std::uint32_t frame) const {
    return glm::distance(value_at(film_.actors[0].motion.place, frame),
                         value_at(before_.actors[0].motion.place, frame));
  }

  void expect_still_but(FrameRange range) const {
    for (std::uint32_t frame = 0; frame < 49; ++frame) {
      if (range.holds(frame)) continue;
      EXPECT_LT(moved(frame), 1e-6) << frame;
    }
  }

  Film before_;
};

constexpr const char* kCut = R"([{"frame": 0, "place": [0, 0, 0]}, {"frame": 23, "place": [2, 0, 0], "ease": "hold"},
    {"frame": 24, "place": [9, 0, 0]}, {"frame": 40, "place": [9, 8, 0]}])";

TEST_F(CutPoses, BlendAcrossNoCut) {
  keys(kCut);
  EXPECT_TRUE(pose("it", {"place.z+=3"}, {24, 24}).empty()) << "at a cut nothing pops";
  for (const std::uint32_t frame : {20u, 23u}) {
    keys(kCut);
    blend(frame);
    expect_still_but({frame - 7, 23});
    EXPECT_NEAR(moved(frame), 3, 1e-9);
  }
  keys(kCut);
  blend(26);
  expect_still_but({24, 33});
  EXPECT_NEAR(moved(26), 3, 1e-9);
}

// As a camera that stands still is cut: its only key before the cut holds.
TEST_F(CutPoses, BlendNothingThatIsHeldToACut) {
  keys(R"([{"frame": 0, "place": [0, 0, 0], "ease": "hold"}, {"frame": 24, "place": [9, 0, 0]}])");
  blend(20);
  expect_still_but({20, 23});
  for (const std::uint32_t frame : {20u, 23u}) EXPECT_NEAR(moved(frame), 3, 1e-9);
}

TEST_F(CutPoses, BeginAShot) {
  keys(kCut);
  blend(24);
  expect_still_but({24, 39});
  EXPECT_NEAR(moved(24), 3, 1e-9);
  EXPECT_NEAR(moved(32), 1.5, 1e-9) << "on the way to the next key, not back where it was";
  keys(R"([{"frame": 23, "place": [2, 0, 0], "ease": "hold"}, {"frame": 24, "place": [9, 0, 0]},
      {"frame": 26, "place": [9, 1, 0]}, {"frame": 40, "place": [9, 8, 0]}])");
  blend(24);
  expect_still_but({24, 31});
  EXPECT_GT(moved(26), 2) << "keys near by change with it";
  keys(R"([{"frame": 0, "place": [9, 0, 0]}, {"frame": 40, "place": [9, 8, 0]}])");
  blend(0);
  expect_still_but({0, 39});
  EXPECT_NEAR(moved(20), 1.5, 1e-9) << "the film begins as a shot does";
}

TEST_F(Poses, OfLightsBehindTheEndAreFound) {
  pose("light/1", {"intensity=3"}, {60, 60});
  const Findings findings = check_film(film_);
  ASSERT_EQ(findings.lines.size(), 1u);
  EXPECT_NE(findings.lines[0].find("light/1: has keys up to frame 60"), std::string::npos);
}

}  // namespace
}  // namespace mars::animator
