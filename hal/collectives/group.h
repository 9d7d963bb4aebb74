// Nodes [first, first + count) that work on one interval together, and the sums they make. NX's own g*
// calls always take the whole machine; these are built from csend and crecv, by dimension exchange over
// the hypercube that the group's nodes form (nodes beyond the largest power of two fold in first).
#pragma once

#include <span>

namespace mars::hal {

struct Group {
  int first = 0;
  int count = 1;

  bool operator==(const Group&) const = default;
};

// Number `number` of `groups` groups of about equal size that `nodes` nodes form side by side.
constexpr Group group_of(int nodes, int groups, int number) {
  const int first = nodes * number / groups;
  return {first, nodes * (number + 1) / groups - first};
}

// Element-wise sum of every member's `values`, left in `values` on all of them. All members call, in the
// same order, with equal lengths; `work` is as long as `values`. Every member gets the same bits. Order of
// the additions, with positions counted from `first` and 2^d the largest power of two within `count`: first
// p and p + 2^d, then pairs across bit 0, 1, ... d - 1 of the positions, the lower one's sum always on the
// left.
void group_sum(const Group& group, std::span<double> values, std::span<double> work);

// Element-wise maximum, likewise.
void group_high(const Group& group, std::span<double> values, std::span<double> work);

}  // namespace mars::hal
