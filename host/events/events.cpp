#include "host/events/events.h"

#include <nlohmann/json.hpp>
#include <ostream>

namespace mars::host {

using nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BootedEvent::Node, host, binding, simd)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BootedEvent, backend, machines, nodes, keyframes, inbetweens)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(FrameEvent, number, interval, keyframe, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(FaultEvent, problem, where, remedy, replay)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(DoneEvent, frames, seconds, folder)

namespace {

const char* name_of(const BootedEvent&) { return "booted"; }
const char* name_of(const FrameEvent&) { return "frame"; }
const char* name_of(const FaultEvent&) { return "fault"; }
const char* name_of(const DoneEvent&) { return "done"; }

// Tries the event types one after another.
template <typename First, typename... Rest>
std::optional<Event> read_as(const std::string& name, const json& object) {
  if (name == name_of(First{})) return object.get<First>();
  if constexpr (sizeof...(Rest) > 0)
    return read_as<Rest...>(name, object);
  else
    return std::nullopt;
}

}  // namespace

void write_event(std::ostream& out, const Event& event) {
  const json object = std::visit(
      [](const auto& known) {
        json fields = known;
        fields["event"] = name_of(known);
        return fields;
      },
      event);
  // Names of files and machines need not be UTF-8.
  out << object.dump(-1, ' ', false, json::error_handler_t::replace) << '\n' << std::flush;
}

std::optional<Event> read_event(std::string_view line) {
  const json object = json::parse(line, nullptr, false);
  if (!object.is_object() || !object.contains("event") || !object["event"].is_string()) return std::nullopt;
  try {
    return read_as<BootedEvent, FrameEvent, FaultEvent, DoneEvent>(object["event"].get<std::string>(), object);
  } catch (const json::exception&) {
    return std::nullopt;  // the right name with fields of other types: not ours
  }
}

}  // namespace mars::host
