// A trace's events in one order of time, by the host's clock, with what can be seen only when all are together:
// which message was taken where, and how many were on the way. Pure: no file, no text.
#pragma once

#include <cstdint>
#include <vector>

#include "host/render/trace/trace.h"

namespace mars::trace {

struct TimelineItem {
  std::int64_t begin;  // nanoseconds since the trace's beginning
  std::int64_t end;
  Trace::Record record;
  std::uint32_t arrow;  // the same for a message's sending and its taking; 0: its other end is not there
};

// In order of their beginnings; what encloses others comes before them.
std::vector<TimelineItem> timeline_of(const Trace& trace);

enum class Counter { credits, strips_on_the_way, frames_with_sinks };

struct CounterStep {
  std::int64_t time;  // nanoseconds
  Counter counter;
  int rank;  // whose counter: a node's credits, the host's others
  int value;
};

// In order of time.
std::vector<CounterStep> counters_of(const Trace& trace, const std::vector<TimelineItem>& timeline);

}  // namespace mars::trace
