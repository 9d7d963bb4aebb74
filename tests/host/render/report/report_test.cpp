#include "host/render/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace mars::report {
namespace {

using nlohmann::json;

wire::Strip strip_of(std::uint32_t frame, std::int32_t node, std::uint32_t last) {
  wire::Strip strip{};
  strip.frame = frame;
  strip.node = node;
  strip.last = last;
  strip.edge_box_total = 77;
  strip.load_ratio = 1.25;
  strip.times.dice = 0.5;
  strip.times.shadow = 0.125;
  strip.work.triangles = 10 + static_cast<std::uint64_t>(node);
  strip.work.samples = 500;
  strip.work.lines_drawn_again = 30;
  strip.work.credits_waited = 2;
  return strip;
}

farm::FarmReport two_nodes_two_frames() {
  farm::FarmReport report;
  for (const std::int32_t number : {0, 1}) {
    wire::Hello hello{};
    hello.node = number;
    hello.memory = 1000;
    hello.seat = {number, number, 0, 0, 0};
    std::copy_n("ada", 3, hello.host.data());
    std::copy_n("core 0", 6, hello.binding.data());
    report.nodes.push_back(hello);
  }
  report.strips = {strip_of(1, 1, 1), strip_of(0, 1, 0), strip_of(0, 1, 1), strip_of(0, 0, 1)};
  report.frames = {{1, 0, wire::FrameKind::inbetween, 0.5, 0}, {0, 0, wire::FrameKind::keyframe, 0.25, 0}};
  report.film_bytes = 4096;
  wire::FilmSettings film{};
  film.width = 96, film.height = 54, film.samples = 4;
  report.node_memory = farm::share_node_memory(1 << 20, {}, film);
  report.total_seconds = 3;
  report.slow_times = {{1, 2.5, 0.5, 2.0}, {0, 3, 1.0}};
  return report;
}

TEST(Report, HasEveryFrameWithEveryNodeThatDrewIt) {
  const ReportHead head{"film.json",
                        "abc",
                        "mpi",
                        {"film.json", "-o", "x"},
                        96,
                        54,
                        farm::share_host_memory(1 << 30, {96, 54, 2, 0, {}, 24, {}}, wire::PixelFormat::rgb8, 2, 1, 4),
                        {7200, 1000, 1}};
  const json report = json::parse(report_text(head, two_nodes_two_frames()));
  EXPECT_EQ(report["film"], "film.json");
  EXPECT_EQ(report["arguments"].size(), 3u);
  EXPECT_EQ(report["usage"], json({{"processor_seconds", 7200}, {"bytes", 1000}, {"restarts", 1}}));
  EXPECT_EQ(report["nodes"][1]["binding"], "core 0");
  EXPECT_EQ(report["slow"], json::parse(R"([{"node": 1, "host": "ada", "times": 2.5, "begin": 0.5, "end": 2.0},
                                            {"node": 0, "host": "ada", "times": 3.0, "begin": 1.0, "end": null}])"));
  EXPECT_EQ(report["dimensions"], json({"an L3 cache"}));
  EXPECT_EQ(report["host_memory"]["budget"], 1 << 30);
  EXPECT_EQ(report["host_memory"]["frames"], 6);
  EXPECT_EQ(report["host_memory"]["credits"], 4);
  EXPECT_EQ(report["node_memory"], json({{"frames", 3 << 18},
                                         {"still", 1 << 18},
                                         {"still_line_bytes", 3520},
                                         {"still_groups", 1},
                                         {"still_lines", 54},
                                         {"shadows", 0}}));
  ASSERT_EQ(report["frames"].size(), 2u);
  const json& keyframe = report["frames"][0];
  EXPECT_EQ(keyframe["frame"], 0);
  EXPECT_EQ(keyframe["kind"], "keyframe");
  EXPECT_EQ(keyframe["edge_box_total"], 77);
  EXPECT_EQ(keyframe["load_ratio"], 1.25);
  ASSERT_EQ(keyframe["nodes"].size(), 2u) << "the last strip of each node, in their order";
  EXPECT_EQ(keyframe["nodes"][0]["node"], 0);
  EXPECT_EQ(keyframe["nodes"][1]["work"]["triangles"], 11);
  EXPECT_EQ(keyframe["nodes"][1]["work"]["samples"], 500);
  EXPECT_EQ(keyframe["nodes"][1]["work"]["lines_drawn_again"], 30);
  EXPECT_EQ(keyframe["nodes"][1]["seconds"]["dice"], 0.5);
  EXPECT_EQ(report["frames"][1]["kind"], "inbetween");
  EXPECT_EQ(report["frames"][1]["nodes"].size(), 1u);
}

TEST(Report, NamesNeedNotBeText) {
  const ReportHead head{"\xff.json", "abc", "mpi", {"\xff.json"}, 96, 54, {}};
  EXPECT_FALSE(json::parse(report_text(head, farm::FarmReport{})).empty());
}

}  // namespace
}  // namespace mars::report
