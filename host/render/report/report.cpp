#include "host/render/report/report.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "host/render/report/replay.h"
#include "host/render/walls/walls_text.h"
#include "topology/placement.h"

namespace mars::report {

using nlohmann::ordered_json;

namespace {

ordered_json node_json(const wire::Hello& hello) {
  return {{"node", hello.node},        {"machine", hello.machine},        {"host", hello.host.data()},
          {"rank", hello.rank},        {"binding", hello.binding.data()}, {"seat", hello.seat},
          {"simd", hello.simd.data()}, {"memory", hello.memory}};
}

ordered_json memory_json(const farm::HostMemory& memory) {
  return {{"budget", memory.budget},           {"frames", memory.frames},   {"frame_bytes", memory.frame_bytes},
          {"backgrounds", memory.backgrounds}, {"credits", memory.credits}, {"strip_bytes", memory.strip_bytes()},
          {"most_bytes", memory.most_bytes()}};
}

ordered_json memory_json(const farm::NodeMemory& memory) {
  return {{"frames", memory.frames},
          {"still", memory.still},
          {"still_line_bytes", memory.still_plan.line_bytes},
          {"still_groups", memory.still_plan.groups_per_column},
          {"still_lines", memory.still_plan.lines},
          {"shadows", memory.shadows}};
}

// What the furthest neighbours share across each dimension of the hypercube of all nodes.
ordered_json dimensions_json(const std::vector<wire::Hello>& hellos) {
  std::vector<topology::Location> nodes;
  for (const wire::Hello& hello : hellos) nodes.push_back({hello.machine, hello.seat});
  ordered_json texts = ordered_json::array();
  for (const topology::Closeness closeness : topology::dimensions(nodes)) texts.push_back(topology::text_of(closeness));
  return texts;
}

ordered_json seconds_json(const wire::PhaseTimes& times) {
  return {{"dice", times.dice},         {"sum", times.sum},     {"map", times.map},
          {"exchange", times.exchange}, {"fill", times.fill},   {"scanline", times.scanline},
          {"shadow", times.shadow},     {"depth", times.depth}, {"credit", times.credit},
          {"compose", times.compose},   {"bands", times.bands}, {"storage", times.storage}};
}

// What was done at all.
ordered_json charged_json(std::span<const std::uint64_t> charged, std::size_t first_kind) {
  ordered_json units = ordered_json::object();
  for (std::size_t i = 0; i < charged.size(); ++i)
    if (charged[i] > 0) units[std::string(wire::kWorkNames[first_kind + i])] = charged[i];
  return units;
}

// `end`: null where it was slow until the last frame.
ordered_json slow_json(const farm::FarmReport& report) {
  ordered_json times = ordered_json::array();
  for (const farm::SlowTime& time : report.slow_times) {
    times.push_back({{"node", time.node},
                     {"host", report.nodes.at(static_cast<std::size_t>(time.node)).host.data()},
                     {"times", time.slowness},
                     {"begin", time.begin},
                     {"end", time.end ? ordered_json(*time.end) : ordered_json()}});
  }
  return times;
}

ordered_json host_json(const farm::FarmReport& report) {
  return {{"busy_seconds", report.busy_seconds},
          {"sink_seconds", report.sink_seconds},
          {"files", report.files.files},
          {"encoded_bytes", report.files.encoded_bytes},
          {"file_bytes", report.files.file_bytes},
          {"node_files", report.node_files},
          {"sinks", report.sinks},
          {"making_seconds", report.files.making_seconds},
          {"storing_seconds", report.storing_seconds},
          {"charged", charged_json(report.charged, wire::kNodeKinds)}};
}

ordered_json work_json(const wire::WorkCounts& work) {
  return {{"patches", work.patches},
          {"vertices", work.vertices},
          {"triangles_tested", work.triangles_tested},
          {"triangles", work.triangles},
          {"edge_boxes_diced", work.edge_boxes_diced},
          {"edge_boxes", work.edge_boxes},
          {"samples", work.samples},
          {"pixels", work.pixels},
          {"lines_drawn_again", work.lines_drawn_again},
          {"bytes_to_nodes", work.bytes_to_nodes},
          {"bytes_to_host", work.bytes_to_host},
          {"memory", work.memory},
          {"passes", work.passes},
          {"credits_waited", work.credits_waited},
          {"charged", charged_json(work.charged, 0)}};
}

// A strip that is a node's last of a frame: it has all the node's counts.
ordered_json part_json(const wire::Strip& strip) {
  return {{"node", strip.node},
          {"first_line", strip.first_line},
          {"last_line", strip.last_line},
          {"seconds", seconds_json(strip.times)},
          {"work", work_json(strip.work)}};
}

ordered_json frame_json(const farm::FinishedFrame& frame, std::vector<const wire::Strip*>& strips) {
  std::sort(strips.begin(), strips.end(), [](const auto* a, const auto* b) { return a->node < b->node; });
  ordered_json parts = ordered_json::array();
  for (const wire::Strip* strip : strips) parts.push_back(part_json(*strip));
  const bool keyframe = frame.kind == wire::FrameKind::keyframe;
  return {{"frame", frame.number},
          {"interval", frame.interval},
          {"kind", keyframe ? "keyframe" : "inbetween"},
          {"seconds", frame.seconds},
          {"edge_box_total", strips.empty() ? 0 : strips.front()->edge_box_total},
          {"load_ratio", strips.empty() ? 1 : strips.front()->load_ratio},
          {"nodes", parts}};
}

ordered_json frames_json(const farm::FarmReport& report) {
  std::map<std::uint32_t, std::vector<const wire::Strip*>> strips;
  for (const wire::Strip& strip : report.strips) {
    if (strip.last == 1) strips[strip.frame].push_back(&strip);
  }
  std::vector<farm::FinishedFrame> frames = report.frames;
  std::sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  ordered_json rows = ordered_json::array();
  for (const farm::FinishedFrame& frame : frames) rows.push_back(frame_json(frame, strips[frame.number]));
  return rows;
}

}  // namespace

std::string report_text(const ReportHead& head, const farm::FarmReport& report) {
  ordered_json nodes = ordered_json::array();
  for (const wire::Hello& hello : report.nodes) nodes.push_back(node_json(hello));
  const ordered_json all = {{"film", head.film},
                            {"checksum", head.checksum},
                            {"backend", head.backend},
                            {"arguments", head.arguments},
                            {"width", head.width},
                            {"height", head.height},
                            {"film_bytes", report.film_bytes},
                            {"host_memory", memory_json(head.memory)},
                            {"node_memory", memory_json(report.node_memory)},
                            {"load_seconds", report.load_seconds},
                            {"render_seconds", report.render_seconds},
                            {"total_seconds", report.total_seconds},
                            {"usage", sinks::to_json(head.usage)},
                            {"host", host_json(report)},
                            {"nodes", nodes},
                            {"dimensions", dimensions_json(report.nodes)},
                            {"slow", slow_json(report)},
                            {"groups", report.groups.size()},
                            {"walls", walls::json_of(explain(report))},
                            {"frames", frames_json(report)}};
  return all.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace mars::report
