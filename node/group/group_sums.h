// The sums over a group in a keyframe, in one message exchange: what there is to draw on each line (EBC), how many
// nodes might be short of memory, and how long the exchange of triangles takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/geometry/line_range.h"
#include "node/group/exchange_times.h"
#include "node/raster/line_load.h"
#include "node/wire/protocol.h"

namespace mars::group {

// A node's part of the sums.
struct OwnLoad {
  std::span<const raster::LineLoad> lines;  // of its own triangles
  std::uint64_t edge_boxes;                 // on all lines
  bool large;                               // these take much of its memory (is_large, passes.h)
  // Of each line, about what is kept for inbetweens; the same on all nodes. Empty: nothing.
  std::span<const std::uint64_t> still_bytes{};
  ExchangeTimes exchange{};
};

class GroupSums {
 public:
  // `lines`: of a picture.
  explicit GroupSums(std::size_t lines);

  // Collective over the group. Throws Failure, on all nodes of the group, where one line of all nodes together exceeds
  // what a LineLoad counts; for certain if they have fewer than 2^50 edge boxes.
  void add_up(const collectives::Group& group, const OwnLoad& own);

  // EBC of all nodes: lines + 1 running totals.
  std::span<const std::uint64_t> ebc() const { return ebc_; }
  // The running totals that a mapping makes even (mapping.h): EBC, or for `cost` those of line_cost.
  std::span<const std::uint64_t> weights(wire::Mapping mapping) const {
    return mapping == wire::Mapping::cost ? costs_ : ebc_;
  }
  // Of all nodes, that edge boxes cover on these lines.
  std::uint64_t samples_on(const geometry::LineRange& range) const;
  // Nodes whose load is large.
  std::uint64_t large() const { return sums_[ebc_.size()]; }
  // Of all nodes.
  ExchangeTimes exchange() const { return {sums_[ebc_.size() + 1], sums_[ebc_.size() + 2]}; }

 private:
  void check_bounds(std::uint64_t edge_boxes) const;

  std::vector<std::uint64_t> sums_;  // wire::summed_words
  std::vector<std::uint64_t> work_;
  std::vector<std::uint64_t> ebc_;
  std::vector<std::uint64_t> costs_;
};

}  // namespace mars::group
