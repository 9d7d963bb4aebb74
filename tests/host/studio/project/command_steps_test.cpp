// Steps of commands and scripts: what they write, show and say, and what is refused.
#include <chrono>

#include "host/content/animator/pose/actor_state.h"
#include "host/editing/edit_film.h"
#include "tests/host/studio/project/open_files.h"

namespace mars::studio {
namespace {

using editing::Command;

constexpr const char* kMoving = R"({
  "frames": 48,
  "camera": {"eye": [9, -9, 4], "at": [0, 0, 1]},
  "materials": {"skin": {"color": [1, 0, 0]}},
  "models": {"pip": "pip.json"},
  "actors": [{"name": "one", "model": "pip"},
             {"name": "two", "model": "pip", "place": [3, 0, 0], "pose": {"head": [0, 10, 0]},
              "keys": [{"frame": 0, "pose": {"left-leg": [0, 0, 0]}, "ease": "both"},
                       {"frame": 24, "pose": {"left-leg": [10, 20, 0]}}]}]
})";

class CommandSteps : public OpenFiles {
 protected:
  CommandSteps() { write("film.json", kMoving); }

  static Json step_of(const std::vector<Command>& commands) { return {{"commands", commands}}; }

  // As the commands change the file.
  std::string by_commands(const std::vector<Command>& commands) const {
    Json film = Json::parse(text("film.json"));
    editing::edit_film(film, path("film.json"), commands);
    return document::laid_out(film);
  }

  std::string state(const Project& project) const {
    std::string all;
    for (std::size_t actor = 0; actor < project.film().actors.size(); ++actor)
      for (const std::uint32_t frame : {0u, 7u, 24u, 40u})
        for (const modeler::Axes& axes : animator::state_at(project.film(), actor, frame).joints)
          for (int i = 0; i < 3; ++i)
            all += std::to_string(axes.place[i]) + " " + std::to_string(axes.turn[i][0]) + " ";
    return all;
  }
};

const std::vector<std::vector<Command>> kSteps = {
    {{"animate", "pose", "one", "head.y=20", "--frame", "12"}},
    {{"animate", "move", "two", "left-leg", "--frame", "24", "--to", "30"}},
    {{"animate", "key", "two", "--frame", "10", "--clamp"}, {"animate", "delete", "two", "head", "--frame", "10"}},
    {{"animate", "time", "two", "--frame", "0", "--anticipate", "15", "--overshoot", "10"}},
    {{"animate", "time", "--all", "--frame", "0-24", "--stretch", "2", "--lengthen"}},
    {{"animate", "bounce", "one", "--velocity", "1", "0", "3", "--lengthen"}},
    {{"animate", "pose", "camera", "fov=30", "--frame", "5", "--ease", "both"}},
};

TEST_F(CommandSteps, WriteWhatTheCommandsWriteAndShowItBefore) {
  const auto project = open("film.json");
  for (const auto& commands : kSteps) {
    const std::string what = Json(commands).dump(), before = text("film.json"), expected = by_commands(commands);
    const auto revision = project->revision(), shapes = project->shapes_revision();
    project->preview(step_of(commands));
    EXPECT_TRUE(project->in_gesture()) << what;
    EXPECT_GT(project->revision(), revision) << what;
    EXPECT_EQ(text("film.json"), before) << what;
    const std::string shown = state(*project);
    project->commit(step_of(commands));
    EXPECT_FALSE(project->in_gesture()) << what;
    EXPECT_EQ(text("film.json"), expected) << what;
    EXPECT_EQ(state(*project), shown) << what;
    EXPECT_EQ(project->shapes_revision(), shapes) << what;
    project->undo();
    EXPECT_EQ(text("film.json"), before) << what;
    project->redo();
    EXPECT_EQ(text("film.json"), expected) << what;
  }
}

TEST_F(CommandSteps, APreviewThatIsTakenBackLeavesNoTrace) {
  const auto project = open("film.json");
  const std::string before = state(*project);
  const Json described = project->describe();
  for (const auto& commands : kSteps) project->preview(step_of(commands));
  project->preview(pose("one", "place=1,2,3", project->frame()));
  project->preview(step_of(kSteps[0]));
  EXPECT_NE(state(*project), before);
  refusal([&] { project->preview(step_of({{"animate", "walk", "one", "--frame", "999"}})); });
  EXPECT_EQ(state(*project), before);
  project->preview(step_of(kSteps[1]));
  project->cancel();
  EXPECT_EQ(state(*project), before);
  EXPECT_EQ(project->describe(), described);
  EXPECT_EQ(text("film.json"), kMoving);
}

