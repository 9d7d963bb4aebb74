#include "host/render/report/replay.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mars::report {
namespace {

using walls::Wall;

wire::Strip strip(wire::FrameKind kind, std::uint32_t frame, std::int32_t node, const wire::PhaseTimes& times) {
  wire::Strip strip{};
  strip.kind = kind;
  strip.frame = frame;
  strip.node = node;
  strip.last = 1;
  strip.times = times;
  strip.work.bytes_to_host = 1000;
  return strip;
}

// Two nodes draw a keyframe, of which node 0 does more, and one an inbetween.
//
//          dice       sum   scanline    depth  inbetween
//   node 0 0 to 3     to 4  to 8        to 9   to 14
//   node 1 0 to 1     to 4  to 5
farm::FarmReport two_frames() {
  farm::FarmReport report;
  report.nodes.resize(2);
  report.groups = {{0, 2}};
  wire::PhaseTimes first{}, second{}, inbetween{};
  first.dice = 3, first.sum = 1, first.scanline = 4, first.depth = 1;
  second.dice = 1, second.sum = 3, second.scanline = 1;
  inbetween.scanline = 5;
  report.strips = {strip(wire::FrameKind::keyframe, 0, 1, second), strip(wire::FrameKind::keyframe, 0, 0, first),
                   strip(wire::FrameKind::inbetween, 1, 0, inbetween)};
  report.total_seconds = 14;
  return report;
}

TEST(Replay, TakesAsLongAsTheRun) {
  const farm::FarmReport report = two_frames();
  EXPECT_DOUBLE_EQ(Replay(report).seconds({}), 14);
}

TEST(Replay, LeavesOutMessagesAndKeepsWaiting) {
  const farm::FarmReport report = two_frames();
  const Replay replay(report);
  EXPECT_DOUBLE_EQ(replay.seconds({Wall::sum}), 13);
  EXPECT_DOUBLE_EQ(replay.seconds({Wall::still}), 13);
  EXPECT_DOUBLE_EQ(replay.seconds({Wall::compute}), 2);
  EXPECT_DOUBLE_EQ(replay.seconds({Wall::exchange}), 14);
}

TEST(Replay, EvensWorkOut) {
  const farm::FarmReport report = two_frames();
  const Replay replay(report);
  EXPECT_DOUBLE_EQ(replay.seconds({Wall::imbalance}), 2 + 1 + 2.5 + 1 + 5);
  EXPECT_DOUBLE_EQ(replay.seconds({Wall::frame}), 9 + 2.5);
}

// Of a team, node 1 waits for node 0, which takes 6, before it writes what both have drawn.
TEST(Replay, WaitingForATeamIsNoMessage) {
  farm::FarmReport report = two_frames();
  wire::PhaseTimes slow{}, writer{};
  slow.scanline = 6;
  writer.scanline = 1, writer.bands = 9;
  report.node_files = 2;
  report.strips.back() = strip(wire::FrameKind::inbetween, 1, 0, slow);
  report.strips.push_back(strip(wire::FrameKind::inbetween, 1, 1, writer));
  const Replay replay(report);
  EXPECT_DOUBLE_EQ(replay.seconds({}), 15);
  EXPECT_DOUBLE_EQ(replay.seconds({Wall::bands}), 15);
}

TEST(Replay, TheHostTakesFramesOneByOne) {
  farm::FarmReport report = two_frames();
  report.busy_seconds = 30;
  report.total_seconds = 30;
  const walls::Explanation explanation = explain(report);
  EXPECT_EQ(explanation.binding()->wall, Wall::host);
  EXPECT_NEAR(explanation.binding()->without, 14, 1e-9);
  EXPECT_NEAR(explanation.seconds, 30, 1e-9);
}

TEST(Replay, SinksWorkSideBySideAndStorageOneAfterAnother) {
  farm::FarmReport report = two_frames();
  report.files.files = 2;
  report.sinks = 2;
  report.files.making_seconds = 16;  // 8 each: frames are drawn at 9 and 14
  EXPECT_DOUBLE_EQ(Replay(report).seconds({}), 22);
  report.sinks = 1;
  EXPECT_DOUBLE_EQ(Replay(report).seconds({}), 25);
  report.storing_seconds = 40;
  EXPECT_DOUBLE_EQ(Replay(report).seconds({}), 17 + 40);
  EXPECT_DOUBLE_EQ(Replay(report).seconds({Wall::storage}), 25);
  EXPECT_DOUBLE_EQ(Replay(report).seconds({Wall::encoder}), 9 + 40);
}

// Commands to nodes and strips to the host, of which nobody knows the time.
TEST(Replay, WhatTheRunTookBeyondIsTheHosts) {
  farm::FarmReport report = two_frames();
  report.total_seconds = 15;
  const walls::Explanation explanation = explain(report);
  const auto host = std::ranges::find(explanation.walls, Wall::host, &walls::FoundWall::wall);
  ASSERT_NE(host, explanation.walls.end());
  EXPECT_DOUBLE_EQ(host->without, 14);
}

TEST(Replay, WithoutFramesNothingBinds) { EXPECT_EQ(explain(farm::FarmReport()).binding(), nullptr); }

}  // namespace
}  // namespace mars::report
