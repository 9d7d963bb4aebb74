#include "host/shell/launch/film_check.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::launch {
namespace {

std::string failure(const std::filesystem::path& film) {
  return document::failure_of([&] { check_film_file(film); });
}

TEST(FilmCheck, NamesWhatIsNoFilm) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  };
  EXPECT_TRUE(document::holds(failure(folder / "none.json"), "none.json: "));
  EXPECT_TRUE(document::holds(failure(folder / ""), "is a directory"));
  mkfifo((folder / "pipe.json").c_str(), 0600);
  EXPECT_TRUE(document::holds(failure(folder / "pipe.json"), "is not a regular file"));
  EXPECT_NE(failure(write("empty.json", "")), "");
  EXPECT_TRUE(document::holds(failure(write("half.json", "{\"frames\": 3,\n")), "half.json:1: is not JSON"));
  EXPECT_TRUE(document::holds(failure(write("noise.json",
                                            "\x7f"
                                            "ELF")),
                              "is not JSON"));
  EXPECT_EQ(failure(write("film.json", "{\"frames\": 3}\n")), "");
  EXPECT_EQ(failure(write("film.mars", "\x89MARS\r\n\x1a\n")), "") << "the host checks the rest";
  EXPECT_EQ(failure(write("large.json", std::string(2 << 20, '{'))), "") << "reading it twice would take time";
}

}  // namespace
}  // namespace mars::launch
