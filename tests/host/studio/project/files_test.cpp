// What others do to the files that are open: it shows, is an entry of the history, or a problem with its line.
#include "host/content/animator/keys/pose.h"
#include "host/content/film/film_json.h"
#include "tests/host/studio/project/open_files.h"

namespace mars::studio {
namespace {

class Files : public OpenFiles {
 protected:
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  }
};

TEST_F(Files, AnOutsideChangeShowsAndCanBeUndone) {
  const auto project = open("pip.json");
  EXPECT_FALSE(look(*project));
  const std::string changed = replaced(kPip, "[0, 0, 1], \"segment\"", "[0, 0, 2], \"segment\"");
  write("pip.json", changed);
  EXPECT_TRUE(look(*project));
  EXPECT_FALSE(look(*project));
  EXPECT_EQ(project->film().models[0].joints[0].place.z, 2);
  EXPECT_EQ(project->describe()["undo"], "changed outside");
  project->undo();
  EXPECT_EQ(text("pip.json"), kPip);
  EXPECT_EQ(project->film().models[0].joints[0].place.z, 1);
  project->redo();
  EXPECT_EQ(text("pip.json"), changed);
}

TEST_F(Files, AChangeWhileNothingIsOpenIsAnEntryToo) {
  open("pip.json")->commit(step("model remove head"));
  const std::string before = text("pip.json");
  write("pip.json", replaced(kPip, "40", "45"));
  const auto project = open("pip.json");
  EXPECT_EQ(project->describe()["undo"], "changed outside");
  project->undo();
  EXPECT_EQ(text("pip.json"), before);
  project->undo();
  EXPECT_EQ(text("pip.json"), kPip);
}

TEST_F(Files, ACommandsChangeIsNotLostByAStep) {
  const auto project = open("film.json");
  film::change_film(path("film.json"), [&](Json& json, const animator::Film& film) {
    const std::vector<std::string> settings{"head.y=5"};
    animator::pose(json, film, "one", settings, {0, 0}, {});
  });
  project->commit(pose("one", "place=7,7,7", project->frame()));
  EXPECT_TRUE(holds(text("film.json"), R"("head": [0, 5, 0])"));
  EXPECT_TRUE(holds(text("film.json"), "[7, 7, 7]"));
  project->undo();
  project->undo();
  EXPECT_EQ(text("film.json"), kFilm);
}

TEST_F(Files, ABrokenFileIsAProblemWithItsLineAndTheLastGoodStateStays) {
  const auto project = open("pip.json");
  write("pip.json",
        replaced(kPip, "\"parent\": \"hip\", \"place\": [0, 0, 1]", "\"parent\": \"hop\", \"place\": [0, 0, 1]"));
  EXPECT_TRUE(look(*project));
  ASSERT_TRUE(project->problem());
  EXPECT_EQ(project->problem()->line, 5u) << project->problem()->text;
  EXPECT_EQ(project->describe()["problem"]["line"], 5);
  EXPECT_EQ(project->film().models[0].joints.size(), 4u);
  EXPECT_TRUE(holds(refusal([&] { project->commit(step("model remove head")); }), "hop"));
  project->preview(Json{{"pose", {{"head", {0, 5, 0}}}}});
  project->cancel();
  write("pip.json", "{");
  EXPECT_TRUE(look(*project));
  write("pip.json", kPip);
  EXPECT_TRUE(look(*project));
  EXPECT_FALSE(project->problem());
  EXPECT_EQ(project->describe()["undo"], Json());
}

TEST_F(Files, UndoPutsTheLastGoodStateBack) {
  const auto project = open("pip.json");
  project->commit(step("model remove head"));
  const std::string good = text("pip.json");
  write("pip.json", "{\"joints\": [}");
  look(*project);
  ASSERT_TRUE(project->problem());
  project->undo();
  EXPECT_EQ(text("pip.json"), good);
  EXPECT_FALSE(project->problem());
  EXPECT_EQ(project->describe()["undo"], "remove head");
  std::filesystem::remove(path("pip.json"));
  EXPECT_TRUE(look(*project));
  ASSERT_TRUE(project->problem());
  project->undo();
  EXPECT_EQ(text("pip.json"), good);
}

TEST_F(Files, TheModelsOfAFilmAreWatched) {
  const auto project = open("film.json");
  const auto shapes = project->shapes_revision();
  write("pip.json", replaced(kPip, "\"shape\": \"sphere\"", "\"shape\": \"box\""));
  EXPECT_TRUE(look(*project));
  EXPECT_GT(project->shapes_revision(), shapes);
  EXPECT_EQ(project->describe()["undo"], Json());
  write("pip.json", "{\"joints\": [");
  EXPECT_TRUE(look(*project));
  ASSERT_TRUE(project->problem());
  EXPECT_TRUE(holds(project->problem()->text, "pip.json"));
  EXPECT_FALSE(look(*project));
  refusal([&] { project->commit(pose("one", "place=7,7,7", project->frame())); });
  write("pip.json", kPip);
  EXPECT_TRUE(look(*project));
  EXPECT_FALSE(project->problem());
  project->commit(pose("one", "place=7,7,7", project->frame()));
}

TEST_F(Files, AnOutsideChangeEndsAGesture) {
  const auto project = open("film.json");
  project->preview(pose("one", "place=7,7,7", project->frame()));
  write("film.json", replaced(kFilm, "\"frames\": 48", "\"frames\": 24"));
  EXPECT_TRUE(look(*project));
  EXPECT_FALSE(project->in_gesture());
  EXPECT_EQ(project->film().frames, 24u);
  EXPECT_EQ(project->film().actors[0].motion.place.size(), 1u);
}

TEST_F(Files, WhatIsNoFilmOrModelIsNotOpened) {
  write("broken.json", "{\"models\": {},\n \"frames\": 0}");
  EXPECT_TRUE(holds(refusal([&] { open("broken.json"); }), "broken.json:2"));
  write("list.json", "[1, 2]");
  refusal([&] { open("list.json"); });
  refusal([&] { open(""); });
}

}  // namespace
}  // namespace mars::studio
