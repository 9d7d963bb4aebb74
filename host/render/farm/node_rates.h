// How fast each node draws inbetweens, as the host sees it: by when they come, so that a slow link counts as well as a
// slow processor. A node's pace is taken over some seconds at a time, and compared with that of the others. It is slow
// when it was much slower three times running, and no longer when it has been about as fast for some such times; what
// all nodes have in common, or what lasts for a moment, makes none slow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "node/wire/protocol.h"

namespace mars::farm {

// A time in which a node was slow.
struct SlowTime {
  std::int32_t node;
  double slowness;              // how many times as long it took, at most
  double begin;                 // in seconds, as `now` of NodeRates
  std::optional<double> end{};  // none: it was slow until the last frame
};

class NodeRates {
 public:
  explicit NodeRates(std::size_t nodes) : nodes_(nodes) {}

  // The node cannot have begun its next inbetween before `now`.
  void ready(int node, double now);
  // An inbetween came whole. `seconds`: that it took by the node's own clock, without waiting for the host.
  void came(int node, double now, double seconds, double work);
  // A portion was given to the node's group, and it got inbetweens of it or not.
  void given(int node, bool some);

  // How many times as long as others it takes for an inbetween; 1: it is not slow.
  double slowness(int node) const { return of(node).slowness; }
  // It is slow, and was passed over often: whether it still is cannot be known.
  bool is_forgotten(int node) const;

  // Nodes that became slow, or are no longer, since the last call.
  std::vector<int> take_changed();
  // All so far, by their beginnings.
  const std::vector<SlowTime>& slow_times() const { return slow_times_; }

 private:
  struct Node {
    double since = 0;  // it has drawn its next inbetween
    // What is being measured.
    int inbetweens = 0;
    double seconds = 0;
    double work = 0;
    // What was.
    std::optional<double> pace;  // seconds for a unit of work
    std::vector<double> doubts;  // how slow it was the last times, as long as it was so without a break
    double slowness = 1;
    int passed_over = 0;
  };

  Node& of(int node) { return nodes_.at(static_cast<std::size_t>(node)); }
  const Node& of(int node) const { return nodes_.at(static_cast<std::size_t>(node)); }
  static std::optional<double> pace_of(const Node& node);
  double usual_pace() const;
  void take_pace(int node, double now);
  void doubt(int node, double slowness, double now);
  void smooth(int node, double slowness, double now);

  std::vector<Node> nodes_;
  std::vector<SlowTime> slow_times_;
  std::vector<int> changed_;
};

// Of an inbetween, in nanoseconds of a usual processor: as mars calibrate finds them, roughly.
double work_of(const wire::WorkCounts& counts);

}  // namespace mars::farm
