#include "host/render/sinks/status.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "hal/failure/plain_text.h"
#include "host/content/document/file.h"
#include "host/render/sinks/record.h"
#include "node/wire/film_parts.h"

namespace mars::sinks {

using nlohmann::json;

namespace {

constexpr std::uint64_t kMostNodes = 1 << 20;
constexpr std::size_t kLongestText = 4096;

// What is as usual is left out: a large machine's status stays small.
json to_json(const Status::Node& node) {
  json to = {{"node", node.node}, {"frames", node.frames}};
  if (node.silent > 0) to["silent"] = node.silent;
  if (node.frame >= 0) to["frame"] = node.frame;
  if (!node.doing.empty()) to["doing"] = node.doing;
  if (node.slow != 1) to["slow"] = node.slow;
  return to;
}

json to_json(const Status::Machine& machine) {
  json nodes = json::array();
  for (const Status::Node& node : machine.nodes) nodes.push_back(to_json(node));
  return {{"name", machine.name}, {"nodes", nodes}};
}

// `usual` where there is none.
double number_of(const Record& from, std::string_view key, double usual) {
  return from.has(key) ? from.number(key) : usual;
}

std::uint32_t count_of(const Record& from, std::string_view key) {
  return static_cast<std::uint32_t>(from.whole_number(key, 0, std::numeric_limits<std::uint32_t>::max()));
}

std::string text_of(const json& from) {
  if (!from.is_string()) refuse_value("warnings", from, "a list of texts");
  return plain_line(from.get<std::string>().substr(0, kLongestText));
}

std::string text_of(const Record& from, std::string_view key) { return text_of(json(from.text(key, kLongestText))); }

Status::Node node_of(const json& object) {
  const Record from(object);
  Status::Node node;
  node.node = static_cast<std::int32_t>(from.whole_number("node", 0, kMostNodes));
  node.frames = count_of(from, "frames");
  node.silent = number_of(from, "silent", 0);
  if (from.has("frame")) node.frame = static_cast<std::int32_t>(from.whole_number("frame", 0, wire::kMostFrames));
  if (from.has("doing")) node.doing = text_of(from, "doing");
  node.slow = number_of(from, "slow", 1);
  return node;
}

Status::Machine machine_of(const json& object) {
  const Record from(object);
  Status::Machine machine{text_of(from, "name"), {}};
  for (const json& node : from.list("nodes")) machine.nodes.push_back(node_of(node));
  return machine;
}

Status status_of(const json& object) {
  const Record from(object);
  Status status;
  status.process = process_name_of(object);
  status.since = static_cast<std::int64_t>(from.whole_number("since", 0, kLastSecond));
  status.written = static_cast<std::int64_t>(from.whole_number("written", 0, kLastSecond));
  status.film = text_of(from, "film");
  status.doing = text_of(from, "doing");
  status.done = count_of(from, "done");
  status.of = count_of(from, "of");
  status.seconds = number_of(from, "seconds", 0);
  if (from.has("left")) status.left = number_of(from, "left", 0);
  for (const json& machine : from.list("machines")) status.machines.push_back(machine_of(machine));
  for (const json& warning : from.list("warnings")) status.warnings.push_back(text_of(warning));
  status.used = usage_of(from);
  return status;
}

}  // namespace

std::string text_of(const Status& status) {
  json text = to_json(status.process);
  text["since"] = status.since;
  text["written"] = status.written;
  text["film"] = status.film;
  text["doing"] = status.doing;
  text["done"] = status.done;
  text["of"] = status.of;
  text["seconds"] = status.seconds;
  if (status.left) text["left"] = *status.left;
  text["machines"] = json::array();
  for (const Status::Machine& machine : status.machines) text["machines"].push_back(to_json(machine));
  text["warnings"] = status.warnings;
  add_usage(status.used, text);
  return text.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::optional<Status> status_of(const RunFiles& run) {
  const auto file = std::ranges::find(run.files, kStatusEnding, &std::filesystem::path::extension);
  if (file == run.files.end()) return std::nullopt;
  const std::optional<std::string> text = document::read_file_if_there(*file, kLargestRecord);
  if (!text) return std::nullopt;
  try {
    return status_of(parse_record(*text));
  } catch (const Failure&) {
    return std::nullopt;
  }
}

}  // namespace mars::sinks
