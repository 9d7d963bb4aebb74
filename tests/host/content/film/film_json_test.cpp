// Film files that are opened and changed while the file with their sound is missing.
#include "host/content/film/film_json.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::film {
namespace {

class FilmWithoutItsSound : public testing::Test {
 protected:
  FilmWithoutItsSound() {
    std::ofstream(folder_ / "other.wav") << "sound";
    std::ofstream(path_) << R"({"frames": 2, "audio": "gone.wav", "camera": {"eye": [0, -9, 2]}, "models": {},)"
                         << R"( "actors": []})";
  }

  void set(const char* key, const document::Json& value) const {
    change_film(path_, [&](document::Json& json, const animator::Film&) { json[key] = value; });
  }

  document::Json json() const { return open_film(path_).json; }

  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "film.json";
};

TEST_F(FilmWithoutItsSound, IsOpenedAndChanged) {
  EXPECT_EQ(open_film(path_).film.audio, folder_ / "gone.wav");
  set("frames", 3);
  EXPECT_EQ(json()["frames"], 3);
}

TEST_F(FilmWithoutItsSound, GetsAnotherSoundThatIsThere) {
  const std::string refusal = document::failure_of([&] { set("audio", "none.wav"); });
  EXPECT_TRUE(document::holds(refusal, "/none.wav', which does not exist")) << refusal;
  EXPECT_EQ(json()["audio"], "gone.wav");
  set("audio", "other.wav");
  EXPECT_EQ(json()["audio"], "other.wav");
}

TEST_F(FilmWithoutItsSound, IsNotMade) {
  EXPECT_TRUE(document::holds(document::failure_of([&] { create_film(folder_ / "new.json", json()); }),
                              "/gone.wav', which does not exist"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new.json"));
}

}  // namespace
}  // namespace mars::film
