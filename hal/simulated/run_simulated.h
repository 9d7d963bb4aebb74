// Runs a host and its nodes on a simulated machine, in this process.
#pragma once

#include <functional>

#include "hal/simulated/machine.h"
#include "hal/simulated/world.h"

namespace mars::simulated {

// Runs `host_body` as the host on the calling thread and `node_body` on a thread for each of `nodes` nodes, one at a
// time. NX calls work in them, and dclock() is simulated. Returns the time at which all had ended. If one throws, the
// others' NX calls throw too, all end, and the first failure is thrown here. `host_body` may give its World work that
// is none of a rank's (World::reserve).
double run_simulated(const Machine& machine, int nodes, const std::function<void(World&)>& host_body,
                     const std::function<void()>& node_body);

}  // namespace mars::simulated
