// The farm's part in a trace (host/render/trace): reads the nodes' clocks, records the host itself, and receives what
// nodes recorded. Where no trace is asked for, every call does nothing.
#pragma once

#include <optional>
#include <vector>

#include "hal/messages/recorder.h"
#include "host/render/farm/node_inbox.h"
#include "host/render/trace/trace.h"

namespace mars::farm {

class Tracing {
 public:
  // `trace` may be nullptr. The calling process is the host, all nodes are there and have no film yet.
  Tracing(trace::Trace* trace, NodeInbox& inbox);
  ~Tracing();
  Tracing(const Tracing&) = delete;
  Tracing& operator=(const Tracing&) = delete;

  // Now and then: empties the host's recorder before it is full.
  void drain();
  void taken(const sinks::SinkPool::Taken& frame);
  // Receives a node's Trace message that has come.
  void receive();
  // When all frames are there and nodes are idle: reads the clocks again where they are not the host's own.
  void read_clocks_again();
  // When Stop was sent to the nodes: receives what they have recorded until then.
  void finish();

 private:
  void empty_recorder(bool last);

  trace::Trace* trace_;
  NodeInbox& inbox_;
  std::optional<messages::Recorder> recorder_;
  std::vector<int> foreign_;  // nodes with clocks of their own
};

// Records its own lifetime as a span of the host's, where the run is traced.
class ScopedSpan {
 public:
  explicit ScopedSpan(trace::HostSpan what, std::uint64_t value = 0);
  ~ScopedSpan();
  ScopedSpan(const ScopedSpan&) = delete;
  ScopedSpan& operator=(const ScopedSpan&) = delete;

  void set_value(std::uint64_t value) { value_ = value; }
  // There was nothing to do.
  void forget() { begin_ = 0; }

 private:
  trace::HostSpan what_;
  std::uint64_t value_;
  double begin_;
};

}  // namespace mars::farm
