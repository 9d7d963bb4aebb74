// Keys select joints, turn them within their limits, and make what is seen keys of the film file.
#include "host/preview/pose_keys.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>
#include <string_view>

#include "host/content/animator/keys/pose.h"
#include "host/content/animator/pose/axis_turn.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/film_file.h"
#include "host/content/film/film_json.h"
#include "host/preview/film_drawing.h"
#include "tests/temporary_folder.h"

namespace mars::preview {
namespace {

// A tree of which the file lists a leaf last; scenery, which stands before who moves.
constexpr const char* kFilm = R"({"frames": 24, "size": [96, 54], "camera": {"eye": [3, -7, 3], "at": [0, 0, 1]},
 "models": {"lamp": {"joints": [
  {"name": "foot", "limits": {}, "segment": {"shape": "box"}},
  {"name": "stem", "parent": "foot", "place": [0, 0, 1], "limits": {"x": [-40, 40], "y": [-60, 60]},
   "segment": {"shape": "box"}},
  {"name": "tail", "parent": "foot", "limits": {"z": [-9, 9]}},
  {"name": "arm", "parent": "stem", "place": [0, 0, 1], "limits": {"y": [0, 150]}, "segment": {"shape": "box"}}]}},
 "actors": [{"name": "still", "model": "lamp", "place": [2, 0, 0]},
  {"name": "lamp", "model": "lamp", "keys": [{"frame": 0, "pose": {"arm": [0, 10, 0]}},
                                             {"frame": 20, "pose": {"arm": [0, 90, 0]}, "ease": "both"}]}]})";

constexpr KeyPress kBackTab{0, Special::back_tab}, kLeave{0, Special::escape};

class Posing : public testing::Test {
 protected:
  Posing() { document::write_whole_file(path_, kFilm); }

