// The processor time and storage that runs have used for a folder of frames, for those who count it. A run's own is in
// its .status while it lives, the sum of all that have ended in frames.json.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace mars::sinks {

class Record;

struct Usage {
  double processor_seconds = 0;  // of the host and of each node, which have a processor each as long as the run takes
  std::uint64_t bytes = 0;       // of frames' files, as written
  std::uint32_t restarts = 0;    // runs that ended before their last frame, so that another had to go on

  double processor_hours() const { return processor_seconds / 3600; }
  bool operator==(const Usage&) const = default;
  Usage& operator+=(const Usage& more);
};

nlohmann::json to_json(const Usage& usage);
// As the key "usage"; nothing where nothing was used.
void add_usage(const Usage& usage, nlohmann::json& text);
Usage usage_of(const Record& record);

}  // namespace mars::sinks
