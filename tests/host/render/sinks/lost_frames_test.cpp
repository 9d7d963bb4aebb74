// Frames that somebody removes while a run goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "host/content/film/frame_set.h"
#include "host/render/sinks/frame_folder.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
namespace {

namespace fs = std::filesystem;

// Of a run that renders `rendered` where the others of the small film are already.
void expect_lost(const std::vector<std::uint32_t>& rendered, const std::vector<std::uint32_t>& lost) {
  const test::TemporaryFolder folder;
  std::vector<std::uint32_t> there = small_manifest().frames;
  std::erase_if(there, [&](std::uint32_t frame) { return std::ranges::count(rendered, frame) > 0; });
  {
    FrameFolder before(folder.path(), of_frames(there));
    put_frames(before, of_frames(there), 7);
    before.finish();
  }
  FrameFolder frames(folder.path(), small_manifest());
  ASSERT_EQ(frames.frames(), rendered);
  put_frames(frames, of_frames(rendered), 7);
  for (const std::uint32_t frame : lost) fs::remove(folder / frame_file_name(small_manifest(), frame));
  try {
    frames.finish();
    ADD_FAILURE() << "the run does not miss its frames";
  } catch (const LostFrames& gone) {
    EXPECT_EQ(gone.frames, lost.size());
    EXPECT_EQ(gone.where, folder.path().string());
    EXPECT_EQ(gone.problem, "frames that were rendered are gone: " + film::FrameSet(lost).text());
  }
  EXPECT_EQ(missing_frames(folder.path(), read_manifest(folder.path()), small_manifest().frames), lost);
}

TEST(LostFrames, AreAFailureAtTheEnd) { expect_lost({0, 1, 2, 5}, {1}); }

TEST(LostFrames, AreAlsoThoseThatWereThereBefore) { expect_lost({2, 5}, {0, 2, 11}); }

TEST(LostFrames, WithTheFolderOfClaimsTheRunEnds) {
  const test::TemporaryFolder folder;
  FrameFolder frames(folder.path(), small_manifest());
  put_frames(frames, of_frames({0, 1}), 7);
  fs::remove_all(folder / std::string(kRunsName));
  EXPECT_TRUE(
      document::holds(document::failure_of([&] { put_frames(frames, of_frames({2}), 7); }),
                      "this run's claim to the folder is gone: another run took this one for ended, or somebody "
                      "removed it"));
}

}  // namespace
}  // namespace mars::sinks
