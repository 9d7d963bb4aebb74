// How long each node has said nothing, by what it sends: beats (node/wire/protocol.h), strips, greetings. It counts
// seconds in which the host looked, each look for one second at most: while the whole job is suspended, nothing counts.
// A node hangs when it has said nothing for half a minute, or for ten times as long as its step has ever taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "node/wire/protocol.h"

namespace mars::farm {

class NodeWatch {
 public:
  // Of nodes that have just been heard.
  explicit NodeWatch(std::size_t nodes);

  // The node has said something: here what it does.
  void hear(int node);
  void hear(int node, const wire::Beat& beat);
  // What the steps of a frame took on a node.
  void note(const wire::PhaseTimes& times);

  // Time goes on to `now`, in seconds of any clock.
  void look(double now);

  double silence(int node) const { return of(node).silence; }
  // That have been silent for `seconds`.
  std::vector<int> silent(double seconds) const;
  // That have said nothing for longer than they may.
  std::vector<int> hanging() const;
  // Its last one; of one that never beat, one without a frame.
  const wire::Beat& beat(int node) const { return of(node).beat; }

 private:
  struct Node {
    double silence = 0;
    wire::Beat beat;
  };

  const Node& of(int node) const { return nodes_.at(static_cast<std::size_t>(node)); }
  double patience(const wire::Beat& beat) const;
  template <class Beyond>
  std::vector<int> those(Beyond beyond) const;

  std::vector<Node> nodes_;
  wire::PhaseTimes longest_{};
  double looked_ = -1;  // -1: not yet
};

}  // namespace mars::farm