TEST_F(CommandSteps, TellOnlyTheActorsThatMove) {
  const auto project = open("film.json");
  project->preview(step_of(kSteps[0]));
  const Json poses = project->describe_poses();
  ASSERT_EQ(poses["actors"].size(), 1u);
  EXPECT_EQ(poses["actors"][0]["name"], "one");
}

TEST_F(CommandSteps, HaveNamesInTheHistory) {
  const auto project = open("film.json");
  const auto name_after = [&](const std::vector<Command>& commands) {
    project->commit(step_of(commands));
    return project->describe()["undo"].get<std::string>();
  };
  EXPECT_EQ(name_after(kSteps[0]), "turn head of one");
  EXPECT_EQ(name_after(kSteps[1]), "move keys of two");
  EXPECT_EQ(name_after({kSteps[2][0], kSteps[5][0]}), "key two and 1 more");
}

TEST_F(CommandSteps, SayWhatCommandsSay) {
  const auto project = open("film.json");
  project->commit(step_of({{"animate", "bounce", "one", "--velocity", "1", "0", "3"}}));
  const auto said = project->take_remarks();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(holds(said[0], "the film shows only its 48 frames")) << said[0];
  EXPECT_TRUE(project->take_remarks().empty());
}

TEST_F(CommandSteps, AreHandedOverOnceTheyAreInTheFile) {
  const auto project = open("film.json");
  project->preview(step_of(kSteps[0]));
  EXPECT_TRUE(project->take_commands().empty());
  project->commit(step_of(kSteps[0]));
  EXPECT_EQ(project->take_commands(), kSteps[0]);
  EXPECT_TRUE(project->take_commands().empty());
  refusal([&] { project->commit(step_of({{"film", "add", "nobody", "--model", "mann"}})); });
  EXPECT_TRUE(project->take_commands().empty());
  project->commit(Json{{"script", {{"name", "a.script"}, {"text", "at 0 one spin degrees 90 until 5\n"}}}});
  EXPECT_EQ(project->take_commands(), (std::vector<Command>{{"animate", "script", "a.script", "--lengthen"}}));
}

TEST_F(CommandSteps, AreRefusedWholeWhereOneIsWrong) {
  const auto project = open("film.json");
  const auto refused = [&](const Json& commands) {
    const Json step{{"commands", commands}};
    refusal([&] { project->preview(step); });
    return refusal([&] { project->commit(step); });
  };
  EXPECT_TRUE(holds(refused(Json{kSteps[0][0], {"animate", "wlak", "one"}}), "did you mean"));
  for (const char* commands :
       {"[]", "[[]]", "[3]", "[[3]]", R"(["animate"])", R"([["render", "film.json"]])", R"([["animate"]])",
        R"([["animate", "--help"]])", R"([["animate", "pose", "one", "head.y=900", "--frame", "0"]])"})
    refused(Json::parse(commands));
  refused(Json(201, kSteps[0][0]));
  EXPECT_EQ(text("film.json"), kMoving);
  EXPECT_EQ(project->describe()["undo"], Json());
}

TEST_F(CommandSteps, ReadNoFilesElsewhere) {
  std::filesystem::create_directory(path("below"));
  for (const char* name : {"film.json", "pip.json"}) std::filesystem::copy(path(name), path("below") / name);
  write("secret.script", "at 0 one spin");
  const auto project = open("below/film.json");
  EXPECT_TRUE(holds(refusal([&] {
                      project->commit(step_of({{"animate", "script", path("secret.script").string()}}));
                    }),
                    "not below"));
  std::filesystem::create_symlink(path("secret.script"), path("below") / "link.script");
  refusal([&] { project->commit(step_of({{"animate", "script", (path("below") / "link.script").string()}})); });
  refusal([&] { project->commit({{"script", {{"name", "link.script"}, {"text", "at 0 one spin seconds 1"}}}}); });
  EXPECT_EQ(text("secret.script"), "at 0 one spin");
  EXPECT_EQ(project->scripts()["scripts"], Json::array());
}

TEST_F(CommandSteps, ScriptsAreWrittenThenAppliedAndStay) {
  const auto project = open("film.json");
  const Json script{{"script", {{"name", "play.script"}, {"text", "at 0 one spin degrees 90 until 60\n"}}}};
  write("same.script", "at 0 one spin degrees 90 until 60\n");
  Json film = Json::parse(kMoving);
  const Command command{"animate", "script", path("same.script").string(), "--lengthen"};
  editing::edit_film(film, path("film.json"), std::span(&command, 1));
  project->commit(script);
  EXPECT_EQ(text("film.json"), document::laid_out(film));
  EXPECT_EQ(project->film().frames, 61u);
  EXPECT_EQ(text("play.script"), "at 0 one spin degrees 90 until 60\n");
  EXPECT_EQ(project->describe()["undo"], "apply play.script");
  EXPECT_TRUE(holds(project->take_remarks().at(0), "one spin, frames 0 to 60"));
  project->undo();
  EXPECT_EQ(text("film.json"), kMoving);
  EXPECT_TRUE(std::filesystem::exists(path("play.script")));
  EXPECT_EQ(project->scripts()["scripts"].size(), 2u);
}

