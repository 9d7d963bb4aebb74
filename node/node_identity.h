// What a node learns of itself and of its machine from the program that it runs in.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "node/wire/frame_writer.h"

namespace mars::node {

// Whether a debugger has a process of this machine.
using IsTraced = std::function<bool(std::int32_t process)>;

// Facts that the node is given: it opens no file and reads no environment.
struct NodeIdentity {
  std::string host;                  // name of its machine
  std::string binding;               // processors it is bound to, as text; "" if free
  std::array<std::int32_t, 5> seat;  // as in Hello
  std::uint64_t memory;              // bytes it may use for triangles and edge boxes of its frames
  std::string simd;                  // widest instruction set allowed, "" for any (best_instruction_set)
  std::int32_t process = 0;          // its number on its machine
  IsTraced is_traced = nullptr;      // none: no process is
  wire::MakeFrameWriter make_frame_writer = nullptr;  // none: it sends all frames to the host
};

}  // namespace mars::node
