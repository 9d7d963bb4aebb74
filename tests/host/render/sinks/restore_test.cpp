#include "host/render/sinks/restore.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/images/png_file.h"
#include "host/render/sinks/frame_mark.h"
#include "host/render/sinks/record.h"
#include "host/render/sinks/verify.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
namespace {

namespace fs = std::filesystem;
using images::PictureFormat;

const fs::path kOlder = MARS_OLDER_FOLDERS;

// What can happen to a file: cut short, one bit flipped, another text, gone.
void spoil(const fs::path& file, int how) {
  std::string text = document::read_file(file);
  fs::remove(file);
  if (how == 0) text.resize(40);
  if (how == 1) text[text.find("pixel_hashes") + 2] ^= 1;
  if (how == 2) text = "{}";
  if (how < 3) document::write_whole_file(file, text);
}

TEST(Restore, AManifestWhoseBitsChangeIsNoticed) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  const std::string text = document::read_file(folder / kManifestName);
  const Manifest sound = *read_frames_json(folder.path());
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string changed = text;
    changed[at] ^= 1;
    try {
      EXPECT_EQ(manifest_of(parse_record(changed)), sound) << "byte " << at << " is between two values";
    } catch (const Failure&) {
    }
  }
}

TEST(Restore, ARunThatFinishesMendsTheManifest) {
  for (int how = 0; how < 4; ++how) {
    const test::TemporaryFolder folder;
    fill(folder.path(), of_frames({0, 1}), 7);
    std::string said;
    FrameFolder frames(folder.path(), of_frames({2, 5}), this_process(),
                       {.warn = [&](const std::string& line) { said += line; }});
    put_frames(frames, of_frames({2, 5}), 7);
    fill(folder.path(), of_frames({11}), 7);  // what this run does not know
    const Manifest whole = *read_frames_json(folder.path());
    spoil(folder / kManifestName, how);
    frames.finish();
    EXPECT_EQ(read_manifest(folder.path()).frames, small_manifest().frames) << how;
    EXPECT_TRUE(verify_folder(folder.path()).troubles.empty()) << how;
    EXPECT_TRUE(document::holds(said, "frames.json was lost or damaged")) << said;
    EXPECT_EQ(read_manifest(folder.path()).film, whole.film);
  }
}

TEST(Restore, ARunThatBeginsMendsTheManifestWhileAnotherGoesOn) {
  const test::TemporaryFolder folder;
  fill(folder.path(), of_frames({0}), 7);
  FrameFolder other(folder.path(), of_frames({1, 2}));
  put_frames(other, of_frames({1}), 7);
  spoil(folder / kManifestName, 0);
  fill(folder.path(), of_frames({5}), 7);
  EXPECT_EQ(read_manifest(folder.path()).frames, (std::vector<std::uint32_t>{0, 1, 2, 5}));
  put_frames(other, of_frames({2}), 7);
  other.finish();
  EXPECT_TRUE(verify_folder(folder.path()).troubles.empty());
}

TEST(Restore, WhatAKilledRunLeftIsAddedToAManifestThatIsLost) {
  const test::TemporaryFolder folder;
  fill(folder.path(), of_frames({0, 1}), 7);
  ProcessName ended = this_process();
  ended.number = 0x3fffffff;  // no process has it
  auto frames = std::make_unique<FrameFolder>(folder.path(), of_frames({2}), ended);
  put_frames(*frames, of_frames({2}), 7);
  for (int how = 0; how < 3; ++how) {
    spoil(folder / kManifestName, how);
    const auto next = static_cast<std::uint32_t>(3 + how);
    fill(folder.path(), of_frames({next}), 7);
    EXPECT_EQ(read_manifest(folder.path()).frames.size(), next + 1);
  }
  EXPECT_TRUE(verify_folder(folder.path()).troubles.empty());
  EXPECT_ANY_THROW(frames->finish()) << "its claim is gone";
}

// film.mars is lost too: the frames alone say it.
TEST(Restore, RepairGivesTheSameHashInEveryFormat) {
  for (const PictureFormat format : {PictureFormat::png, PictureFormat::png16, PictureFormat::exr,
                                     PictureFormat::png_alpha, PictureFormat::png16_alpha, PictureFormat::exr_alpha}) {
    const test::TemporaryFolder folder;
    fill(folder.path(), in_format(format), 0x2030);
    const std::string hash = verify_folder(folder.path()).hash;
    EXPECT_EQ(repair_manifest(folder.path()), "") << "it is sound";
    for (int how = 0; how < 4; ++how) {
      spoil(folder / kManifestName, how);
      EXPECT_TRUE(document::holds(repair_manifest(folder.path()), "made again from what runs and the frames say: 5"));
      EXPECT_EQ(verify_folder(folder.path()).hash, hash);
      EXPECT_EQ(read_manifest(folder.path()).format, format);
      EXPECT_EQ(read_manifest(folder.path()).checksum, small_manifest().checksum);
    }
    EXPECT_EQ(folder.entries(), 6u);
  }
}

