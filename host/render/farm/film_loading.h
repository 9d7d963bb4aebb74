// The film on its way to the nodes: Load to each, the film block to the first, from which the others get it.
#pragma once

#include <cstddef>
#include <span>

#include "host/render/farm/node_inbox.h"

namespace mars::farm {

// `load` without stamp and film's size, which are added. Waits until all nodes have the film; false: cancelled before.
bool load_film(std::span<const std::byte> block, wire::Load load, NodeInbox& inbox);

}  // namespace mars::farm
