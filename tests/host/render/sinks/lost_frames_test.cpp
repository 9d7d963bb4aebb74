// Frames that somebody removes while a run goes on.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "host/render/sinks/frame_folder.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/host/render/sinks/temporary_folder.h"

namespace mars::sinks {
namespace {

namespace fs = std::filesystem;

TEST(LostFrames, AreAFailureAtTheEnd) {
  const TemporaryFolder folder;
  FrameFolder frames(folder.path(), small_manifest());
  put_frames(frames, small_manifest(), 7);
  const std::uint32_t lost = small_manifest().frames[1];
  fs::remove(folder / frame_file_name(small_manifest(), lost));
  try {
    frames.finish();
    ADD_FAILURE() << "the run does not miss frame " << lost;
  } catch (const LostFrames& gone) {
    EXPECT_EQ(gone.frames, 1u);
    EXPECT_EQ(gone.where, folder.path().string());
    EXPECT_EQ(gone.problem, "frames that were rendered are gone: " + std::to_string(lost));
  }
  EXPECT_EQ(missing_frames(folder.path(), read_manifest(folder.path()), small_manifest().frames),
            std::vector<std::uint32_t>{lost});
}

}  // namespace
}  // namespace mars::sinks
