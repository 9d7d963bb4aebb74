// The node program: boots, says who it is, and then only obeys the host's commands until it is told to stop.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace mars::node {

// What a node cannot find out for itself, opening no file and reading no environment.
struct NodeIdentity {
  std::string host;                  // name of its machine
  std::string binding;               // processors it is bound to, as text; "" if free
  std::array<std::int32_t, 5> seat;  // as in Hello
  std::uint64_t memory;              // bytes it may use for one frame's triangles and edge boxes
  std::string simd;                  // widest instruction set allowed, "" for any (best_instruction_set)
};

// Runs the calling HAL process as a node. Returns when the host says stop; a failure is first told to the host.
void run_node(const NodeIdentity& identity);

}  // namespace mars::node
