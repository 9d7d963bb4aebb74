// The sums and maxima of a group of nodes. NX's own g* calls always take the whole machine; these take the
// group's nodes, by dimension exchange over the hypercube that they form (nodes beyond the largest power of
// two fold in first).
#pragma once

#include <cstdint>
#include <span>

#include "hal/collectives/group.h"

namespace mars::collectives {

// Element-wise sum of every member's `values`, left in `values` on all of them. All members call, in the
// same order, with equal lengths; `work` is as long as `values`. Sums are modulo 2^64.
void group_sum(const Group& group, std::span<std::uint64_t> values, std::span<std::uint64_t> work);

// Element-wise maximum, in the same way.
void group_high(const Group& group, std::span<std::uint64_t> values, std::span<std::uint64_t> work);

}  // namespace mars::collectives
