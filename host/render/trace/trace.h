// What a traced run did, as it is gathered: events of every node and of the host, in each one's own time, and how
// the clocks stand. Bounded: what comes when it is full is left out and counted. trace_file.h writes it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/messages/recorder.h"
#include "host/render/sinks/sink_pool.h"
#include "host/render/trace/node_clock.h"
#include "node/wire/protocol.h"

namespace mars::trace {

// Spans of the host's own; their value is a frame's number, or what is said.
enum class HostSpan : std::int32_t {
  load,     // the film to the nodes; value: its bytes
  give,     // a task to a group; value: its interval
  strip,    // a strip received
  prepare,  // the next frame's buffer, before its strips are there
  compose,  // strips pasted into a frame
  finish,   // waiting for the sinks at the end
  write,    // a frame by a sink's thread (`peer`); `number`: microseconds it had waited for the thread
};

class Trace {
 public:
  static constexpr std::size_t kMostEvents = 500'000;  // about 100 MB as a file

  explicit Trace(std::size_t most_events = kMostEvents);

  // All nodes are there. The trace begins at `now`.
  void begin(std::span<const wire::Hello> nodes, double now);
  // A half of a rank's recorder; the host's rank is the number of nodes.
  void add(int rank, std::span<const messages::Event> half);
  void add(const sinks::SinkPool::Taken& frame);
  void add(int node, const ClockReading& reading) { clocks_.at(static_cast<std::size_t>(node)).add(reading); }
  // The run fails.
  void fail(const std::string& reason, double now);

  struct Record {
    messages::Event event;
    int rank;
  };
  const std::vector<Record>& records() const { return records_; }
  const std::vector<wire::Hello>& nodes() const { return nodes_; }
  int host() const { return static_cast<int>(nodes_.size()); }
  bool begun() const { return !nodes_.empty(); }
  // Seconds since the beginning, by the host's clock, of a rank's own time.
  double since_begin(int rank, double time) const;
  // Seconds by which times of nodes on other machines may be off at most.
  double clock_error() const;

  // Events that did not fit into ranks' recorders, and here.
  std::uint64_t lost() const;
  std::uint64_t beyond_bound() const { return beyond_bound_; }
  std::uint64_t left_out() const { return lost() + beyond_bound_; }
  // The first that was beyond the bound.
  const std::optional<Record>& first_beyond() const { return first_beyond_; }
  struct Fault {
    std::string reason;
    double time;  // the host's
  };
  const std::optional<Fault>& fault() const { return fault_; }

 private:
  void store(const Record& record);

  std::size_t most_;
  std::vector<Record> records_;
  std::vector<wire::Hello> nodes_;
  std::vector<NodeClock> clocks_;    // by rank; the host's has no reading
  std::vector<std::uint64_t> lost_;  // by rank
  double begin_ = 0;
  std::uint64_t beyond_bound_ = 0;
  std::optional<Record> first_beyond_;
  std::optional<Fault> fault_;
};

}  // namespace mars::trace
