// Steps of films: what a gesture shows, what is written, and that commands write the same.
#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/camera_points.h"
#include "host/content/animator/keys/pose.h"
#include "host/content/film/film_json.h"
#include "tests/host/studio/project/open_files.h"

namespace mars::studio {
namespace {

class FilmSteps : public OpenFiles {
 protected:
  // As `mars animate copy.json pose THING SETTINGS --frame FRAME --clamp`.
  std::string by_command(const std::string& thing, const std::vector<std::string>& settings,
                         std::uint32_t frame) const {
    write("copy.json", text("film.json"));
    film::change_film(path("copy.json"), [&](Json& json, const animator::Film& film) {
      animator::pose(json, film, thing, settings, {frame, frame}, {.beyond = animator::Beyond::clamped});
    });
    return text("copy.json");
  }
};

bool same(const animator::ActorState& one, const animator::ActorState& two) {
  for (std::size_t i = 0; i < one.segments.size(); ++i)
    if (one.segments[i].has_value() != two.segments[i].has_value() ||
        (one.segments[i] && one.segments[i]->m != two.segments[i]->m))
      return false;
  return one.pose == two.pose && one.place == two.place && one.turn == two.turn;
}

struct Case {
  std::string thing;
  std::vector<std::string> settings;
  std::uint32_t frame;

