// Files of exact counts: the same forecast after reading, and what is refused.
#include "host/experiments/forecast/counts_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/programs/node_counter.h"
#include "tests/host/experiments/forecast/simulated_film.h"
#include "tests/temporary_folder.h"

namespace mars::forecast {
namespace {

const std::string kContent(32, 'a'), kOther(32, 'b');

class CountsFile : public testing::Test {
 protected:
  CountsFile() { save_counts(counts_, kContent, path_); }

  std::string bytes() const { return document::read_file(path_); }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  std::string refusal(const std::string& content = kContent) const {
    try {
      load_counts(path_, content, film_.tasks(), film_.view());
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "";
  }

  const SimulatedFilm film_{"robot-arm", "10-20", "ethernet"};
  const FilmCounts counts_ = film_.count_exactly();
  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "film.counts";
};

TEST_F(CountsFile, IsReadAsItWasWritten) {
  const FilmCounts read = load_counts(path_, kContent, film_.tasks(), film_.view());
  const wire::PackedFilm film = film_.view();
  const Setting setting{film, film_.platform()};
  const farm::Plan plan{film_.tasks(), farm::make_groups(6, 1, film_.tasks().size())};
  const Rehearsed before = rehearse(counts_, plan, setting, 6), after = rehearse(read, plan, setting, 6);
  EXPECT_EQ(before.seconds, after.seconds);
  EXPECT_EQ(before.bytes_to_nodes, after.bytes_to_nodes);
  EXPECT_EQ(before.node_memory, after.node_memory);
  EXPECT_EQ(read.counted, counts_.counted);
  EXPECT_TRUE(read.is_exact);
  save_counts(read, kContent, path_.string() + "2");
  EXPECT_EQ(bytes(), document::read_file(path_.string() + "2"));
}

TEST(CountsOfShadows, AreReadAsTheyWereWritten) {
  const SimulatedFilm film("s3s", "0-2", "ethernet");
  const test::TemporaryFolder folder;
  const auto path = folder / "shadows.counts";
  const FilmCounts counts = film.count_exactly();
  EXPECT_FALSE(counts.keyframes.front().casters.empty());
  save_counts(counts, kContent, path);
  EXPECT_EQ(load_counts(path, kContent, film.tasks(), film.view()).keyframes.front().casters.size(),
            counts.keyframes.front().casters.size());
}

// Written by a program that means other frames, or no frames at all: the checksum is right.
TEST_F(CountsFile, ThatMakesNoSenseIsRefused) {
  EXPECT_EQ(refusal(), "");
  const std::function<void(FilmCounts&)> changes[] = {
      [](FilmCounts& counts) { counts.tasks.clear(); },
      [](FilmCounts& counts) { counts.tasks.front().inbetweens.pop_back(); },
      [](FilmCounts& counts) { counts.tasks.front().keyframe = counts.keyframes.size(); },
      [](FilmCounts& counts) { counts.keyframes.front().lines.pop_back(); },
      [](FilmCounts& counts) { counts.keyframes.front().last_still_line = 4'000'000'000; },
      [](FilmCounts& counts) { counts.keyframes.front().lines.front().samples = 1e300; },
      [](FilmCounts& counts) { counts.keyframes.front().lines.front().edge_boxes = -1; },
      [](FilmCounts& counts) { counts.tasks.front().inbetweens.front().kept_points = std::nan(""); },
      [](FilmCounts& counts) { counts.keyframes.front().placed.front().surface = 4'000'000'000; },
      [](FilmCounts& counts) {
        counts.keyframes.front().constant_blocks.push_back({65535, 0, 1, 0});
      },
      [](FilmCounts& counts) {
        counts.tasks.front().inbetweens.front().blocks.push_back({0, 0, 65535, 0});
      }};
  for (const auto& change : changes) {
    FilmCounts changed = counts_;
    change(changed);
    save_counts(changed, kContent, path_);
    EXPECT_NE(refusal().find("has counts that make no sense"), std::string::npos) << &change - changes;
  }
}

TEST_F(CountsFile, OfAnotherFilmIsRefused) {
  EXPECT_NE(refusal(kOther).find("has counts of another film"), std::string::npos);
}

TEST_F(CountsFile, ThatIsDamagedIsRefused) {
  const std::string whole = bytes();
  for (const std::size_t at : {std::size_t{20}, std::size_t{60}, std::size_t{100}, whole.size() - 1}) {
    std::string changed = whole;
    changed[at] ^= 1;
    write(changed);
    EXPECT_NE(refusal().find("is damaged"), std::string::npos) << at;
  }
  write(whole.substr(0, whole.size() - 1));
  EXPECT_NE(refusal().find("is damaged"), std::string::npos);
}

TEST_F(CountsFile, OfAnotherVersionOrKindIsRefused) {
  std::string old = bytes();
  old[8] = 99;
  write(old);
  EXPECT_NE(refusal().find("has counts of another version of MARS"), std::string::npos);
  for (const std::string& other : {std::string(), std::string("{}"), std::string(200, 'x')}) {
    write(other);
    EXPECT_NE(refusal().find("is no file of counts"), std::string::npos);
  }
}

TEST(CountedContent, FollowsFilmFramesAndBands) {
  const SimulatedFilm film("robot-arm", "10-20", "ethernet"), fewer("robot-arm", "10-19", "ethernet");
  const auto content = [](const SimulatedFilm& of, images::PictureFormat format, char byte) {
    const std::vector<std::byte> block(64, static_cast<std::byte>(byte));
    return counted_content(block, of.tasks(), of.view(), format);
  };
  const std::string one = content(film, images::PictureFormat::png, 'a');
  EXPECT_EQ(one, content(film, images::PictureFormat::png, 'a'));
  EXPECT_NE(one, content(film, images::PictureFormat::png, 'b'));
  EXPECT_NE(one, content(fewer, images::PictureFormat::png, 'a'));
}

}  // namespace
}  // namespace mars::forecast
