// What pages receive of keys, curves and actions.
#include "host/studio/project/animation.h"

#include "host/content/animator/motion/script/action.h"
#include "tests/host/studio/project/open_files.h"

namespace mars::studio {
namespace {

class AnimationForPages : public OpenFiles {
 protected:
  Json thing_in(const Json& channels, const std::string& thing) const {
    for (const Json& each : channels["things"])
      if (each["thing"] == thing) return each;
    return nullptr;
  }
};

TEST_F(AnimationForPages, ChannelsHaveTheKeysAsTheFilmHasThem) {
  const auto project = open("film.json");
  EXPECT_EQ(project->channels({"*"}), Json::parse(R"({"is": "channels", "things": [
    {"thing": "two", "kind": "actor", "parts": [{"name": "left-leg", "axes": ["x", "y"], "keys": [
      {"frame": 0, "value": [0, 0, 0], "ease": "both"}, {"frame": 24, "value": [10, 20, 0], "ease": "linear"}]}]}]})"));
  EXPECT_EQ(project->channels({"one", "camera", "nobody"})["things"].size(), 2u);
  project->commit(pose("camera", "fov=30", project->frame()));
  const Json camera = thing_in(project->channels({"*"}), "camera");
  EXPECT_EQ(camera["parts"], Json::parse(R"([{"name": "fov", "axes": ["value"],
                                              "keys": [{"frame": 0, "value": 30, "ease": "linear"}]}])"));
}

TEST_F(AnimationForPages, CurvesHaveAValueForEachFrame) {
  const auto project = open("film.json");
  const CurvesWanted wanted{"two", {"left-leg", "place", "nothing"}, 20, 30};
  const Json curves = project->curves(wanted);
  EXPECT_EQ(curves["first"], 20);
  ASSERT_EQ(curves["parts"].size(), 2u);
  EXPECT_EQ(curves["parts"][0]["name"], "place");
  EXPECT_EQ(curves["parts"][0]["limits"], Json());
  EXPECT_EQ(curves["parts"][0]["values"][0], Json(11, 3));
  const Json& leg = curves["parts"][1];
  EXPECT_EQ(leg["axes"], Json::parse(R"(["x", "y"])"));
  EXPECT_EQ(leg["limits"], Json::parse("[[-10, 30], [0, 90]]"));
  EXPECT_EQ(leg["values"][1].size(), 11u);
  EXPECT_EQ(leg["values"][1][4], 20);
  EXPECT_EQ(leg["values"][1][10], 20);
  EXPECT_LT(leg["values"][1][0].get<double>(), 20);
}

TEST_F(AnimationForPages, CurvesGoAlongWithGesturesAndChannelsDoNot) {
  const auto project = open("film.json");
  const Json channels = project->channels({"*"});
  const auto at_12 = [&] {
    return project->curves({"two", {"left-leg"}, 12, 12})["parts"][0]["values"][1][0].get<double>();
  };
  const double before = at_12();
  project->preview(
      Json::parse(R"({"commands": [["animate", "pose", "two", "left-leg.y=80", "--frame", "12", "--clamp"]]})"));
  EXPECT_EQ(at_12(), 80);
  EXPECT_EQ(project->channels({"*"}), channels);
  project->cancel();
  EXPECT_EQ(at_12(), before);
  project->set_frame(12);
  project->preview(pose("two", "left-leg=0,70,0", project->frame()));
  EXPECT_EQ(at_12(), 70);
}

TEST_F(AnimationForPages, ModelsHaveNone) {
  const auto project = open("pip.json");
  EXPECT_EQ(project->channels({"*"})["things"], Json::array());
  EXPECT_EQ(project->curves({"model", {"head"}, 0, 3})["parts"], Json::array());
}

TEST_F(AnimationForPages, AllActionsWithTheirParameters) {
  const Json sent = actions();
  EXPECT_GE(sent["actions"].size(), motion::actions().size());
  const Json& walk = sent["actions"][0];
  EXPECT_EQ(walk["name"], "walk");
  EXPECT_EQ(walk["parameters"][2]["name"], "to");
  EXPECT_EQ(walk["parameters"][2]["count"], 2);
}

}  // namespace
}  // namespace mars::studio