  Json step() const { return pose(thing, document::joined(settings, " "), frame); }
};

TEST_F(FilmSteps, AStepWritesWhatTheCommandWritesAndShowsItBefore) {
  const Case cases[] = {{"one", {"head=0,20,0"}, 12},
                        {"two", {"left-leg=10.5,90,0"}, 12},
                        {"two", {"left-leg=1,2,0"}, 24},
                        {"two", {"head=5,99,5"}, 0},
                        {"two", {"head=0,30,0"}, 36},
                        {"two", {"head=0,1,0", "hip=1,2,3"}, 47},
                        {"two", {"place=1,2.25,3"}, 10},
                        {"one", {"turn=0,0,270"}, 30},
                        {"two", {"place=2,1,0", "turn=0,0,9", "head=0,99,0"}, 14},
                        {"camera", {"eye=5,-5,3", "at=0,1,1", "fov=30"}, 20},
                        {"camera", {"fov=60"}, 0}};
  const auto project = open("film.json");
  for (const Case& each : cases) {
    project->set_frame(each.frame);
    const std::string expected = by_command(each.thing, each.settings, each.frame), before = text("film.json");
    const auto revision = project->revision();
    project->preview(each.step());
    EXPECT_TRUE(project->in_gesture());
    EXPECT_GT(project->revision(), revision);
    EXPECT_EQ(text("film.json"), before) << each.step();
    const animator::Film shown = project->film();
    project->commit(each.step());
    EXPECT_FALSE(project->in_gesture());
    EXPECT_EQ(text("film.json"), expected) << each.step();
    for (std::size_t actor = 0; actor < 2; ++actor)
      EXPECT_TRUE(
          same(animator::state_at(shown, actor, each.frame), animator::state_at(project->film(), actor, each.frame)))
          << each.step();
    EXPECT_EQ(animator::eye_at(shown, each.frame), animator::eye_at(project->film(), each.frame));
    EXPECT_EQ(animator::value_at(shown.camera.fov, each.frame),
              animator::value_at(project->film().camera.fov, each.frame));
    ASSERT_EQ(shown.lights.size(), project->film().lights.size());
    for (std::size_t i = 0; i < shown.lights.size(); ++i)
      EXPECT_EQ(shown.lights[i].vector[0].value, project->film().lights[i].vector[0].value) << each.step();
  }
  EXPECT_EQ(project->shapes_revision(), open("film.json")->shapes_revision());
}

TEST_F(FilmSteps, LightsAreSetAsTheCommandSetsThem) {
  Json film = Json::parse(kFilm);
  film["lights"] = Json::parse(R"([{"direction": [0, 0, 1]}, {"place": [-2, 0, 3], "reach": 1.5},
    {"place": [4, 0, 4], "at": [4, 0, 1], "cone": [20, 40], "keys": [{"frame": 8, "intensity": 2}]}])");
  write("film.json", document::laid_out(film));
  const Case cases[] = {{"light/1", {"direction=1,0,1"}, 12},
                        {"light/2", {"place=1,2,3", "reach=2"}, 0},
                        {"light/3", {"at=1,2,0", "cone=10,30"}, 20},
                        {"light/3", {"color=1,0.5,0", "intensity=3"}, 8}};
  const auto project = open("film.json");
  for (const Case& each : cases) {
    project->set_frame(each.frame);
    const std::string expected = by_command(each.thing, each.settings, each.frame);
    project->preview(each.step());
    const Json shown = project->describe_poses()["lights"];
    project->commit(each.step());
    EXPECT_EQ(text("film.json"), expected) << each.step();
    const Json lights = project->describe()["lights"];
    ASSERT_EQ(lights.size(), 3u);
    for (std::size_t light = 0; light < 3; ++light)
      for (const auto& part : lights[light].items())
        EXPECT_TRUE(part.key() == "keyed" || part.key() == "animated" || part.value() == shown[light][part.key()])
            << each.step() << part.key();
  }
  const Json spot = project->describe()["lights"][2];
  EXPECT_EQ(spot["thing"], "light/3");
  EXPECT_EQ(spot["kind"], "spot");
  EXPECT_EQ(spot["color"], Json::parse("[1, 0.5, 0]"));
  EXPECT_EQ(spot["keyed"], Json::parse(R"(["color", "intensity"])"));
  for (const auto& [light, setting] : {std::pair{"light/4", "place=1,2,3"},
                                       {"light/0", "place=1,2,3"},
                                       {"light/1", "place=1,2,3"},
                                       {"light/2", "cone=10,30"},
                                       {"light/1", "direction=0,0,0"}}) {
    const Json wrong = pose(light, setting, 8);
    refusal([&] { project->preview(wrong); });
    refusal([&] { project->commit(wrong); });
    EXPECT_FALSE(project->in_gesture());
  }
}

TEST_F(FilmSteps, CameraLightsAndSettingsHaveTheKeysOfTheTable) {
  Json film = Json::parse(kFilm);
  film["lights"] = Json::parse(R"([{"place": [4, 0, 4], "at": [4, 0, 1]}])");
  film["samples"] = 8;
  film["camera"]["near"] = 0.25;
  write("film.json", document::laid_out(film));
  const auto project = open("film.json");
  const auto names = [](const Json& described) {
    std::vector<std::string> names;
    for (const auto& item : described.items()) names.push_back(item.key());
    return names;
  };
  using Names = std::vector<std::string>;
  const Json light = project->describe()["lights"][0];
  EXPECT_EQ(names(light), (Names{"thing", "kind", "place", "at", "cone", "color", "intensity", "shadow", "size",
                                 "keyed", "animated"}));
  EXPECT_EQ(light["cone"], Json::parse("[32, 40]"));
  const Json camera = project->describe()["camera"];
  for (const char* name : {"eye", "at", "up", "projection", "fov", "height", "shift", "exposure", "near", "far"})
    EXPECT_TRUE(camera.contains(name)) << name;
  EXPECT_EQ(camera["near"], 0.25);
  EXPECT_EQ(camera["far"], 10000);
  const Json settings = project->describe()["settings"];
  EXPECT_EQ(names(settings), (Names{"frames", "rate", "audio_delay", "size", "pixel_aspect", "samples", "color",
                                    "curve", "background", "intervals", "dice"}));
  EXPECT_EQ(settings["samples"], 8);
  EXPECT_EQ(settings["dice"], "adaptive");
  project->commit(pose("light/1", "reach=5", 8));
  EXPECT_EQ(project->describe()["lights"][0]["reach"], 5);
  project->commit(Json::parse(R"({"commands": [["film", "set", "color=coded"]]})"));
  EXPECT_FALSE(project->describe()["camera"].contains("exposure"));
  EXPECT_FALSE(project->describe()["settings"].contains("curve"));
}

TEST_F(FilmSteps, RigLightsAreNoThings) {
  const auto project = open("film.json");
  EXPECT_TRUE(project->rig_lights());
  EXPECT_TRUE(project->describe()["lights"].empty());
  refusal([&] { project->preview(pose("light/1", "intensity=2", 0)); });
  refusal([&] { project->commit(pose("light/1", "intensity=2", 0)); });
  EXPECT_EQ(text("film.json"), kFilm);
}

TEST_F(FilmSteps, ACancelledGestureLeavesNothing) {
  const auto project = open("film.json");
  project->set_frame(12);
  const animator::Film before = project->film();
  for (const auto& [thing, settings] : {std::pair{"one", "head=0,20,0"},
                                        {"two", "head=0,20,0 hip=1,1,1"},
                                        {"two", "place=9,9,9"},
                                        {"two", "place=9,9,9 head=0,9,0"},
                                        {"camera", "eye=1,2,3 fov=12"}})
    project->preview(pose(thing, settings, 12));
  project->cancel();
  EXPECT_FALSE(project->in_gesture());
  for (std::size_t actor = 0; actor < 2; ++actor)
    for (const std::uint32_t frame : {0u, 12u, 20u})
      EXPECT_TRUE(same(animator::state_at(before, actor, frame), animator::state_at(project->film(), actor, frame)));
  EXPECT_EQ(before.actors[0].motion.pose[1].size(), project->film().actors[0].motion.pose[1].size());
  EXPECT_EQ(before.camera.eye.size(), project->film().camera.eye.size());
  EXPECT_EQ(text("film.json"), kFilm);
  EXPECT_EQ(project->describe()["undo"], Json());
}

TEST_F(FilmSteps, PosesStopAtLimits) {
  const auto project = open("film.json");
  project->preview(pose("one", "head=50,500,50", 0));
  EXPECT_EQ(project->describe_poses()["actors"], Json::parse(R"([{"name": "one", "place": [0, 0, 0], "turn": [0, 0, 0],
                             "joints": [[0, 0, 0], [0, 40, 0], [0, 0, 0], [0, 0, 0]]}])"));
  project->commit(pose("one", "head=50,500,50", 0));
  EXPECT_TRUE(holds(text("film.json"), R"("head": [0, 40, 0])"));
  EXPECT_FALSE(project->take_remarks().empty());
}

