// A trace as a file in the trace event format, which ui.perfetto.dev and chrome://tracing show: one JSON object
// (docs/tracing.md names what is in it). Times are microseconds of the host's clock since the trace's beginning.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "host/render/trace/trace.h"

namespace mars::trace {

// What a trace does not know of its run.
struct TraceHead {
  std::string film;
  std::string backend;
};

// What messages of a type are called in a trace.
std::string message_name(std::int32_t type);

// Whole or not at all; throws Failure where it cannot be written.
void write_trace(const std::filesystem::path& path, const TraceHead& head, const Trace& trace);

}  // namespace mars::trace