  // What is said at last.
  static std::string press(PoseKeys& keys, std::string_view characters, std::uint32_t frame = 10) {
    for (const char character : characters)
      EXPECT_TRUE(keys.handle_key({character, Special::none}, frame)) << character;
    return keys.note(frame);
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "film.json", other_ = folder_ / "other.json";
};

TEST_F(Posing, StepsThroughTheTreesOfJointsThatMoveFirst) {
  Previewed film = load_previewed(path_);
  PoseKeys keys(film, path_);
  EXPECT_EQ(keys.note(10), "");
  EXPECT_EQ(press(keys, "\t"), "lamp stem  x 0 (-40..40)  y 0 (-60..60)");
  EXPECT_EQ(press(keys, "\t"), "lamp arm  y 50 (0..150)");
  EXPECT_EQ(press(keys, "\t"), "lamp tail  z 0 (-9..9)");
  EXPECT_EQ(press(keys, "\t"), "still stem  x 0 (-40..40)  y 0 (-60..60)");
  EXPECT_TRUE(keys.handle_key(kBackTab, 10));
  EXPECT_EQ(keys.note(10), "lamp tail  z 0 (-9..9)");
  EXPECT_EQ(press(keys, "\t\t\t\t"), "lamp stem  x 0 (-40..40)  y 0 (-60..60)");
  EXPECT_EQ(press(keys, "i"), "lamp arm  y 50 (0..150)");
  EXPECT_EQ(press(keys, "i"), "lamp arm  y 50 (0..150)");
  EXPECT_EQ(press(keys, "o"), "lamp stem  x 0 (-40..40)  y 0 (-60..60)");
  EXPECT_EQ(press(keys, "o"), "lamp stem  x 0 (-40..40)  y 0 (-60..60)");
  EXPECT_FALSE(keys.under_way());
  EXPECT_TRUE(keys.handle_key(kLeave, 10));
  EXPECT_EQ(keys.note(10), "");
  EXPECT_EQ(press(keys, "x"), "Tab selects a joint");
  EXPECT_FALSE(keys.handle_key({'f', Special::none}, 10));
  EXPECT_EQ(keys.note(10), "");
}

TEST_F(Posing, TurnsWithinLimits) {
  Previewed film = load_previewed(path_);
  PoseKeys keys(film, path_);
  const std::string hint = "  Enter set key  Esc give up";
  EXPECT_EQ(press(keys, "\txxYd"), "lamp stem  x 10 (-40..40)  y -5 (-60..60)  steps of 1 degree");
  EXPECT_EQ(press(keys, "xX"), "lamp stem  x 10 (-40..40)  y -5 (-60..60)" + hint);
  EXPECT_EQ(press(keys, "Xd"), "lamp stem  x 9 (-40..40)  y -5 (-60..60)  steps of 5 degrees");
  EXPECT_EQ(press(keys, "xxxxxxx"), "lamp stem  x 40 (-40..40)  y -5 (-60..60)  x stops at its limit");
  EXPECT_EQ(press(keys, "z"), "lamp stem  x 40 (-40..40)  y -5 (-60..60)  does not turn about z");
  EXPECT_EQ(press(keys, "0"), "lamp stem  x 0 (-40..40)  y 0 (-60..60)" + hint);
  EXPECT_TRUE(keys.under_way());
  EXPECT_TRUE(keys.handle_key(kLeave, 10));
  EXPECT_FALSE(keys.under_way());
  EXPECT_EQ(document::read_file(path_), kFilm);
}

TEST_F(Posing, TurnsNoHingeAboutAnAxisThatALockedOneHasTurnedAway) {
  std::string text(kFilm);
  text.replace(text.find(R"("y": [-60, 60])"), 14, R"("z": [30, 30])");
  document::write_whole_file(path_, text);
  Previewed film = load_previewed(path_);
  PoseKeys keys(film, path_);
  EXPECT_TRUE(press(keys, "\tax").ends_with("y is locked")) << keys.note(10);
  EXPECT_FALSE(keys.under_way());
}

// y as x has left it, and x as y then stands: by numbers another pose. Limits stop a whole step.
TEST_F(Posing, TurnsAboutOwnAxesAsTheyStand) {
  std::string text(kFilm);
  text.replace(text.find(R"("y": [-60, 60])"), 14, R"("y": [-60, 60], "z": [-50, 50])");
  document::write_whole_file(path_, text);
  Previewed film = load_previewed(path_);
  PoseKeys keys(film, path_);
  EXPECT_TRUE(press(keys, "\txxyya").ends_with("turns about the joint's own axes as they stand"));
  const glm::dvec3 before(10, 10, 0);
  EXPECT_EQ(keys.pose().pose_at(*film.source, {1, 1}, 10), before);
  press(keys, "x");
  const modeler::Joint& stem = film.source->models[0].joints[1];
  const glm::dvec3 turned = animator::turned_about_own(stem, before, 0, 5).pose;
  EXPECT_LT(glm::distance(keys.pose().pose_at(*film.source, {1, 1}, 10), turned), 1e-6);
  EXPECT_LT(turned.z, -0.8);
  EXPECT_TRUE(press(keys, "xxxxxxx").ends_with("x stops at its limit"));
  EXPECT_TRUE(press(keys, "a").ends_with("turns by the joint's three numbers"));
}

TEST_F(Posing, KeysAreThoseOfTheCommand) {
  document::write_whole_file(other_, kFilm);
  Previewed film = load_previewed(path_);
  PoseKeys keys(film, path_);
  EXPECT_EQ(press(keys, "\r"), "Tab selects a joint");
  EXPECT_EQ(press(keys, "\tXX\ty\r"), "lamp arm  y 55 (0..150)  key set at frame 10");
  EXPECT_FALSE(keys.under_way());
  film::change_film(other_, [](document::Json& json, const animator::Film& meaning) {
    const std::vector<std::string> settings{"stem.x=-10", "arm.y=55"};
    animator::pose(json, meaning, "lamp", settings, {10, 10}, {});
  });
  EXPECT_EQ(document::read_file(path_), document::read_file(other_));
  EXPECT_EQ(press(keys, "\r"), "lamp arm  y 55 (0..150)  no joint has been turned");
}

TEST_F(Posing, UndoesItsKeysOneByOne) {
  Previewed film = load_previewed(path_);
  PoseKeys keys(film, path_);
  press(keys, "\tx\r", 4);
  const std::string one = document::read_file(path_);
  press(keys, "y\r", 8);
  EXPECT_NE(document::read_file(path_), one);
  press(keys, "u");
  EXPECT_EQ(document::read_file(path_), one);
  press(keys, "u");
  EXPECT_EQ(document::read_file(path_), kFilm);
  EXPECT_NE(press(keys, "u").find("no key is left to undo"), std::string::npos);
}

TEST_F(Posing, UndoesNothingThatOthersWrote) {
  Previewed film = load_previewed(path_);
  PoseKeys keys(film, path_);
  press(keys, "\tx\r");
  document::write_whole_file(path_, "{}");
  EXPECT_NE(press(keys, "u").find("has been changed since"), std::string::npos);
  EXPECT_EQ(document::read_file(path_), "{}");
  EXPECT_NE(press(keys, "x\r").find("no key is set: "), std::string::npos);
  EXPECT_TRUE(keys.under_way());
  EXPECT_EQ(document::read_file(path_), "{}");
}

TEST_F(Posing, FollowsTheFilm) {
  Previewed film = load_previewed(path_);
  PoseKeys keys(film, path_);
  press(keys, "\tx\r");
  press(keys, "y");
  Previewed written = load_previewed(path_);
  keys.change_film(written);
  EXPECT_TRUE(keys.under_way());  // the later turn
  EXPECT_TRUE(keys.note(10).starts_with("lamp stem  x 5 (-40..40)  y 5 (-60..60)"));
  std::string renamed = kFilm;
  while (renamed.find("stem") != std::string::npos) renamed.replace(renamed.find("stem"), 4, "pole");
  document::write_whole_file(path_, renamed);
  Previewed other = load_previewed(path_);
  keys.change_film(other);
  EXPECT_FALSE(keys.under_way());
  EXPECT_EQ(keys.note(10), "");
}

TEST_F(Posing, WhatIsSeenIsWhatTheFilmThenHas) {
  Previewed film = load_previewed(path_);
  PoseKeys keys(film, path_);
  press(keys, "\txxx\ty");
  Posed posed = keys.posed_at(10);
  EXPECT_EQ(posed.selected, (JointNumber{1, 3}));
  press(keys, "\r");
  const Previewed written = load_previewed(path_);
  const auto drawn = [](const Wireframe& wireframe, As as, const Posed& by) {
    Drawing drawing(96, 54);
    FilmDrawing(wireframe).draw(drawing, as, 10, wireframe.camera_at(10), 1, false, {}, by);
    return drawing.image().pixels;
  };
  // How bright lines are depends on what else moves in the film.
  const auto places = [](std::vector<std::uint32_t> pixels) {
    const std::uint32_t paper = pixels.front();
    for (std::uint32_t& pixel : pixels) pixel = pixel == paper ? 0 : 1;
    return pixels;
  };
  Posed unselected = posed;
  unselected.selected = {};
  for (const As as : {As::stick, As::vertices, As::prisms}) {
    EXPECT_EQ(places(drawn(film.wireframe, as, unselected)), places(drawn(written.wireframe, as, {})));
    EXPECT_NE(places(drawn(film.wireframe, as, {})), places(drawn(written.wireframe, as, {})));
    EXPECT_NE(drawn(film.wireframe, as, unselected), drawn(film.wireframe, as, posed));
  }
}

TEST_F(Posing, ModelsKeepNoPoses) {
  const std::filesystem::path model = folder_ / "model.json";
  constexpr const char* kModel = R"({"joints": [{"name": "a", "segment": {"shape": "box"}}]})";
  document::write_whole_file(model, kModel);
  Previewed film = load_previewed(model);
  PoseKeys keys(film, model);
  EXPECT_TRUE(press(keys, "\tx").ends_with("only shown  Esc give up"));
  EXPECT_TRUE(press(keys, "\r").ends_with("a model has no keys: its poses are only shown"));
  EXPECT_TRUE(keys.under_way());
  press(keys, "Xzzax");  // the last about its own x, where it stands at 0, 0, 10
  const glm::dvec3 turned = animator::turned_about_own(film.source->models[0].joints[0], {0, 0, 10}, 0, 5).pose;
  EXPECT_LT(glm::distance(keys.pose().pose_at(*film.source, {0, 0}, 10), turned), 1e-6);
  EXPECT_EQ(document::read_file(model), kModel);
}

TEST_F(Posing, CompiledFilmsHaveNoJoints) {
  const std::filesystem::path compiled = folder_ / "film.mars";
  film::save_film(load_previewed(path_).film, compiled);
  Previewed film = load_previewed(compiled);
  PoseKeys keys(film, compiled);
  for (const char key : std::string_view("\txu"))
    EXPECT_NE(press(keys, {&key, 1}).find("a .mars film has no joints to pose"), std::string::npos);
  EXPECT_FALSE(keys.under_way());
}

}  // namespace
}  // namespace mars::preview
