// The sums over a group in a keyframe, in one message exchange: EBC, and the memory that each node's own triangles
// take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"

namespace mars::group {

class GroupSums {
 public:
  // `lines`: of a picture; `nodes`: the most a group has.
  GroupSums(std::size_t lines, std::size_t nodes);

  // Collective over the group. `line_counts`: edge boxes a line of the caller's triangles; `own_bytes`: the memory that
  // these take (own_bytes, passes.h).
  void add_up(const collectives::Group& group, std::span<const std::uint32_t> line_counts, std::uint64_t own_bytes);

  // EBC of all nodes: lines + 1 running totals, as mapping.h wants them.
  std::span<const std::uint64_t> ebc() const { return ebc_; }
  // Of each node of the group.
  std::span<const std::uint64_t> own_bytes() const { return own_bytes_; }

 private:
  std::vector<double> sent_;  // running totals of line_counts, then for each node its own_bytes, or 0 if another's
  std::vector<double> work_;
  std::vector<std::uint64_t> ebc_;
  std::vector<std::uint64_t> own_bytes_;
};

}  // namespace mars::group
