#include "host/shell/batch/folder_state.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/temporary_folder.h"

namespace mars::batch {
namespace {

using Lines = std::vector<std::string>;

sinks::Status some_status() {
  sinks::Status status;
  status.film = "a film.json";
  status.done = 10;
  status.of = 40;
  status.seconds = 5;
  status.left = 61;
  status.machines = {{"n1", {{.node = 0, .frames = 4, .doing = ""}, {.node = 1, .frames = 6, .doing = ""}}},
                     {"n2",
                      {{.node = 2, .frames = 3, .silent = 12, .frame = 7, .doing = "scanline"},
                       {.node = 3, .frames = 1, .doing = "", .slow = 2.5}}}};
  status.warnings = {"a warning"};
  return status;
}

FolderState some_state() {
  FolderState state;
  state.folder = "out";
  state.film = "a film.json";
  state.there = 20;
  state.of = 50;
  sinks::Claim claim;
  claim.process.host = "n1";
  claim.process.number = 12;
  state.runs = {{claim, false, 1, some_status()}};
  state.jobs = {{"7", "RUNNING", "0:05", 1, "n[1-2]", "None"}};
  return state;
}

TEST(FolderState, HasALineForTheFolderEachJobAndEachRun) {
  EXPECT_EQ(lines_of(some_state(), false),
            (Lines{"out: 20 of 50 frames of a film.json", "job 7: running on n[1-2] for 0:05, 1 restart",
                   "run on n1 (process 12): frame 10 of 40, 2.0 frames/s, 1:01 left"}));
}

TEST(FolderState, NamesNodesThatAreSilentOrSlow) {
  const Lines lines = lines_of(some_state(), true);
  EXPECT_EQ(Lines(lines.begin() + 3, lines.end()),
            (Lines{"  n1  2 nodes, 10 frames",
                   "  n2  2 nodes, 4 frames; node 2 silent for 12 s, in scanline of frame 7; node 3 takes 2.5 times as "
                   "long",
                   "  warning: a warning"}));
}

TEST(FolderState, SaysWhatIsUnknown) {
  FolderState state = some_state();
  state.runs.front().ended = true;
  state.no_jobs = "squeue failed: timed out";
  const Lines lines = lines_of(state, false);
  EXPECT_EQ(lines[2], "jobs are unknown: squeue failed: timed out");
  EXPECT_EQ(lines[3], "run on n1 (process 12): has ended before its last frame");
}

TEST(FolderState, TakesARunThatSaysNothingForLost) {
  FolderState state = some_state();
  state.jobs.clear();
  EXPECT_TRUE(state.active());
  state.runs.front().silent = 20;
  EXPECT_TRUE(state.active());
  EXPECT_TRUE(document::holds(lines_of(state, false).back(), " left; has said nothing for 0:20"));
  state.runs.front().silent = 90;
  EXPECT_FALSE(state.active());
}

TEST(FolderState, IsOfWhatIsInTheFolder) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(document::holds(document::failure_of([&] { look_at(folder.path()); }), "no folder of frames"));
  {
    sinks::FrameFolder frames(folder.path(), sinks::small_manifest());
    sinks::put_frames(frames, sinks::of_frames({0, 1}), 7);
    const FolderState state = look_at(folder.path());
    EXPECT_EQ(state.there, 2u);
    EXPECT_EQ(state.of, 5u);
    ASSERT_EQ(state.runs.size(), 1u);
    EXPECT_FALSE(state.runs.front().ended);
    EXPECT_TRUE(state.active());
  }
  EXPECT_FALSE(look_at(folder.path()).active());
  EXPECT_FALSE(look_at(folder.path()).complete());
  sinks::fill(folder.path(), sinks::small_manifest(), 7);
  EXPECT_TRUE(look_at(folder.path()).complete());
}

}  // namespace
}  // namespace mars::batch
