// Runs a host and its nodes as threads of this process: the start of the threads backend.
#pragma once

#include <functional>
#include <memory>

#include "hal/messages/backend.h"

namespace mars::threads {

// Something put between a rank's process and its backend, which outlives it (to count, to delay ...).
using WrapBackend = std::function<std::unique_ptr<messages::Backend>(messages::Backend& backend)>;

// Runs `host_body` as the host on the calling thread and `node_body` on a thread for each of `nodes` nodes,
// in which NX calls work. Returns when all have ended. If one throws, the others' NX calls throw too, all
// end, and the first failure is thrown here; a body that makes no NX call is waited for.
void run_threads(int nodes, const std::function<void()>& host_body, const std::function<void()>& node_body,
                 const WrapBackend& wrap = {});

}  // namespace mars::threads
