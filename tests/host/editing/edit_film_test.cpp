#include "host/editing/edit_film.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/host/content/document/failure_of.h"

namespace mars::editing {
namespace {

const std::filesystem::path kFilm = std::filesystem::path(MARS_SOURCE_DIR) / "examples/robot-arm.json";

TEST(EditFilm, ObeysCommandsOneAfterTheOther) {
  document::Json film = document::read_json(kFilm);
  const std::vector<Command> commands = {
      {"animate", "pose", "camera", "fov=30", "--frame", "7"},
      {"animate", "move", "camera", "fov", "--frame", "7", "--to", "9"},
  };
  const Done done = edit_film(film, kFilm, commands);
  EXPECT_TRUE(done.remarks.empty());
  bool found = false;
  for (const document::Json& key : film.at("camera").at("keys"))
    if (key.at("frame") == 9) found = key.at("fov") == 30;
  EXPECT_TRUE(found) << document::laid_out(film.at("camera"));
}

TEST(EditFilm, BlendsAPoseIntoTheFramesAround) {
  document::Json film = document::read_json(kFilm);
  const Command pose = {"animate", "pose", "camera", "fov+=9", "--frame", "7", "--falloff", "3"};
  edit_film(film, kFilm, std::span(&pose, 1));
  std::vector<std::uint32_t> frames;
  for (const document::Json& key : film.at("camera").at("keys")) frames.push_back(key.at("frame"));
  for (const std::uint32_t frame : {4u, 7u, 10u}) EXPECT_NE(std::ranges::find(frames, frame), frames.end()) << frame;
  const Command none = {"animate", "pose", "camera", "fov+=9", "--frame", "7", "--falloff", "0"};
  EXPECT_NE(document::failure_of([&] { edit_film(film, kFilm, std::span(&none, 1)); }).find("--falloff"),
            std::string::npos);
}

TEST(EditFilm, DoesAllOrNothing) {
  const document::Json before = document::read_json(kFilm);
  document::Json film = before;
  const std::vector<Command> commands = {{"animate", "pose", "camera", "fov=30", "--frame", "7"},
                                         {"animate", "pose", "camera", "fov=300", "--frame", "8"}};
  EXPECT_NE(document::failure_of([&] { edit_film(film, kFilm, commands); }), "");
  EXPECT_EQ(film, before);
}

TEST(EditFilm, ExplainsWordsThatItDoesNotKnow) {
  document::Json film = document::read_json(kFilm);
  const auto failure_of = [&](const Command& command) {
    return document::failure_of([&] { edit_film(film, kFilm, std::span(&command, 1)); });
  };
  EXPECT_NE(failure_of({"animate", "wlak", "tom"}).find("did you mean 'walk'"), std::string::npos);
  EXPECT_NE(failure_of({"animate", "pose", "camera", "fov=30"}).find("--frame"), std::string::npos);
  EXPECT_NE(failure_of({"animate", "film", "x"}).find("'film' is not a command"), std::string::npos);
  EXPECT_NE(failure_of({"film", "light", "material", "x"}).find("'material' is not a command"), std::string::npos);
  EXPECT_NE(failure_of({"film", "animate", "x"}).find("'animate' is not a command"), std::string::npos);
  EXPECT_NE(failure_of({"film", "--", "x"}), "");
  EXPECT_NE(failure_of({""}), "");
  EXPECT_NE(failure_of({}), "");
  EXPECT_NE(failure_of({"animate"}), "");
  EXPECT_NE(failure_of({"animate", "--help"}).find("asks for help"), std::string::npos);
  EXPECT_NE(failure_of({"animate", "walk", "robot", "--help"}).find("asks for help"), std::string::npos);
}

TEST(EditFilm, TellsTheFilmsLength) {
  document::Json film = document::read_json(kFilm);
  const std::string before = film.at("frames").dump();
  const auto report_of = [&](const Command& command) { return edit_film(film, kFilm, std::span(&command, 1)).report; };
  EXPECT_EQ(report_of({"animate", "pose", "camera", "fov=30", "--frame", "500"}),
            "the last key is at frame 500; the film shows only its " + before +
                " frames: --lengthen, or set its frames to 501\n");
  EXPECT_EQ(report_of({"animate", "pose", "camera", "fov=31", "--frame", "500", "--lengthen"}),
            "the film has 501 frames now, not " + before + "\n");
  EXPECT_EQ(report_of({"animate", "pose", "camera", "fov=32", "--frame", "500", "--lengthen"}), "");
}

TEST(EditFilm, ReducesNoKeysOfLights) {
  document::Json film = document::read_json(kFilm);
  film["lights"] = {{{"direction", {0, 0, 1}}, {"keys", {{{"frame", 0}, {"intensity", 1}}}}}};
  const Command reduce = {"animate", "reduce", "light/1", "--error", "1"};
  const std::string failure = document::failure_of([&] { edit_film(film, kFilm, std::span(&reduce, 1)); });
  EXPECT_NE(failure.find("'light/1': has no part with three keys or more"), std::string::npos) << failure;
}

}  // namespace
}  // namespace mars::editing
