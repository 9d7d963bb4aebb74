#include "host/render/events/events.h"

#include <nlohmann/json.hpp>

namespace mars::events {

using nlohmann::json;

namespace {

json kind_json(const Progress::Kind& kind) { return {{"done", kind.done}, {"of", kind.of}, {"seconds", kind.seconds}}; }

Progress::Kind read_kind(const json& from) { return {from.at("done"), from.at("of"), from.at("seconds")}; }

json to_json(const Loading& loading) { return {{"event", "loading"}, {"film", loading.film}}; }

json to_json(const Loaded& loaded) { return {{"event", "loaded"}, {"seconds", loaded.seconds}, {"run", loaded.run}}; }

json to_json(const Warning& warning) { return {{"event", "warning"}, {"text", warning.text}}; }

json to_json(const Resumed& resumed) {
  return {{"event", "resumed"}, {"there", resumed.there}, {"of", resumed.of}, {"changed", resumed.changed}};
}

json to_json(const Booted& booted) {
  json nodes = json::array();
  for (const Booted::Node& node : booted.nodes) {
    nodes.push_back({{"node", node.node},
                     {"host", node.host},
                     {"rank", node.rank},
                     {"binding", node.binding},
                     {"simd", node.simd}});
  }
  return {{"event", "booted"}, {"backend", booted.backend}, {"machines", booted.machines}, {"nodes", nodes}};
}

json left_json(const Progress::Left& left) {
  json to = {{"keyframes", left.keyframes}, {"inbetweens", left.inbetweens}};
  if (left.between) to["between"] = *left.between;
  return to;
}

Progress::Left read_left(const json& from) {
  Progress::Left left{from.at("keyframes"), from.at("inbetweens")};
  if (from.contains("between")) left.between = from["between"].get<std::array<double, 2>>();
  return left;
}

json to_json(const Progress& progress) {
  json to = {{"event", "progress"},
             {"interval", progress.interval},
             {"intervals", progress.intervals},
             {"keyframes", kind_json(progress.keyframes)},
             {"inbetweens", kind_json(progress.inbetweens)}};
  if (progress.forecast) to["left"] = left_json(*progress.forecast);
  return to;
}

json to_json(const FrameTaken& frame) {
  return {{"event", "frame"},
          {"number", frame.number},
          {"interval", frame.interval},
          {"kind", frame.kind == FrameKind::keyframe ? "keyframe" : "inbetween"}};
}

json to_json(const Beat& beat) {
  json silent = json::array();
  for (const Beat::Node& node : beat.silent) {
    silent.push_back({{"node", node.node},
                      {"host", node.host},
                      {"frame", node.frame},
                      {"doing", node.doing},
                      {"silent", node.silent}});
  }
  return {{"event", "beat"}, {"doing", beat.doing}, {"silent", silent}};
}

json to_json(const Drawing& drawing) {
  json nodes = json::array();
  for (const Drawing::Node& node : drawing.nodes) nodes.push_back({{"node", node.node}, {"frame", node.frame}});
  return {{"event", "drawing"}, {"nodes", nodes}};
}

json to_json(const Fault& fault) {
  json to = {{"event", "fault"},       {"problem", fault.problem}, {"where", fault.where},
             {"remedy", fault.remedy}, {"replay", fault.replay},   {"lost", fault.lost}};
  if (fault.node) to["node"] = *fault.node;
  if (fault.frame) to["frame"] = *fault.frame;
  return to;
}

json to_json(const Done& done) {
  return {{"event", "done"},
          {"frames", done.frames},
          {"seconds", done.seconds},
          {"folder", done.folder},
          {"trace_lacks", done.trace_lacks}};
}

Booted read_booted(const json& from) {
  Booted booted{from.at("backend"), from.at("machines"), {}};
  for (const json& node : from.at("nodes")) {
    booted.nodes.push_back({node.at("node"), node.at("host"), node.at("rank"), node.at("binding"), node.at("simd")});
  }
  return booted;
}

Progress read_progress(const json& from) {
  Progress progress{from.at("interval"), from.at("intervals"), read_kind(from.at("keyframes")),
                    read_kind(from.at("inbetweens")), std::nullopt};
  if (from.contains("left")) progress.forecast = read_left(from["left"]);
  return progress;
}

FrameTaken read_frame(const json& from) {
  const bool keyframe = from.at("kind") == "keyframe";
  return {from.at("number"), from.at("interval"), keyframe ? FrameKind::keyframe : FrameKind::inbetween};
}

Beat read_beat(const json& from) {
  Beat beat{from.at("doing"), {}};
  for (const json& node : from.at("silent")) {
    beat.silent.push_back({node.at("node"), node.at("host"), node.at("frame"), node.at("doing"), node.at("silent")});
  }
  return beat;
}

Drawing read_drawing(const json& from) {
  Drawing drawing;
  for (const json& node : from.at("nodes")) drawing.nodes.push_back({node.at("node"), node.at("frame")});
  return drawing;
}

Fault read_fault(const json& from) {
  Fault fault{from.at("problem"), from.at("where"),      from.at("remedy"), {}, {},
              from.at("replay"),  from.value("lost", 0u)};
  if (from.contains("node")) fault.node = from["node"].get<std::int32_t>();
  if (from.contains("frame")) fault.frame = from["frame"].get<std::int32_t>();
  return fault;
}

Done read_done(const json& from) {
  return {from.at("frames"), from.at("seconds"), from.at("folder"), from.value("trace_lacks", std::uint64_t{0})};
}

std::optional<Event> read_known(const json& from) {
  const std::string name = from.at("event");
  if (name == "loading") return Loading{from.at("film")};
  if (name == "loaded") return Loaded{from.at("seconds"), from.value("run", "")};
  if (name == "warning") return Warning{from.at("text")};
  if (name == "resumed") return Resumed{from.at("there"), from.at("of"), from.at("changed")};
  if (name == "booted") return read_booted(from);
  if (name == "progress") return read_progress(from);
  if (name == "frame") return read_frame(from);
  if (name == "beat") return read_beat(from);
  if (name == "drawing") return read_drawing(from);
  if (name == "fault") return read_fault(from);
  if (name == "done") return read_done(from);
  return std::nullopt;
}

}  // namespace

std::string line_of(const Event& event) {
  const json object = std::visit([](const auto& each) { return to_json(each); }, event);
  // File names need not be UTF-8, JSON must be.
  return object.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::optional<Event> read_event(std::string_view line) {
  const json from = json::parse(line, nullptr, false);
  if (!from.is_object() || !from.contains("event")) return std::nullopt;
  try {
    return read_known(from);
  } catch (const json::exception&) {
    // Another version's event of this name: not for us.
    return std::nullopt;
  }
}

}  // namespace mars::events
