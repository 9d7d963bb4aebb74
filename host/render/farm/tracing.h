// The farm's part in a trace (host/render/trace): reads the nodes' clocks, records the host itself, and receives what
// nodes recorded. Where no trace is asked for, every call does nothing.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hal/messages/recorder.h"
#include "host/render/trace/trace.h"

namespace mars::host {

class Tracing {
 public:
  // `trace` may be nullptr. The calling process is the host, all nodes are there and have no film yet.
  Tracing(Trace* trace, std::span<const node::Hello> nodes, int credits);
  ~Tracing();
  Tracing(const Tracing&) = delete;
  Tracing& operator=(const Tracing&) = delete;

  // Now and then: empties the host's recorder before it is full.
  void drain();
  void taken(const SinkPool::Taken& frame);
  // Receives a node's Trace message that has come.
  void receive();
  // When all frames are there and nodes are idle: reads the clocks again where they are not the host's own.
  void read_clocks_again();
  // Nodes whose last Trace message is still to come.
  int nodes_left() const { return nodes_left_; }

 private:
  void empty_recorder(bool last);

  Trace* trace_;
  std::optional<hal::Recorder> recorder_;
  std::vector<int> foreign_;  // nodes with clocks of their own
  std::vector<hal::Event> half_;
  int nodes_left_ = 0;
};

// Records its own lifetime as a span of the host's, where somebody does.
class SpanOf {
 public:
  explicit SpanOf(HostSpan what, std::uint64_t value = 0);
  ~SpanOf();
  SpanOf(const SpanOf&) = delete;
  SpanOf& operator=(const SpanOf&) = delete;

  void set_value(std::uint64_t value) { value_ = value; }
  // There was nothing to do.
  void forget() { begin_ = 0; }

 private:
  HostSpan what_;
  std::uint64_t value_;
  double begin_;
};

}  // namespace mars::host
