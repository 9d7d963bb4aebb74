// Files that a document names are there, and regular.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "host/content/document/document.h"
#include "host/content/document/fields.h"
#include "host/content/document/file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::document {
namespace {

class FileNames : public testing::Test {
 protected:
  // Reads what a film in the folder names so.
  std::filesystem::path named(const std::string& json) const {
    const Document film("{\n\"audio\": " + json + "}", (folder_ / "film.json").string());
    return read_file_name(*film.root().find("audio"));
  }

  std::string failure(const std::string& json) const {
    return failure_of([&] { named(json); });
  }

  const test::TemporaryFolder folder_;
};

TEST_F(FileNames, OfOneFileHaveOnePlace) {
  const std::filesystem::path file = folder_ / "a.wav", missing = folder_ / "none/../b.wav";
  std::ofstream(file) << "sound";
  std::filesystem::create_symlink("a.wav", folder_ / "link.wav");
  EXPECT_EQ(place_of_file(folder_ / "link.wav"), place_of_file(file));
  EXPECT_EQ(place_of_file(missing), place_of_file(folder_ / "b.wav"));
  EXPECT_NE(place_of_file(missing), place_of_file(file));
}

TEST_F(FileNames, AreSeenFromTheFolderOfTheDocument) {
  std::filesystem::create_directory(folder_ / "sounds");
  std::ofstream(folder_ / "sounds/a.wav") << "sound";
  EXPECT_EQ(named(R"("sounds/a.wav")"), folder_ / "sounds/a.wav");
  EXPECT_EQ(named("\"" + (folder_ / "sounds/a.wav").string() + "\""), folder_ / "sounds/a.wav");
  std::filesystem::create_symlink("sounds/a.wav", folder_ / "link.wav");
  EXPECT_EQ(named(R"("link.wav")"), folder_ / "link.wav");
  const Document film(R"({"audio": "a.wav"})", "film.json");
  EXPECT_EQ(read_file_name(*film.root().find("audio"), folder_ / "sounds"), folder_ / "sounds/a.wav");
}

TEST_F(FileNames, OfWhatIsNotThereAreRefusedAtTheirLine) {
  const std::string refusal = failure(R"("none.wav")");
  EXPECT_TRUE(holds(refusal, "film.json:2: audio: is '" + (folder_ / "none.wav").string() + "', which does not exist"))
      << refusal;
  std::filesystem::create_symlink("none.wav", folder_ / "link.wav");
  EXPECT_TRUE(holds(failure(R"("link.wav")"), "which does not exist"));
  EXPECT_FALSE(failure(R"("")").empty());
  EXPECT_FALSE(failure("3").empty());
}

TEST_F(FileNames, OfFoldersPipesAndDevicesAreRefused) {
  std::filesystem::create_directory(folder_ / "folder.wav");
  ASSERT_EQ(mkfifo((folder_ / "pipe.wav").c_str(), 0600), 0);
  for (const char* json : {R"("folder.wav")", R"("pipe.wav")", R"("/dev/null")", R"(".")"})
    EXPECT_TRUE(holds(failure(json), "which is not a regular file")) << json;
}

}  // namespace
}  // namespace mars::document