TEST_F(CommandSteps, ScriptsAreRefusedWithTheirLine) {
  const auto project = open("film.json");
  const char* const wrong = "at 0 one spin degrees 90\nthen one wlak\n";
  const Json checked = project->check_script("play.script", wrong);
  EXPECT_EQ(checked["problem"]["line"], 2);
  EXPECT_TRUE(checked["problem"]["text"].get<std::string>().starts_with("this line has 'wlak'")) << checked;
  EXPECT_TRUE(project->check_script("play.script", "at 0 one spin")["problem"].is_null());
  EXPECT_FALSE(project->check_script("play.script", "at 0 one spin")["report"].empty());
  refusal([&] { project->commit({{"script", {{"name", "play.script"}, {"text", wrong}}}}); });
  for (const char* name : {"", "play", ".script", "../play.script", "sub/play.script", ".play.script", "a\nb.script"})
    refusal([&] { project->commit({{"script", {{"name", name}, {"text", "at 0 one spin"}}}}); });
  refusal([&] { project->commit({{"script", 3}}); });
  refusal([&] { project->commit({{"script", {{"name", 3}, {"text", ""}}}}); });
  EXPECT_EQ(text("film.json"), kMoving);
  EXPECT_FALSE(std::filesystem::exists(path("play.script")));
}

TEST_F(CommandSteps, ActorsAndLightsComeAndGo) {
  const auto project = open("film.json");
  const std::vector<Command> commands{{"film", "add", "ball", "--model", "ball", "--place", "0", "1", "2"},
                                      {"film", "light", "rig"}};
  const std::string expected = by_commands(commands);
  const auto shapes = project->shapes_revision();
  project->preview(step_of(commands));
  EXPECT_EQ(project->film().actors.size(), 3u);
  EXPECT_EQ(project->describe_poses()["actors"].size(), 3u);
  EXPECT_GT(project->shapes_revision(), shapes);
  project->cancel();
  EXPECT_EQ(project->film().actors.size(), 2u);
  EXPECT_EQ(project->film().models.size(), 1u);
  project->commit(step_of(commands));
  EXPECT_EQ(text("film.json"), expected);
  EXPECT_EQ(project->describe()["lights"].size(), 3u);
  project->commit(step_of(
      {{"animate", "attach", "ball", "--to", "two/head", "--frame", "4"}, {"animate", "look", "two", "--frame", "0"}}));
  project->set_frame(5);
  EXPECT_EQ(project->describe()["actors"][2]["attach"], Json::parse(R"({"actor": "two", "joint": "head"})"));
  EXPECT_EQ(project->describe()["camera"]["look"], Json::parse(R"({"actor": "two"})"));
  EXPECT_EQ(project->describe()["camera"]["follow"], Json());
}

TEST_F(CommandSteps, ModelsElsewhereAreRefused) {
  std::filesystem::create_directory(path("below"));
  for (const char* name : {"film.json", "pip.json"}) std::filesystem::copy(path(name), path("below") / name);
  const auto project = open("below/film.json");
  const Json add = step_of({{"film", "add", "other", "--model", "../pip.json"}});
  EXPECT_TRUE(holds(refusal([&] { project->preview(add); }), "not below"));
  EXPECT_TRUE(holds(refusal([&] { project->commit(add); }), "not below"));
  project->commit(step_of({{"film", "add", "other", "--model", "pip.json"}}));
}

TEST_F(CommandSteps, ANewFilmHasAFloorACameraAndLights) {
  const auto project = open_project(path("new.json"), {}, NewFile::film);
  EXPECT_FALSE(std::filesystem::exists(path("new.json")));
  const Json described = project->describe();
  EXPECT_EQ(described["kind"], "film");
  EXPECT_EQ(described["actors"][0]["name"], "floor");
  EXPECT_EQ(described["lights"].size(), 3u);
  project->commit(step_of({{"film", "add", "tom", "--model", "man"}}));
  EXPECT_EQ(open("new.json")->film().actors.size(), 2u);
}

TEST_F(CommandSteps, ChangeNoModel) {
  const auto project = open("pip.json");
  refusal([&] { project->preview(step_of(kSteps[0])); });
  refusal([&] { project->commit(step_of(kSteps[0])); });
  EXPECT_EQ(text("pip.json"), kPip);
}

}  // namespace
}  // namespace mars::studio
