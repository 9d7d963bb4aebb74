// The node program: boots, introduces itself (Hello), then executes the host's commands until Stop.
#pragma once

#include "node/node_identity.h"

namespace mars::node {

// Runs the calling HAL process as a node. Returns after Stop. A failure goes to the host first (Fault), then is thrown;
// where the host is dead it is thrown at once (heartbeat.h).
void run_node(const NodeIdentity& identity);

}  // namespace mars::node
