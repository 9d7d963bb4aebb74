// How the clock of a node's machine stands against the host's. A reading is a question and its answer: the
// node's time belongs somewhere between the two moments at which the host asked and heard, so half of that is
// the reading's error. A node that shares the host's clock is recognised: its time lies in between.
#pragma once

#include <optional>

namespace mars::trace {

struct ClockReading {
  double node = 0;    // seconds of the node's clock
  double offset = 0;  // to add for the host's
  double error = 0;   // at most so far off, either way

  // Asked and heard by the host's clock; the answer is by the node's.
  static ClockReading of(double asked, double answer, double heard);
  bool shares_clock() const { return offset <= error && -offset <= error; }
};

class NodeClock {
 public:
  // The first reading, or a later one: between them the offset is taken to change evenly.
  void add(const ClockReading& reading);
  // The host's time for the node's `time`.
  double to_host(double time) const;
  double error() const;

 private:
  std::optional<ClockReading> first_;
  std::optional<ClockReading> last_;
};

}  // namespace mars::trace
