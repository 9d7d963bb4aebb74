// The parts of all nodes put together on each of them, in order of positions, by dimension exchange.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/collectives/dimension_exchange.h"

namespace mars::collectives {

// The part of position p is bytes [offsets[p], offsets[p + 1]) of y. Gathers all parts on all nodes, each node's own
// being in place already. All members call with the same offsets.
void gather(DimensionExchange& exchange, void* y, const std::vector<std::size_t>& offsets);

}  // namespace mars::collectives
