#include "host/shell/batch/folder_state.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "host/shell/batch/state_text.h"
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
  state.jobs = {{"7", "running", "0:05", 1, "n[1-2]", ""}};
  state.used = {4500, 12'300'000, 2};
  return state;
}

TEST(FolderState, HasALineForTheFolderEachJobAndEachRun) {
  EXPECT_EQ(lines_of(some_state(), false),
            (Lines{"out: 20 of 50 frames of a film.json", "job 7: running on n[1-2] for 0:05, 1 restart",
                   "run on n1 (process 12): frame 10 of 40, 2.0 frames/s, 1:01 left"}));
}

TEST(FolderState, NamesNodesThatAreSilentOrSlow) {
  const Lines lines = lines_of(some_state(), true);
  EXPECT_EQ(lines[1], "used: 1.25 processor hours, 12.3 MB written, 2 restarts");
  EXPECT_EQ(Lines(lines.begin() + 4, lines.end()),
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

TEST(FolderState, IsAlsoThereForPrograms) {
  const auto json = nlohmann::json::parse(json_of(some_state()));
  EXPECT_EQ(json["state"], "rendering");
  EXPECT_EQ(json["frames"], (nlohmann::json{{"done", 20}, {"of", 50}}));
  EXPECT_EQ(json["usage"], (nlohmann::json{{"processor_hours", 1.25}, {"bytes", 12300000}, {"restarts", 2}}));
  EXPECT_EQ(json["jobs"][0]["machines"], "n[1-2]");
  EXPECT_EQ(json["runs"][0]["seconds_left"], 61);
  EXPECT_EQ(comment_of(some_state()), "mars: 20 of 50 frames, 1.25 processor hours, 12.3 MB written, 2 restarts\n");
  EXPECT_EQ(comment_of({}), "mars: 0 of 0 frames\n");
  EXPECT_EQ(text_of(sinks::Usage{90, 2'500'000'000, 0}), "90.0 processor seconds, 2.5 GB written, 0 restarts");
}

TEST(FolderState, SaysForProgramsWhetherItGoesOn) {
  const auto word = [](const FolderState& state) { return nlohmann::json::parse(json_of(state))["state"]; };
  FolderState state = some_state();
  state.runs.clear();
  EXPECT_EQ(word(state), "waiting");
  state.jobs.clear();
  EXPECT_EQ(word(state), "incomplete");
  state.no_jobs = "squeue failed";
  EXPECT_EQ(word(state), "unknown");
  state.there = state.of;
  EXPECT_EQ(word(state), "complete");
}

TEST(FolderState, HasMetricsOfOneGrammar) {
  FolderState state = some_state();
  state.folder = "/a \"b\"";
  const std::string text = metrics_of(state);
  EXPECT_TRUE(document::holds(text, "# TYPE mars_frames_done gauge\nmars_frames_done{folder=\"/a \\\"b\\\"\"} 20\n"));
  EXPECT_TRUE(document::holds(text, "\"} 12300000\n"));
  state.folder = "/\xff";
  EXPECT_TRUE(document::holds(metrics_of(state), "{folder=\"/\xEF\xBF\xBD\"}"));
  EXPECT_TRUE(text.ends_with("} 2\n# EOF\n"));
  std::istringstream lines(text);
  const std::regex sample(R"re(mars_[a-z_]+\{folder=".*"\} [0-9.e+-]+)re"), comment("# (HELP|TYPE|EOF).*");
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(std::regex_match(line, line.starts_with('#') ? comment : sample)) << line;
}

TEST(FolderState, CountsWhatAllRunsHaveUsed) {
  const test::TemporaryFolder folder;
  const auto run = [&](const std::vector<std::uint32_t>& drawn) {
    sinks::FrameFolder frames(folder.path(), sinks::small_manifest());
    sinks::Status status;
    status.process = sinks::this_process();
    status.used.processor_seconds = 10;
    frames.show_status([status] { return status; });
    sinks::put_frames(frames, sinks::of_frames(drawn), 7);
  };
  run({0, 1});
  const sinks::Usage first = look_at(folder.path()).used;
  EXPECT_EQ(first.processor_seconds, 10);
  EXPECT_EQ(first.restarts, 1u);
  EXPECT_GT(first.bytes, 100u);
  run({2, 5, 11});
  const sinks::Usage both = look_at(folder.path()).used;
  EXPECT_EQ(both.processor_seconds, 20);
  EXPECT_EQ(both.restarts, 1u);
  EXPECT_GT(both.bytes, first.bytes);
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
