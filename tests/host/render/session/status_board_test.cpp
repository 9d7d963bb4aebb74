#include "host/render/session/status_board.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace mars::session {
namespace {

events::Booted three_nodes() { return {"mpi", 2, {{0, "n1", 1, "", ""}, {1, "n2", 2, "", ""}, {2, "n1", 3, "", ""}}}; }

TEST(StatusBoard, HasTheNodesByMachine) {
  StatusBoard board("film.json");
  board.note(three_nodes());
  const sinks::Status status = board.status();
  EXPECT_EQ(status.film, "film.json");
  EXPECT_EQ(status.process, sinks::this_process());
  ASSERT_EQ(status.machines.size(), 2u);
  EXPECT_EQ(status.machines[0].name, "n1");
  ASSERT_EQ(status.machines[0].nodes.size(), 2u);
  EXPECT_EQ(status.machines[0].nodes[1].node, 2);
}

TEST(StatusBoard, CountsAProcessorForTheHostAndEachNode) {
  using Clock = std::chrono::steady_clock;
  const auto before = Clock::now();
  StatusBoard board("film.json");
  EXPECT_EQ(board.status().used, sinks::Usage());
  board.note(three_nodes());
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const double used = board.status().used.processor_seconds;
  EXPECT_GE(used, 4 * 0.02);
  EXPECT_LE(used, 4 * std::chrono::duration<double>(Clock::now() - before).count());
}

TEST(StatusBoard, CountsTheFramesOfEachNode) {
  StatusBoard board("film.json");
  board.note(three_nodes());
  board.note_drawn(
      {.number = 0, .interval = 0, .kind = wire::FrameKind::keyframe, .seconds = 1, .first_node = 0, .nodes = 3});
  board.note_drawn(
      {.number = 1, .interval = 0, .kind = wire::FrameKind::inbetween, .seconds = 2, .first_node = 2, .nodes = 1});
  const sinks::Status status = board.status();
  EXPECT_EQ(status.machines[0].nodes[0].frames, 1u);
  EXPECT_EQ(status.machines[0].nodes[1].frames, 2u);
  EXPECT_EQ(status.machines[1].nodes[0].frames, 1u);
}

TEST(StatusBoard, KnowsProgressSilenceAndTheLastWarnings) {
  StatusBoard board("film.json");
  board.note(three_nodes());
  events::Progress progress;
  progress.keyframes = {1, 2, 3.0};
  progress.inbetweens = {9, 20, 4.5};
  board.note(progress);
  board.note(events::Beat{"rendering", {{1, "n2", 7, "scanline", 12.5}}});
  for (const char* text : {"a", "b", "c", "d"}) board.note(events::Warning{text});
  sinks::Status status = board.status();
  EXPECT_EQ(status.done, 10u);
  EXPECT_EQ(status.of, 22u);
  EXPECT_EQ(status.seconds, 7.5);
  EXPECT_TRUE(status.left.has_value());
  EXPECT_EQ(status.doing, "rendering");
  EXPECT_EQ(status.machines[1].nodes[0].silent, 12.5);
  EXPECT_EQ(status.machines[1].nodes[0].doing, "scanline");
  EXPECT_EQ(status.warnings, (std::vector<std::string>{"b", "c", "d"}));
  board.note(events::Beat{"rendering", {}});
  EXPECT_EQ(board.status().machines[1].nodes[0].silent, 0);
}

}  // namespace
}  // namespace mars::session
