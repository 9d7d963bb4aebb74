// What messages and collectives take on simulated nodes.
#pragma once

namespace mars::times {

// Called by all nodes: node 0 prints a line each, of what, bytes and simulated microseconds.
void measure_all();

}  // namespace mars::times
