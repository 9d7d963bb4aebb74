#include "host/report/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "host/sinks/whole_file.h"

namespace mars::host {
namespace {

using json = nlohmann::ordered_json;

const char* kind_name(node::FrameKind kind) { return kind == node::FrameKind::keyframe ? "keyframe" : "inbetween"; }

json node_json(const node::Hello& hello) {
  return {{"node", hello.node},
          {"host", hello.host.data()},
          {"machine", hello.machine},
          {"binding", hello.binding.data()},
          {"simd", hello.simd.data()},
          {"memory", hello.memory}};
}

json seconds_json(const node::PhaseTimes& times) {
  return {{"dice", times.dice},         {"sum", times.sum},   {"map", times.map},
          {"exchange", times.exchange}, {"fill", times.fill}, {"scanline", times.scanline},
          {"depth", times.depth},       {"credit", times.credit}};
}

json work_json(const node::WorkCounts& work) {
  return {{"patches", work.patches},
          {"vertices", work.vertices},
          {"triangles", work.triangles},
          {"edge_boxes_diced", work.edge_boxes_diced},
          {"edge_boxes", work.edge_boxes},
          {"pixels", work.pixels},
          {"bytes_to_nodes", work.bytes_to_nodes},
          {"bytes_to_host", work.bytes_to_host},
          {"memory", work.memory},
          {"passes", work.passes},
          {"credits_waited", work.credits_waited}};
}

json share_json(const node::Strip& strip) {
  return {{"node", strip.node},
          {"first_line", strip.first_line},
          {"last_line", strip.last_line},
          {"seconds", seconds_json(strip.times)},
          {"work", work_json(strip.work)}};
}

// The last strips of a frame's nodes, which have all its counts, in the order of nodes.
std::vector<node::Strip> shares_of(const FarmReport& report, std::uint32_t frame) {
  std::vector<node::Strip> shares;
  for (const node::Strip& strip : report.strips)
    if (strip.frame == frame && strip.last == 1) shares.push_back(strip);
  std::sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  return shares;
}

json frame_json(const FinishedFrame& frame, std::span<const node::Strip> shares) {
  json out = {{"frame", frame.number},
              {"interval", frame.interval},
              {"kind", kind_name(frame.kind)},
              {"composed_at", frame.seconds},
              {"edge_boxes", shares.front().edge_box_total},
              {"load_max_over_average", shares.front().load_ratio},
              {"nodes", json::array()}};
  for (const node::Strip& strip : shares) out["nodes"].push_back(share_json(strip));
  return out;
}

}  // namespace

void write_report(const std::filesystem::path& file, const ReportHeader& header, const FarmReport& report) {
  json out = {{"film", header.film},
              {"size", {header.width, header.height}},
              {"backend", header.backend},
              {"film_bytes", report.film_bytes},
              {"seconds", {{"load", report.load_seconds}, {"render", report.render_seconds}, {"total", report.total_seconds}}},
              {"nodes", json::array()},
              {"frames", json::array()}};
  for (const node::Hello& hello : report.nodes) out["nodes"].push_back(node_json(hello));
  std::vector<FinishedFrame> frames = report.frames;
  std::sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  for (const FinishedFrame& frame : frames) out["frames"].push_back(frame_json(frame, shares_of(report, frame.number)));
  write_whole_file(file, out.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace mars::host