// Programs that compose frames would put them elsewhere, and show them in another shape.
TEST(Restore, RepairFindsWhichPartOfThePictureFramesAre) {
  const test::TemporaryFolder folder;
  Manifest manifest = in_format(PictureFormat::exr);
  manifest.place = {{-3, 1, 40, 30}, 2};
  fill(folder.path(), manifest, 7);
  fs::remove(folder / kManifestName);
  repair_manifest(folder.path());
  EXPECT_EQ(read_manifest(folder.path()).place, manifest.place);
}

// One that knows no layers would mix frames with and without.
TEST(Restore, AManifestHasNoPixelsOfImpossibleShape) {
  for (const double aspect : {1e300, 17.0, 0.05}) {
    nlohmann::json text = to_json(small_manifest());
    text["pixel_aspect"] = aspect;
    text["sum"] = sum_of(text);
    EXPECT_TRUE(document::holds(document::failure_of([&] { manifest_of(text); }), "pixel_aspect")) << aspect;
  }
}

TEST(Restore, RepairFindsFramesOfEveryName) {
  for (const images::FrameNames& names : {images::FrameNames{"shot_##_a", 1001}, {"", 7}}) {
    Manifest manifest = in_format(PictureFormat::exr);
    manifest.names = names;
    manifest.compression = images::Compression::piz;
    const test::TemporaryFolder folder;
    fill(folder.path(), manifest, 0x2030);
    document::write_whole_file(folder / "texture.png", std::string_view("of somebody else"));
    const test::TemporaryFolder another;
    fill(another.path(), in_format(PictureFormat::png), 7);
    fs::copy_file(another / "frame-0005.png", folder / "best.png");
    const std::string hash = verify_folder(folder.path()).hash;
    EXPECT_NE(hash, "");
    for (int how = 0; how < 4; ++how) {
      spoil(folder / kManifestName, how);
      repair_manifest(folder.path());
      EXPECT_EQ(verify_folder(folder.path()).hash, hash);
      EXPECT_EQ(form_of(read_manifest(folder.path())), form_of(manifest));
      EXPECT_EQ(read_manifest(folder.path()).frames, manifest.frames);
    }
  }
}

TEST(Restore, FilesSayWhichFrameTheyAre) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  fs::copy_file(folder / "frame-0000.png", folder / "frame-0001.png", fs::copy_options::overwrite_existing);
  fs::copy_file(folder / "frame-0000.png", folder / "frame-0003.png");
  spoil(folder / kManifestName, 3);
  repair_manifest(folder.path());
  const Manifest restored = read_manifest(folder.path());
  EXPECT_EQ(restored.frames, (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 11}));
  for (const std::uint32_t other : {1u, 3u}) EXPECT_EQ(hash_of(restored, other), "") << "it is to be rendered again";
  FrameMark mark = *read_mark(folder / "frame-0005.png");
  EXPECT_EQ(mark.pixel_hash, hash_of(read_manifest(folder.path()), 5));
  mark.pixel_version = 7;
  EXPECT_EQ(mark_of(text_of(mark)), mark);
}

// A repair does not call a folder whole where such files are.
TEST(Restore, FilesThatAreEmptyAreToBeRenderedAgain) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  fs::resize_file(folder / "frame-0002.png", 0);
  spoil(folder / kManifestName, 3);
  EXPECT_TRUE(document::holds(repair_manifest(folder.path()), "of which 1 are of another film, or empty"));
  const Verdict verdict = verify_folder(folder.path());
  ASSERT_EQ(verdict.troubles.size(), 1u);
  EXPECT_EQ(verdict.troubles[0].frame, 2u);
  EXPECT_EQ(verdict.film_frames, small_manifest().film_frames);
}

TEST(Restore, FramesOfTwoFilmsAreNotTakenForOnes) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  Manifest other = of_frames({1});
  other.checksum = std::string(32, 'b');
  fill(folder / "other", other, 7);
  fs::rename(folder / "other/frame-0001.png", folder / "frame-0001.png");
  spoil(folder / kManifestName, 0);
  EXPECT_TRUE(document::holds(document::failure_of([&] { repair_manifest(folder.path()); }),
                              "neither film.mars nor the frames say of which film these are (remove it, and render"));
}

TEST(Restore, WhereARunRendersNothingIsRepaired) {
  const test::TemporaryFolder folder;
  const FrameFolder running(folder.path(), small_manifest());
  spoil(folder / kManifestName, 0);
  EXPECT_TRUE(
      document::holds(document::failure_of([&] { repair_manifest(folder.path()); }), "renders into this folder"));
}

TEST(Restore, FoldersOfOlderVersionsAreRead) {
  for (const char* name : {"version-1", "first"}) {
    const Verdict verdict = verify_folder(kOlder / name);
    EXPECT_EQ(verdict.expected, 2u);
    EXPECT_EQ(verdict.hash, "1f408bf4613c7cd1302730c79ef905c6") << name;
    EXPECT_EQ(read_manifest(kOlder / name).pixel_version, wire::kFirstPixelVersion);
    EXPECT_EQ(read_mark(kOlder / name / "frame-0000.png"), std::nullopt);
  }
  EXPECT_EQ(read_manifest(kOlder / "version-1").sources.size(), 1u);
}

