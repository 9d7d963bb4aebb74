// By which means the nodes' collectives work.
#pragma once

namespace mars::messages {

enum class CollectiveMethod {
  automatic,  // what was measured to be quicker: docs/messages.md
  cube,       // messages across the dimensions of the cube
  network,    // the network's own, where the backend has them
};

}  // namespace mars::messages
