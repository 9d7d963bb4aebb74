// What nodes were given to draw and have not drawn yet. Each node draws what it is given in turn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "node/wire/protocol.h"

namespace mars::farm {

// A picture as its strips name it; of a studio's view the frame is the picture's number, the interval the view's.
struct Assignment {
  std::uint32_t frame;
  std::uint32_t interval;
  wire::FrameKind kind;

  bool operator==(const Assignment&) const = default;
};

inline Assignment assignment_of(const wire::Strip& strip) { return {strip.frame, strip.interval, strip.kind}; }

class Assignments {
 public:
  explicit Assignments(std::size_t nodes) : given_(nodes) {}

  void give(int node, const Assignment& picture) { of(node).push_back(picture); }
  // Whether a node was given a picture, and its last strip of it has not come.
  bool is_given(int node, const Assignment& picture) const {
    return std::ranges::find(of(node), picture) != of(node).end();
  }
  bool has(const wire::Strip& strip) const { return is_given(strip.node, assignment_of(strip)); }
  // The node's last strip of a picture came.
  void end(const wire::Strip& last) {
    Given& given = of(last.node);
    given.erase(std::ranges::find(given, assignment_of(last)));
  }

  bool all_idle() const { return std::ranges::all_of(given_, &Given::empty); }
  // A node that has nothing to draw, the next from `first` on; none: all draw.
  std::optional<int> idle_from(std::size_t first) const;
  // Inbetweens of the interval that the node has to draw.
  std::size_t inbetweens(int node, std::uint32_t interval) const;
  // What the node draws: the frame that it said last it had begun, -1 for none, if it has that; else its first.
  std::optional<std::uint32_t> drawn_by(int node, std::int32_t begun) const;

 private:
  using Given = std::deque<Assignment>;

  const Given& of(int node) const { return given_.at(static_cast<std::size_t>(node)); }
  Given& of(int node) { return given_.at(static_cast<std::size_t>(node)); }

  std::vector<Given> given_;  // to each node
};

}  // namespace mars::farm