// Its frames' hashes are over all pixels at once, and stay so beside those of bands.
TEST(Restore, FramesOfVersion2StayWithTheirHashes) {
  const test::TemporaryFolder folder;
  fs::copy(kOlder / "version-2", folder / "out");
  const Verdict before = verify_folder(folder / "out");
  EXPECT_EQ(before.troubles.size(), 0u);
  EXPECT_TRUE(before.compared);
  Manifest more = read_manifest(folder / "out");
  const std::vector<std::string> hashes = more.pixel_hashes;
  more.frames = {2};
  more.pixel_hashes.clear();
  fill(folder / "out", more, 7);
  const Manifest all = read_manifest(folder / "out");
  ASSERT_EQ(all.pixel_hashes.size(), 3u);
  EXPECT_EQ(all.pixel_hashes[0], hashes[0]);
  EXPECT_EQ(all.pixel_hashes[2].size(), hashes[0].size() + 1);
  EXPECT_EQ(verify_folder(folder / "out").troubles.size(), 0u);
  EXPECT_EQ(read_mark(folder / "out/frame-0001.png")->pixel_hash, hashes[1]);
  spoil(folder / "out/frames.json", 0);
  EXPECT_NE(repair_manifest(folder / "out"), "");
  EXPECT_EQ(read_manifest(folder / "out").pixel_hashes, all.pixel_hashes);
}

// No run may decide of which film they are.
TEST(Restore, FramesThatSayNothingAreLeftAlone) {
  const test::TemporaryFolder folder;
  fs::copy(kOlder / "version-1", folder / "out");
  spoil(folder / "out/frames.json", 0);
  const std::string failure = document::failure_of([&] { FrameFolder(folder / "out", small_manifest()); });
  EXPECT_TRUE(document::holds(failure, "frames.json: not a manifest of frames")) << failure;
  EXPECT_TRUE(document::holds(failure, "(mars verify --repair ")) << failure;
  EXPECT_TRUE(document::holds(document::failure_of([&] { repair_manifest(folder / "out"); }), "neither film.mars nor"));
}

TEST(Restore, KeysOfLaterProgramsAreKept) {
  const test::TemporaryFolder folder;
  Manifest manifest = small_manifest();
  manifest.more = R"({"lenses":["beauty",3]})";
  fill(folder.path(), manifest, 7);
  manifest.more.clear();
  manifest.frames = {3};
  fill(folder.path(), manifest, 7);
  const auto text = nlohmann::json::parse(document::read_file(folder / kManifestName));
  EXPECT_EQ(text.at("lenses"), nlohmann::json::parse(R"(["beauty",3])"));
  EXPECT_EQ(text.at("version"), 3) << "older programs can go on there";
  Manifest part = manifest_of(text);
  part.place = {{-8, 4, 64, 36}, 1.5f};
  part.view = {"/show/config.ocio", "screen", "Film", "scene_linear", std::string(32, 'a')};
  EXPECT_EQ(to_json(part).at("version"), 5);
  EXPECT_EQ(manifest_of(to_json(part)), part);
  EXPECT_EQ(text.at("pixel_version"), wire::kPixelVersion);
}

TEST(Restore, LayersAreOfExrFilesAndOfThisVersion) {
  Manifest layered = small_manifest();
  layered.format = images::PictureFormat::exr;
  layered.layers = wire::set_of(wire::Layer::depth);
  EXPECT_EQ(to_json(layered).at("version"), 5) << "an older program would add frames without layers";
  EXPECT_EQ(manifest_of(to_json(layered)), layered);
  layered.format = images::PictureFormat::png;
  EXPECT_NE(document::failure_of([&] { manifest_of(to_json(layered)); }), "");
}

TEST(Restore, ALaterVersionIsRefusedAndNotMended) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  auto text = nlohmann::json::parse(document::read_file(folder / kManifestName));
  text["version"] = kManifestVersion + 1;
  document::write_whole_file(folder / kManifestName, text.dump());
  for (const std::string& failure : {document::failure_of([&] { verify_folder(folder.path()); }),
                                     document::failure_of([&] { repair_manifest(folder.path()); }),
                                     document::failure_of([&] { FrameFolder(folder.path(), of_frames({3})); })})
    EXPECT_TRUE(
        document::holds(failure, "it has version 6 and this MARS knows manifests up to version 5 (use the MARS"))
        << failure;
  EXPECT_EQ(document::read_file(folder / kManifestName), text.dump());
}

TEST(Restore, FramesOfAnotherPixelVersionAreOfAnotherFolder) {
  const test::TemporaryFolder folder;
  Manifest before = of_frames({0, 1});
  before.pixel_version = wire::kFirstPixelVersion;
  fill(folder.path(), before, 7);
  EXPECT_EQ(FrameFolder(folder.path(), before).frames().size(), 0u);
  EXPECT_EQ(FrameFolder(folder.path(), of_frames({0, 1})).frames().size(), 2u) << "none of them counts";
}

}  // namespace
}  // namespace mars::sinks
