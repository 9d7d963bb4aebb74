// When files are to be read again, however they are saved.
#include "host/preview/watched_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <functional>

#include "hal/failure/failure.h"
#include "host/content/document/whole_file.h"
#include "host/preview/load.h"
#include "tests/temporary_folder.h"

namespace mars::preview {
namespace {

namespace fs = std::filesystem;

document::FileStamps stamps_of(const std::vector<fs::path>& paths) {
  document::FileStamps stamps;
  for (const fs::path& path : paths) stamps.emplace(path, document::stamp_of(path));
  return stamps;
}

// As an editor that writes into the file does, at a time of its own.
void write_in_place(const fs::path& path, const std::string& text) {
  const bool there = fs::exists(path);
  const fs::file_time_type before = there ? fs::last_write_time(path) : fs::file_time_type{};
  std::ofstream(path) << text;
  if (there) fs::last_write_time(path, before + std::chrono::milliseconds(5));
}

TEST(WatchedFiles, AreChangedOnceTheyAreTheSameAtTwoLooks) {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "file";
  write_in_place(file, "read");
  WatchedFiles files(stamps_of({file}));
  EXPECT_FALSE(files.changed_and_settled());
  write_in_place(file, "");
  EXPECT_FALSE(files.changed_and_settled());
  EXPECT_FALSE(files.are_as_read());
  write_in_place(file, "writ");  // as long as it was
  EXPECT_FALSE(files.changed_and_settled());
  EXPECT_TRUE(files.changed_and_settled());
  EXPECT_TRUE(files.changed_and_settled());  // until it is read
  files.set_read(stamps_of({file}));
  EXPECT_FALSE(files.changed_and_settled());
  EXPECT_TRUE(files.are_as_read());
}

TEST(WatchedFiles, AreChangedByEveryKindOfSave) {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "file", link = folder / "link", other = folder / "other", none = folder / "none";
  for (const fs::path& path : {file, other}) write_in_place(path, "read");
  fs::create_symlink(file, link);
  WatchedFiles files(stamps_of({file, link, none}));
  const std::vector<std::function<void()>> saves{[&] { write_in_place(file, "writ"); },
                                                 [&] { document::write_whole_file(file, "writ"); },
                                                 [&] { fs::remove(file); },
                                                 [&] { write_in_place(file, "made"); },
                                                 [&] { chmod(file.c_str(), 0600); },
                                                 [&] { fs::remove(link), fs::create_symlink(other, link); },
                                                 [&] { write_in_place(none, "here"); }};
  for (std::size_t i = 0; i < saves.size(); ++i) {
    saves[i]();
    files.changed_and_settled();
    EXPECT_TRUE(files.changed_and_settled()) << i;
    files.set_read(stamps_of({file, link, none}));
    EXPECT_FALSE(files.changed_and_settled()) << i;
  }
  write_in_place(folder / "another", "x");
  fs::remove(folder / "another");
  EXPECT_TRUE(files.are_as_read());
}

// Of a film: the film, its models, and what these are derived from.
TEST(WatchedFiles, OfAFilmAreThoseItIsReadFrom) {
  const test::TemporaryFolder folder;
  const auto written = [&](const char* name, const char* json) {
    document::write_whole_file(folder / name, json);
    return folder / name;
  };
  const fs::path film = written("film.json", R"({"frames": 2, "camera": {"eye": [0, -3, 1]},
    "models": {"a": "a.json", "b": "sub/b.json"}, "actors": [{"name": "a", "model": "a"}]})");
  const fs::path a = written("a.json", R"({"from": "c.json", "proportions": {"scale": [1, 1, 2]}})");
  const fs::path c = written("c.json", R"({"joints": [{"name": "a", "segment": {"shape": "box"}}]})");
  const auto files_of = [](const fs::path& path) {
    document::RecordedReads reads;
    try {
      load_previewed(path);
    } catch (const Failure&) {
    }
    return reads.stamps();
  };
  EXPECT_EQ(files_of(film), stamps_of({film, a, c, folder / "sub/b.json"}));
  EXPECT_EQ(files_of(a), stamps_of({a, c}));
  EXPECT_EQ(files_of(folder / "none.json"), stamps_of({folder / "none.json"}));
}

}  // namespace
}  // namespace mars::preview
