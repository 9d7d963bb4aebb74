#include "host/content/film/film_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>

#include "host/content/document/file.h"
#include "host/content/film/describe.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/film/small_film.h"
#include "tests/temporary_folder.h"

namespace mars::film {
namespace {

namespace fs = std::filesystem;

class FilmFileTest : public testing::Test {
 protected:
  void SetUp() override {
    film_ = compiled(arm_film(R"({"name": "x", "model": "arm", "keys": [
        {"frame": 0, "place": [0, 0, 0]}, {"frame": 5, "place": [1, 0, 0]}]})"));
    save_film(film_, path_);
    bytes_ = document::read_file(path_);
  }

  std::string failure(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
    return document::failure_of([&] { load_compiled_film(path_); });
  }

  const test::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "x.mars";
  CompiledFilm film_;
  std::string bytes_;
};

TEST_F(FilmFileTest, ComesBackBitForBit) {
  const CompiledFilm back = load_film(path_);
  EXPECT_EQ(std::memcmp(back.block().data(), film_.block().data(), film_.block().size()), 0);
  CompileOptions other;
  other.samples = 16;
  EXPECT_EQ(load_film(path_, other).view().settings().samples, 16u);
  EXPECT_EQ(back.actors, 1u);
  EXPECT_EQ(back.joints, 2u);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(back.block().data()) % 64, 0u);
  EXPECT_EQ(folder_.entries(), 1u) << "nothing else is left";
}

TEST_F(FilmFileTest, SaysTheSameOfBothKinds) {
  const auto after_name = [](const std::string& text) { return text.substr(text.find('\n')); };
  EXPECT_EQ(after_name(describe(load_film(path_))), after_name(describe(film_)));
  EXPECT_TRUE(document::holds(describe(film_), "actors      1 with 2 joints"));
  EXPECT_TRUE(document::holds(describe(film_), "frames      20 at 24 a second, 0.83 seconds"));
}

TEST_F(FilmFileTest, TakesAnotherSizeButNotOtherIntervals) {
  const CompiledFilm large = load_film(path_, {{}, {{1920, 1080}}});
  EXPECT_EQ(large.view().settings().height, 1080u);
  EXPECT_EQ(large.view().settings().frames, 20u);
  EXPECT_TRUE(document::holds(document::failure_of([&] {
                                load_film(path_, {animator::Cutting::keyframes, {}});
                              }),
                              "its intervals are cut"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { load_film(path_, {{}, {{1920, 0}}}); }), "1 to 16384"));
}

TEST_F(FilmFileTest, EveryFlippedBitIsSeen) {
  std::mt19937 random(5);
  for (std::size_t round = 0; round < 2000; ++round) {
    std::string bytes = bytes_;
    const std::size_t bit = round < 512 ? round : random() % (8 * bytes.size());
    bytes[bit / 8] ^= char(1 << bit % 8);
    EXPECT_TRUE(document::holds(failure(bytes), "no sound compiled film")) << bit;
  }
}

TEST_F(FilmFileTest, TornFilesAreSeen) {
  for (std::size_t length = 0; length < bytes_.size(); length += length < 200 ? 1 : 61)
    EXPECT_NE(failure(bytes_.substr(0, length)), "") << length;
  EXPECT_TRUE(document::holds(failure(bytes_ + "x"), "its size is wrong"));
}

TEST_F(FilmFileTest, ForeignFilesAreTold) {
  std::ofstream(path_, std::ios::trunc) << "\x89PNG\r\n\x1a\n" << std::string(200, '\0');
  EXPECT_TRUE(document::holds(document::failure_of([&] { load_film(path_); }), "binary, not JSON"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { load_film(folder_ / "none.mars"); }), "no such file"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { load_film(folder_.path()); }), "is a directory"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { save_film(film_, folder_ / "no/x.mars"); }), "x.mars"));
}

}  // namespace
}  // namespace mars::film
