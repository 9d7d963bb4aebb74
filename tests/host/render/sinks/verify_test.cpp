#include "host/render/sinks/verify.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <filesystem>
#include <set>
#include <string>

#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/images/picture_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
namespace {

namespace fs = std::filesystem;
using images::PictureFormat;

TEST(Verify, OneHashForEqualFrames) {
  const test::TemporaryFolder folder;
  const Manifest manifest = small_manifest();
  std::vector<std::string> hashes;
  for (const auto& [name, color] : {std::pair{"a", 0x102030u}, {"b", 0x102030u}, {"c", 0x102031u}}) {
    fill(folder / name, manifest, color);
    const Verdict verdict = verify_folder(folder / name);
    EXPECT_EQ(verdict.expected, 5u);
    EXPECT_TRUE(verdict.troubles.empty());
    hashes.push_back(verdict.hash);
  }
  EXPECT_EQ(hashes[0].size(), 32u);
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_NE(hashes[0], hashes[2]);
}

TEST(Verify, ReadsEveryFormatAndNamesItsPixels) {
  const test::TemporaryFolder folder;
  std::set<std::string> hashes;
  for (const auto& [format, pixels] : {std::pair{PictureFormat::png, "8-bit sRGB"},
                                       {PictureFormat::png16, "16-bit sRGB"},
                                       {PictureFormat::exr, "half-float linear RGB"}}) {
    const fs::path path = folder / images::facts_of(format).name;
    fill(path, in_format(format), 0x2030);
    const Verdict verdict = verify_folder(path);
    EXPECT_TRUE(verdict.troubles.empty()) << path;
    EXPECT_EQ(verdict.pixels, pixels);
    hashes.insert(verdict.hash);
    const fs::path frame = path / frame_file_name(in_format(format), 2);
    fs::resize_file(frame, fs::file_size(frame) / 2);
    EXPECT_EQ(verify_folder(path).troubles.size(), 1u) << path;
  }
  EXPECT_EQ(hashes.size(), 2u) << "the words of 16-bit and of half-float pixels are the same";
}

TEST(Verify, TellsEveryFrameThatIsNotAsItShouldBe) {
  const test::TemporaryFolder folder;
  const Manifest manifest = small_manifest();
  fill(folder.path(), manifest, 0);
  fs::remove(folder / "frame-0001.png");
  fs::resize_file(folder / "frame-0002.png", 40);
  document::write_whole_file(folder / "frame-0005.png",
                             images::encode_picture(images::PictureFormat::png, 2, 3, std::vector<std::uint32_t>(6)));
  fs::copy_file(folder / "frame-0000.png", folder / "frame-0011.png", fs::copy_options::overwrite_existing);
  const Verdict verdict = verify_folder(folder.path());
  ASSERT_EQ(verdict.troubles.size(), 4u);
  EXPECT_EQ(verdict.troubles[0].frame, 1u);
  EXPECT_EQ(verdict.troubles[0].reason, "missing");
  EXPECT_EQ(verdict.troubles[1].frame, 2u);
  EXPECT_TRUE(document::holds(verdict.troubles[1].reason, "not a whole PNG"));
  EXPECT_EQ(verdict.troubles[2].reason, "2x3 pixels instead of 6x4");
  EXPECT_EQ(verdict.troubles[3].reason, "other pixels than were rendered");
  EXPECT_EQ(verdict.hash, "");
}

TEST(Verify, FramesThatAreNoFilesAreNamedAndTheOthersLookedAt) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  for (const char* name : {"frame-0000.png", "frame-0001.png", "frame-0002.png", "frame-0005.png"})
    fs::remove(folder / name);
  fs::create_symlink("frame-0000.png", folder / "frame-0000.png");
  ASSERT_EQ(mkfifo((folder / "frame-0001.png").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder / "frame-0002.png");
  fs::create_directory(folder / "frame-0005.png");
  const Verdict verdict = verify_folder(folder.path());
  ASSERT_EQ(verdict.troubles.size(), 4u);
  EXPECT_TRUE(document::holds(verdict.troubles[0].reason, "cannot be read: Too many levels"));
  EXPECT_EQ(verdict.troubles[1].reason, "is not a regular file");
  EXPECT_EQ(verdict.troubles[2].reason, "is not a regular file");
  EXPECT_EQ(verdict.troubles[3].reason, "is a directory, not a file");
}

TEST(Verify, AFrameOfWhichNothingIsRecordedDoesNotPass) {
  const test::TemporaryFolder folder;
  { const FrameFolder unfinished(folder.path(), of_frames({1})); }
  document::write_whole_file(folder / "frame-0001.png",
                             images::encode_picture(images::PictureFormat::png, 6, 4, std::vector<std::uint32_t>(24)));
  const Verdict verdict = verify_folder(folder.path());
  ASSERT_EQ(verdict.troubles.size(), 1u);
  EXPECT_TRUE(document::holds(verdict.troubles[0].reason, "its run ended before it recorded the pixels"));
}

TEST(Verify, RemovesWhatIsStillWrongAndNothingBesideARun) {
  const test::TemporaryFolder folder;
  fill(folder.path(), of_frames({1, 2}), 7);
  for (const char* name : {"frame-0001.png", "frame-0002.png"}) document::write_whole_file(folder / name, "torn");
  const Verdict verdict = verify_folder(folder.path());
  ASSERT_EQ(verdict.troubles.size(), 2u);
  {
    const FrameFolder running(folder.path(), of_frames({3}));
    EXPECT_TRUE(document::holds(document::failure_of([&] { remove_wrong_files(folder.path(), verdict); }),
                                "renders into this folder"));
    EXPECT_TRUE(fs::exists(folder / "frame-0001.png"));
  }
  fs::remove(folder / "frame-0002.png");
  fill(folder.path(), of_frames({2}), 7);
  remove_wrong_files(folder.path(), verdict);
  EXPECT_FALSE(fs::exists(folder / "frame-0001.png"));
  EXPECT_TRUE(fs::exists(folder / "frame-0002.png")) << "it has been rendered again";
}

TEST(Verify, ManifestsWithoutHashesAreReadToo) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  const std::string hash = verify_folder(folder.path()).hash;
  document::write_whole_file(
      folder / "frames.json",
      R"({"film":"a film.json","checksum":")" + std::string(32, 'a') +
          R"(","width":6,"height":4,"rate":24,"film_frames":12,"frames":[[0,2],[5,5],[11,11]]})");
  const Verdict verdict = verify_folder(folder.path());
  EXPECT_FALSE(verdict.compared);
  EXPECT_EQ(verdict.hash, hash);
  Manifest more = of_frames({1, 3});
  more.pixel_version = wire::kFirstPixelVersion;
  fill(folder.path(), more, 7);
  EXPECT_EQ(verify_folder(folder.path()).troubles.size(), 4u) << "where some have a hash, all must";
}

}  // namespace
}  // namespace mars::sinks
