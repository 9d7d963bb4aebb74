// The node program: boots, introduces itself (Hello), then obeys the host's commands until Stop.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace mars::node {

// Facts that the node is given: it opens no file and reads no environment.
struct NodeIdentity {
  std::string host;                  // name of its machine
  std::string binding;               // processors it is bound to, as text; "" if free
  std::array<std::int32_t, 5> seat;  // as in Hello
  std::uint64_t memory;              // bytes it may use for triangles and edge boxes of its frames
  std::string simd;                  // widest instruction set allowed, "" for any (best_instruction_set)
};

// Runs the calling HAL process as a node. Returns after Stop. A failure goes to the host first (Fault), then is thrown.
void run_node(const NodeIdentity& identity);

}  // namespace mars::node
