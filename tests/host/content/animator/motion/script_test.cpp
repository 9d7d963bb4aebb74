#include "host/content/animator/motion/script/script.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "host/content/animator/pose/camera_points.h"
#include "host/content/document/file.h"
#include "tests/host/content/animator/motion/bodies.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::motion {
namespace {

const document::Json& cubes() {
  static const document::Json film = [] {
    document::Json made =
        film_with({{"joints", document::Json::array({jointed("cube", "", {0, 0, 0}, {}, {{-1, -1, -1}, {1, 1, 1}})})}});
    made["actors"] =
        document::Json::array({{{"name", "green"}, {"model", "figure"}}, {{"name", "the blue"}, {"model", "figure"}}});
    return made;
  }();
  return film;
}

document::Json played(const std::string& script, document::Json film = cubes()) {
  play_script(film, "film.json", script, "a.script");
  read(film);
  return film;
}

std::string failure(const std::string& script) {
  return document::failure_of([&] { played(script); });
}

std::vector<std::uint32_t> frames_of(const document::Json& actor) {
  std::vector<std::uint32_t> frames;
  for (const document::Json& key : actor.at("keys")) frames.push_back(key.at("frame"));
  return frames;
}

TEST(Script, TheThesisTwoCubesOnOnePage) {
  const document::Json film = played(R"(
let runtime = 96
let midpoint = runtime / 2   # half way
at 0         green      spin degrees 180 until runtime
at midpoint  "the blue" spin degrees 90 until runtime
at runtime   cut)");
  EXPECT_EQ(film.at("frames"), 96);
  EXPECT_EQ(frames_of(film.at("actors")[0]).front(), 0u);
  EXPECT_EQ(frames_of(film.at("actors")[0]).back(), 96u);
  EXPECT_EQ(frames_of(film.at("actors")[1]).front(), 48u);
  EXPECT_EQ(film.at("actors")[1].at("keys").back().at("turn")[2], 90);
}

TEST(Script, ACameraMovesNoLongerThanAFilmLasts) {
  EXPECT_TRUE(document::holds(
      failure("at 10 camera move eye 1 2 3 seconds 1e6"),
      "a.script:1: this line moves the camera until frame 24000010 (a film has at most 1000000 frames"));
}

TEST(Script, CutAloneEndsTheFilmWhenTheLineBeforeEnds) {
  EXPECT_EQ(played("at 10 green spin seconds 1\ncut").at("frames"), 34);
}

TEST(Script, CuesFollowOneAnother) {
  const document::Json film = played(
      "at 1s green go to 1 0 0 seconds 0.5 as there\n"
      "then green go to 2 0 0\n"
      "after there + 0.5s \"the blue\" go to 0 1 0 seconds 1");
  EXPECT_EQ(frames_of(film.at("actors")[0]), (std::vector<std::uint32_t>{24, 36, 60}));
  EXPECT_EQ(frames_of(film.at("actors")[1]), (std::vector<std::uint32_t>{48, 72}));
}

TEST(Script, PlayedAgainAfterAChangeLeavesNothingOfTheOld) {
  const document::Json once = played("at 10 green spin seconds 4\nat 20 camera cut eye 1 2 3");
  const std::string shorter = "at 10 green go to 3 0 0\nat 30 camera cut eye 3 2 1";
  EXPECT_EQ(document::laid_out(played(shorter, played(shorter))), document::laid_out(played(shorter)));
  EXPECT_EQ(frames_of(played(shorter, once).at("actors")[0]).back(), 34u);
}

TEST(Script, TheCameraCutsFromOneFrameToTheNextAndMoves) {
  document::Json film = played("at 20 camera cut eye 5 0 1 fov 30\nat 40 camera move eye 9 0 1 seconds 1");
  const animator::Film meaning = read(film);
  EXPECT_EQ(animator::eye_at(meaning, 19), glm::dvec3(0, -9, 2));
  EXPECT_EQ(animator::eye_at(meaning, 20), glm::dvec3(5, 0, 1));
  EXPECT_EQ(animator::eye_at(meaning, 40), glm::dvec3(5, 0, 1));
  EXPECT_EQ(animator::eye_at(meaning, 64), glm::dvec3(9, 0, 1));
  EXPECT_EQ(animator::value_at(meaning.camera.fov, 19), 40);
  EXPECT_EQ(animator::value_at(meaning.camera.fov, 20), 30);
}

// By numbers Rx Rz, with the word local the thesis's Rz Rx.
TEST(Script, PosesAboutOwnAxes) {
  const auto turned = [](const std::string& second) {
    const document::Json film = played("at 24 green pose cube.z+=90\nthen green pose " + second + " as turned");
    return film["actors"][0]["keys"][1]["pose"]["cube"];
  };
  EXPECT_EQ(turned("cube.x+=90"), document::Json({90, 0, 90}));
  EXPECT_EQ(turned("cube.x+=90 local"), document::Json({0, 90, 90}));
  EXPECT_EQ(turned("local c*.x+=90"), document::Json({0, 90, 90}));
  EXPECT_EQ(failure("at 24 green pose cube.x=90 local"),
            "a.script:1: 'cube.x=90': is no turn about one axis (with --local write it like elbow.x+=30)");
  EXPECT_EQ(failure("at 24 green pose cube.x+=90 --local"),
            "a.script:1: this line has '--local' (words of scripts have no dashes: write local)");
  EXPECT_TRUE(document::holds(failure("at 24 green pose local"), "does not say what is posed"));
  EXPECT_TRUE(document::holds(failure("at 24 camera pose fov=9 local"), "is no joint that could turn"));
}

TEST(Script, SaysLineAndRemedyOfWhatIsWrong) {
  EXPECT_EQ(failure("\nfrom 3 green spin"),
            "a.script:2: this line begins with 'from', which is no cue "
            "(begin with at TIME, then, after NAME, or let)");
  EXPECT_EQ(failure("at 3 gren spin"),
            "a.script:1: this line names 'gren', which is no actor of the film (did you mean 'green'?)");
  EXPECT_EQ(failure("at 3 green spinn"),
            "a.script:1: this line has 'spinn', which is no action (did you mean 'spin'?)");
  EXPECT_EQ(failure("at 3 green spin axes x"),
            "a.script:1: this line has 'axes', which 'spin' does not know (did you mean 'axis'?)");
  EXPECT_EQ(failure("at 3 green spin axis"),
            "a.script:1: this line ends where axis AXIS is missing (write it, or take the line out)");
  EXPECT_EQ(failure("at 3 green spin degrees two"),
            "a.script:1: spin: 'degrees' is 'two', which is no number (write a number, as in 1.5)");
  EXPECT_EQ(failure("let end = 30\nat ende green spin"),
            "a.script:2: this line has 'ende', which is no time (did you mean 'end'?)");
  EXPECT_EQ(failure("at 30 green spin until 20"),
            "a.script:1: this line ends before it begins (write a later time after until)");
  EXPECT_EQ(failure(std::string("at 0 \0", 6)),
            "a.script:1: this line holds control characters (is it a script? Write plain text)");
  EXPECT_EQ(failure("at 0 camera cut fov 30\nat 5 camera cut fov 0\nat 9 green spin").find("a.script:2: "), 0u);
  EXPECT_EQ(failure("at 0 cut"), "a.script:1: this line ends the film before it begins (cut later)");
  EXPECT_EQ(failure("at 0 green walk"),
            "a.script:1: actor 'green': its model names no left hip, which 'walk' needs "
            "(add it to the model's limbs: docs/model-format.md)");
}

TEST(Script, WhatFailsLeavesTheFilmAsItWas) {
  document::Json film = cubes();
  EXPECT_NE(document::failure_of([&] { play_script(film, "film.json", "at 0 green spin\nat 5 red spin", "a.script"); }),
            "");
  EXPECT_EQ(film, cubes());
}

TEST(Script, TheExamplesAreAsTheirScriptsMakeThem) {
  for (const std::string name : {"cubes", "visit", "ball", "meadow"}) {
    const std::filesystem::path path = std::filesystem::path(MARS_SOURCE_DIR) / "examples" / (name + ".json");
    const document::Json kept = document::read_json(path);
    document::Json made = kept;
    play_script(made, path, document::read_file(path.parent_path() / (name + ".script")), name + ".script");
    const animator::Film a = animator::read_film(path);
    const document::Document document(document::laid_out(made), name);
    const animator::Film b = animator::read_film(document.root(), path.parent_path());
    ASSERT_EQ(a.frames, b.frames);
    for (std::size_t actor = 0; actor < a.actors.size(); ++actor)
      for (std::uint32_t frame = 0; frame < a.frames; ++frame) {
        const auto place = [&](const animator::Film& film) {
          return animator::value_at(film.actors[actor].motion.place, frame);
        };
        EXPECT_LT(glm::distance(place(a), place(b)), 1e-3) << name << " " << a.actors[actor].name << " " << frame;
      }
    for (std::size_t actor = 0; actor < a.actors.size(); ++actor)
      EXPECT_EQ(kept["actors"][actor].contains("keys") ? kept["actors"][actor]["keys"].size() : 0u,
                made["actors"][actor].contains("keys") ? made["actors"][actor]["keys"].size() : 0u)
          << name;
  }
}

}  // namespace
}  // namespace mars::motion
