// The sums and maxima of a group of nodes. NX's own g* calls always take the whole machine; these take the
// group's nodes, by dimension exchange over the hypercube that they form (nodes beyond the largest power of
// two fold in first).
#pragma once

#include <span>

#include "hal/collectives/group.h"

namespace mars::collectives {

// Element-wise sum of every member's `values`, left in `values` on all of them. All members call, in the
// same order, with equal lengths; `work` is as long as `values`. Every member gets the same bits. Order of
// the additions, with positions counted from `first` and 2^d the largest power of two within `count`: first
// p and p + 2^d, then pairs across bit 0, 1, ... d - 1 of the positions, the lower one's sum always on the
// left.
void group_sum(const Group& group, std::span<double> values, std::span<double> work);

// Element-wise maximum, likewise.
void group_high(const Group& group, std::span<double> values, std::span<double> work);

}  // namespace mars::collectives
