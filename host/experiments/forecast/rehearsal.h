// Plays a rendering through by counted time: groups of nodes with their tasks, credits and strips, the host that takes
// them one by one, and its sinks.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "host/experiments/forecast/film_counts.h"
#include "host/experiments/forecast/frame_loads.h"
#include "host/experiments/forecast/setting.h"
#include "host/render/events/course.h"
#include "host/render/farm/plan.h"

namespace mars::forecast {

struct Rehearsed {
  double seconds = 0;                         // until the sinks have taken all frames
  std::vector<events::ExpectedFrame> frames;  // as they are composed, after the first command
  double bytes_to_nodes = 0;
  double bytes_to_host = 0;
  double node_memory = 0;    // bytes of a node's arena, at most
  double shadow_memory = 0;  // and for shadows
  double still_memory = 0;   // of still lines, that machines keep for a group, at most
  farm::HostMemory host_memory;
  double host_busy = 0;           // seconds that the host's loop works
  std::vector<walls::Busy> busy;  // by node
};

// A rendering that takes longer than `limit` is not played to its end: its seconds are infinite. `loads`: of the
// counts, numbers of nodes and settings, whatever work and messages cost.
Rehearsed rehearse(const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, int nodes,
                   KeyframeLoads& loads, double limit = std::numeric_limits<double>::infinity());
Rehearsed rehearse(const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, int nodes,
                   double limit = std::numeric_limits<double>::infinity());

}  // namespace mars::forecast
