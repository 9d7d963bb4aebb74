// What a node's rank does in every program that has nodes: finds out what the firmware cannot know, binds
// itself where it has processors of its own, and runs it.
#pragma once

#include <cstdint>

namespace mars::programs {

// Left to the host's sinks on a machine that has more cores than nodes.
inline constexpr int kCoresForHost = 1;

// Throws Failure where this process may have too few addresses (ulimit -v) for this number of nodes as threads: the
// libraries below would end it without a message.
void check_memory_limit(std::uint32_t nodes);

// `threads`: of the nodes, how many are threads of this process.
void run_node_job(std::uint32_t threads = 1);

}  // namespace mars::programs
