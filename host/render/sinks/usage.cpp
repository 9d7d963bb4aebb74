#include "host/render/sinks/usage.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "host/render/sinks/record.h"

namespace mars::sinks {

using nlohmann::json;

Usage& Usage::operator+=(const Usage& more) {
  processor_seconds += more.processor_seconds;
  bytes += more.bytes;
  restarts += more.restarts;
  return *this;
}

json to_json(const Usage& usage) {
  return {{"processor_seconds", usage.processor_seconds}, {"bytes", usage.bytes}, {"restarts", usage.restarts}};
}

void add_usage(const Usage& usage, json& text) {
  if (usage != Usage()) text["usage"] = to_json(usage);
}

Usage usage_of(const Record& record) {
  if (!record.has("usage")) return {};
  const Record from(record.value("usage"));
  constexpr std::uint64_t kMostBytes = std::numeric_limits<std::int64_t>::max();
  return {from.number("processor_seconds"), from.whole_number("bytes", 0, kMostBytes),
          static_cast<std::uint32_t>(from.whole_number("restarts", 0, std::numeric_limits<std::uint32_t>::max()))};
}

}  // namespace mars::sinks
