// Files of exact counts: the same forecast after reading, and what is refused.
#include "host/experiments/forecast/counts_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/programs/node_counter.h"
#include "tests/host/experiments/forecast/simulated_film.h"

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
      load_counts(path_, content);
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "";
  }

  const SimulatedFilm film_{"robot-arm", "10-20", "ethernet"};
  const FilmCounts counts_ = film_.count_exactly();
  const std::filesystem::path path_ = testing::TempDir() + "film.counts";
};

TEST_F(CountsFile, IsReadAsItWasWritten) {
  const FilmCounts read = load_counts(path_, kContent);
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
