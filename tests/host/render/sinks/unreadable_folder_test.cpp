// Folders of frames whose manifest or runs cannot be read: the failure names the file at once, and nothing changes.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <filesystem>
#include <iterator>
#include <string>

#include "host/content/document/whole_file.h"
#include "host/render/sinks/frame_folder.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
namespace {

namespace fs = std::filesystem;

// Whoever reads waits for none, and reads no device to its end, which never comes.
TEST(UnreadableFolder, WhatIsNoFileIsNamedAtOnceAndChangesNothing) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  const fs::path manifest = folder / "frames.json";
  fs::rename(manifest, folder / "kept");
  const auto refused = [&](const char* reason) {
    const std::string failure = failure_to_claim(folder.path(), of_frames({3}));
    EXPECT_TRUE(document::holds(failure, manifest.string() + ": " + reason)) << failure;
    EXPECT_EQ(document::failure_of([&] { read_manifest(folder.path()); }), failure);
    EXPECT_TRUE(fs::exists(fs::symlink_status(manifest)));
    fs::remove(manifest);
  };
  ASSERT_EQ(mkfifo(manifest.c_str(), 0600), 0);
  refused("is not a regular file");
  fs::create_symlink("/dev/zero", manifest);
  refused("is not a regular file");
  fs::create_directory(manifest);
  refused("is not a regular file (remove it; mars verify --repair ");
  fs::create_symlink("frames.json", manifest);
  refused("is not a regular file");
  document::write_whole_file(manifest, "");
  fs::resize_file(manifest, std::uintmax_t{1} << 40);
  refused("has 1099511627776 bytes, too many");
  EXPECT_EQ(folder.entries(), 6u);
}

TEST(UnreadableFolder, WhatIsNoFileAmongTheRunsIsNamedAtOnce) {
  for (const char* ending : {"claim", "turn", "hashes", "waits"}) {
    const test::TemporaryFolder folder;
    fill(folder.path(), small_manifest(), 7);
    fs::create_directory(folder / ".runs");
    const fs::path file = folder / (std::string(".runs/vm-1-abc.") + ending);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    const std::string says =
        file.string() + ": is not a regular file, but runs write only regular files there (remove it)";
    EXPECT_EQ(failure_to_claim(folder.path(), of_frames({3})), says);
    EXPECT_EQ(document::failure_of([&] { read_manifest(folder.path()); }), says);
    clear_ended_runs(folder.path());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / ".runs"), {}), 1) << "what was begun is gone again";
    fs::remove(file);
    fs::create_symlink("/dev/zero", file);
    EXPECT_EQ(failure_to_claim(folder.path(), of_frames({3})), says);
  }
}

TEST(UnreadableFolder, AManifestThatCannotBeReadIsNotReplaced) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  fs::permissions(folder / "frames.json", fs::perms::none);
  as_nobody(folder.path(), [&] {
    return document::holds(failure_to_claim(folder.path(), of_frames({3})),
                           "frames.json: cannot be read: Permission denied (check its permissions)");
  });
  EXPECT_EQ(read_manifest(folder.path()).frames, small_manifest().frames);
  EXPECT_EQ(folder.entries(), 6u);
}

TEST(UnreadableFolder, RivalsThatCannotBeListedAreAnError) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  fs::create_directory(folder / ".runs");
  fs::permissions(folder / ".runs", fs::perms::owner_write | fs::perms::owner_exec);
  as_nobody(folder.path(), [&] {
    const char* says = ".runs: cannot be listed, so other runs in this folder are unknown";
    return document::holds(failure_to_claim(folder.path(), of_frames({3})), says) &&
           document::holds(document::failure_of([&] { read_manifest(folder.path()); }), says);
  });
}

}  // namespace
}  // namespace mars::sinks
