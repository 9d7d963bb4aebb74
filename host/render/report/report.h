// What `--report FILE` holds: the nodes, and for each frame and node the seconds of every step and the
// work that was counted, as JSON (docs/watching.md names the keys).
#pragma once

#include <string>
#include <vector>

#include "host/render/farm/farm.h"
#include "host/render/farm/host_memory.h"
#include "host/render/sinks/usage.h"

namespace mars::report {

// What the farm does not know of its own run.
struct ReportHead {
  std::string film;
  std::string checksum;
  std::string backend;
  std::vector<std::string> arguments;  // the options, as given to the host
  std::uint32_t width = 0;             // pixels
  std::uint32_t height = 0;
  farm::HostMemory memory;
  sinks::Usage usage = {};  // of all runs of the folder; without a folder of this one
};

std::string report_text(const ReportHead& head, const farm::FarmReport& report);

}  // namespace mars::report
