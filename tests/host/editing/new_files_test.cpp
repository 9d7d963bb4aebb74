// Files that words make a film or model name lie below the studio's folder; those that it named before stay.
#include "host/editing/new_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::editing {
namespace {

using Json = nlohmann::ordered_json;

class NewFiles : public testing::Test {
 protected:
  NewFiles() {
    std::filesystem::create_directories(folder_ / "studio/films");
    std::filesystem::create_symlink("..", folder_ / "studio/up");
    std::ofstream(folder_ / "outside.wav") << "sound";
  }

  std::string failure(const Json& was, const Json& now, const char* object = "film") const {
    const std::filesystem::path film = folder_ / "studio/films/film.json";
    return document::failure_of(
        [&] { require_new_files_below(folder_ / "studio", film, keys::object(object), was, now); });
  }

  const test::TemporaryFolder folder_;
};

TEST_F(NewFiles, AreBelowTheFolder) {
  for (const char* name : {"a.wav", "../a.wav", "more/a.wav", "../films/../a.wav"})
    EXPECT_EQ(failure(Json::object(), {{"audio", name}}), "") << name;
}

TEST_F(NewFiles, OutsideAreRefused) {
  const std::string absolute = (folder_ / "outside.wav").string();
  for (const std::string& name :
       {std::string("../../outside.wav"), absolute, std::string("../up/outside.wav"), std::string("/etc/passwd")}) {
    EXPECT_TRUE(document::holds(failure(Json::object(), {{"audio", name}}), "is not below the studio's folder"))
        << name;
    EXPECT_NE(failure(Json::object(), {{"materials", {{"oak", {{"images", {{"color", name}}}}}}}}), "") << name;
    EXPECT_NE(failure(Json::object(), {{"models", {{"man", name}}}}), "") << name;
    EXPECT_NE(failure(Json::object(), {{"models", {{"man", {{"from", name}}}}}}), "") << name;
    EXPECT_NE(failure(Json::object(), {{"from", name}}, "model"), "") << name;
  }
}

TEST_F(NewFiles, ThatWereNamedBeforeMayStay) {
  const Json was{{"audio", "../../outside.wav"}};
  EXPECT_EQ(failure(was, {{"audio", "../../outside.wav"}, {"frames", 3}}), "");
  EXPECT_NE(failure(was, {{"audio", "../../other.wav"}}), "");
}

TEST_F(NewFiles, OfCommandsMayBeAnywhere) {
  const Json now{{"audio", "/etc/passwd"}};
  EXPECT_NO_THROW(require_new_files_below("", folder_ / "film.json", keys::object("film"), Json::object(), now));
}

}  // namespace
}  // namespace mars::editing
