// The film on its way to the nodes: Load to each, the film block to the first, from which the others get it.
#pragma once

#include <cstddef>
#include <span>

#include "host/render/farm/node_inbox.h"

namespace mars::farm {

// `load` without stamp and sizes, which are added; `orders`: for nodes' frame writers, none where nodes have none.
// Waits until all nodes have the film; false: cancelled before.
bool load_film(std::span<const std::byte> block, wire::Load load, NodeInbox& inbox,
               std::span<const std::byte> orders = {});

}  // namespace mars::farm