TEST_F(FilmSteps, WhatMakesNoSenseIsRefusedAndLeavesAllAsItWas) {
  const auto project = open("film.json");
  const auto refused = [&](const Json& wrong) { return refusal([&] { project->commit(wrong); }); };
  EXPECT_TRUE(holds(refused(pose("on", "head=0,0,0", 0)), "one"));
  refused(pose("", "head=0,0,0", 0));
  EXPECT_TRUE(holds(refused(pose("one", "heat=0,0,0", 0)), "head"));
  refused(pose("one", "head=0,0", 0));
  refused(pose("one", "head=0,1e99,0", 0));
  refused(pose("camera", "eye=0,0,1", 0));
  refused(pose("camera", "fov=500", 0));
  EXPECT_TRUE(holds(refused(step("model set head --place 1 2 3")), "mars studio MODEL"));
  EXPECT_TRUE(holds(refused(step("model new --figure man")), "mars studio MODEL"));
  refused(step("model mirror up"));
  refused(Json::array());
  refused(3);
  refused({{"is", "set"}});
  refused({{"commands", Json::array()}});
  refused({{"commands", {3}}});
  refused({{"commands", {{"animate", 3}}}});
  refused({{"commands", {{"render", "film.json"}}}});
  refused({{"pose", {{"head", {0, 1, 0}}}}});
  refusal([&] { project->preview(pose("camera", "eye=0,0,1", 0)); });
  EXPECT_EQ(project->film().camera.eye.size(), 1u);
  EXPECT_EQ(text("film.json"), kFilm);
  EXPECT_EQ(project->describe()["undo"], Json());
}

TEST_F(FilmSteps, ThePageSeesActorsAndJoints) {
  const auto project = open("film.json");
  project->set_frame(24);
  const Json json = project->describe();
  EXPECT_EQ(json["kind"], "film");
  EXPECT_EQ(json["frames"], 48);
  EXPECT_EQ(json["frame"], 24);
  const Json& two = json["actors"][1];
  EXPECT_EQ(two["model"], "pip");
  EXPECT_EQ(two["place"], Json::parse("[3, 0, 0]"));
  EXPECT_EQ(two["joints"][2], Json::parse(R"({"name": "left-leg", "parent": "hip",
      "limits": [[-10, 30], [0, 90], [0, 0]], "free": ["x", "y"], "pose": [10, 20, 0], "keyed": true,
      "limb": "left.knee"})"));
}

TEST_F(FilmSteps, WhoMovesACarriedActorIsTold) {
  Json json = Json::parse(text("film.json"));
  for (Json& actor : json["actors"])
    if (actor["name"] == "one") actor["attach"] = {{"actor", "two"}};
  write("film.json", json.dump());
  const auto project = open("film.json");
  project->commit(pose("one", "place=1,2,3", 0));
  EXPECT_TRUE(holds(document::joined(project->take_remarks()), "'two' carries it at frame 0"));
}

}  // namespace
}  // namespace mars::studio
