// What messages cost between two nodes of a job that runs here, over whichever transport it has.
#pragma once

#include <functional>

namespace mars::experiments {

struct MessageCosts {
  double latency = 0;  // seconds on the way of a message, beside its ends
  double rate = 0;     // bytes a second of long ones
  double end = 0;      // seconds of the processor at each end
};

// What nodes 0 and 1 do, and what the others and the host need not. Node 0 sends the costs to the host.
void exchange_messages();
// What the host does.
MessageCosts receive_costs();

}  // namespace mars::experiments
