#include "host/sinks/frame_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host/sinks/png_file.h"
#include "host/sinks/verify.h"
#include "host/document/whole_file.h"
#include "tests/host/document/failure_of.h"
#include "tests/host/sinks/temporary_folder.h"

namespace mars::host {
namespace {

Manifest small_manifest() { return {"a film.json", std::string(32, 'a'), 6, 4, 24, 12, {0, 1, 2, 5, 11}}; }

// A folder with all its frames, each of one colour.
void fill(const FrameFolder& folder, const Manifest& manifest, std::uint32_t color) {
  PngSink sink(folder);
  Frame frame(manifest.width, manifest.height, 16);
  for (const std::uint32_t number : manifest.frames) {
    frame.number = number;
    std::fill(frame.pixels.begin(), frame.pixels.end(), color + number);
    sink.take(frame);
  }
}

TEST(FrameFolder, NamesSortAsFramesDo) {
  EXPECT_EQ(frame_file_name(0, 1), "frame-0000.png");
  EXPECT_EQ(frame_file_name(9999, 10000), "frame-9999.png");
  EXPECT_EQ(frame_file_name(7, 10001), "frame-00007.png");
  EXPECT_EQ(frame_file_name(4294967294, 4294967295), "frame-4294967294.png");
}

TEST(FrameFolder, IsMadeWithItsManifest) {
  const TemporaryFolder folder;
  const Manifest manifest = small_manifest();
  const FrameFolder frames(folder / "a/b", manifest);
  EXPECT_EQ(read_manifest(folder / "a/b"), manifest);
  EXPECT_EQ(frames.file_of(3), folder / "a/b/frame-0003.png");
}

TEST(FrameFolder, ManifestsKeepNamesThatAreNoText) {
  const TemporaryFolder folder;
  Manifest manifest = small_manifest();
  manifest.film = "\xff.json";
  const FrameFolder frames(folder.path(), manifest);
  EXPECT_EQ(read_manifest(folder.path()).frames, manifest.frames);
}

TEST(FrameFolder, ClearsAwayWhatAKilledRunLeft) {
  const TemporaryFolder folder;
  write_whole_file(folder / "frame-0001.png.part", "x");
  write_whole_file(folder / "a person's own.part", "x");
  const FrameFolder frames(folder.path(), small_manifest());
  EXPECT_FALSE(std::filesystem::exists(folder / "frame-0001.png.part"));
  EXPECT_TRUE(std::filesystem::exists(folder / "a person's own.part"));
}

TEST(FrameFolder, AnotherFilmsFramesDoNotPassAsThisOnes) {
  const TemporaryFolder folder;
  Manifest manifest = small_manifest();
  fill(FrameFolder(folder / "f", manifest), manifest, 7);
  const FrameFolder again(folder / "f", manifest);
  EXPECT_TRUE(std::filesystem::exists(again.file_of(5))) << "the same film's frames stay";
  manifest.checksum = std::string(32, 'b');
  manifest.frames = {1, 5};
  const FrameFolder other(folder / "f", manifest);
  EXPECT_FALSE(std::filesystem::exists(other.file_of(5)));
  EXPECT_TRUE(std::filesystem::exists(other.file_of(2))) << "what was not asked for is left alone";
}

TEST(FrameFolder, FramesOfTheSameFilmAreAdded) {
  const TemporaryFolder folder;
  Manifest manifest = small_manifest();
  manifest.frames = {1, 2, 5};
  fill(FrameFolder(folder / "f", manifest), manifest, 7);
  manifest.frames = {2, 3};
  fill(FrameFolder(folder / "f", manifest), manifest, 7);
  EXPECT_EQ(read_manifest(folder / "f").frames, (std::vector<std::uint32_t>{1, 2, 3, 5}));
  EXPECT_TRUE(verify_folder(folder / "f").troubles.empty());
  manifest.checksum = std::string(32, 'b');
  const FrameFolder other(folder / "f", manifest);
  EXPECT_EQ(read_manifest(folder / "f").frames, manifest.frames);
}

TEST(FrameFolder, TellsWhereItCannotBe) {
  const TemporaryFolder folder;
  write_whole_file(folder / "file", "x");
  const auto failure = [&](const std::string& name) {
    return failure_of([&] { FrameFolder(folder / name, small_manifest()); });
  };
  EXPECT_TRUE(holds(failure("file"), "cannot create the folder")) << failure("file");
  EXPECT_TRUE(holds(failure("file/below"), "cannot create the folder")) << failure("file/below");
}

TEST(FrameFolder, WrongManifestsAreTold) {
  const TemporaryFolder folder;
  EXPECT_TRUE(holds(failure_of([&] { read_manifest(folder.path()); }), "it has no frames.json"));
  for (const char* text : {"", "{", "[]", "{\"film\": 3}", "\xff", "null"}) {
    write_whole_file(folder / "frames.json", text);
    EXPECT_TRUE(holds(failure_of([&] { read_manifest(folder.path()); }), "frames.json: not a manifest"))
        << text;
  }
  const std::string head =
      R"({"film":"x","checksum":"x","width":1,"height":1,"rate":24,"film_frames":4,"frames":)";
  for (const char* frames : {"[[0,4]]", "[[-1,2]]", "[[0]]", "[3]", "7", "[[0,1e300]]"}) {
    write_whole_file(folder / "frames.json", head + frames + "}");
    EXPECT_TRUE(holds(failure_of([&] { read_manifest(folder.path()); }), "not a manifest")) << frames;
  }
}

TEST(Verify, OneHashForEqualFrames) {
  const TemporaryFolder folder;
  const Manifest manifest = small_manifest();
  std::vector<std::string> hashes;
  for (const auto& [name, color] : {std::pair{"a", 0x102030u}, {"b", 0x102030u}, {"c", 0x102031u}}) {
    const FrameFolder frames(folder / name, manifest);
    fill(frames, manifest, color);
    const Verdict verdict = verify_folder(folder / name);
    EXPECT_EQ(verdict.expected, 5u);
    EXPECT_TRUE(verdict.troubles.empty());
    hashes.push_back(verdict.hash);
  }
  EXPECT_EQ(hashes[0].size(), 32u);
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_NE(hashes[0], hashes[2]);
}

TEST(Verify, TellsEveryFrameThatIsNotAsItShouldBe) {
  const TemporaryFolder folder;
  const Manifest manifest = small_manifest();
  const FrameFolder frames(folder.path(), manifest);
  fill(frames, manifest, 0);
  std::filesystem::remove(frames.file_of(1));
  std::filesystem::resize_file(frames.file_of(2), 40);
  write_whole_file(frames.file_of(5), encode_png(2, 3, std::vector<std::uint32_t>(6)));
  const Verdict verdict = verify_folder(folder.path());
  ASSERT_EQ(verdict.troubles.size(), 3u);
  EXPECT_EQ(verdict.troubles[0].frame, 1u);
  EXPECT_EQ(verdict.troubles[0].reason, "missing");
  EXPECT_EQ(verdict.troubles[1].frame, 2u);
  EXPECT_TRUE(holds(verdict.troubles[1].reason, "not a whole PNG"));
  EXPECT_EQ(verdict.troubles[2].reason, "2x3 pixels instead of 6x4");
  EXPECT_EQ(verdict.hash, "");
}

}  // namespace
}  // namespace mars::host
