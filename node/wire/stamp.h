// The first 16 bytes of the first message either way (Hello from a node, Load from the host). They never change,
// whatever a later version sends behind them, so that every version recognises any other:
//
//   bytes 0-3     "MARS"
//         4-7     kByteOrder as the sender stores it
//         8       version of the wire, raised whenever a message changes
//         9-11    version of MARS: major, minor, patch
//         12-15   hash of the sizes of the structs in messages and in the film, as the sender stores it
//
// In Hello the name of the node's machine follows, 64 bytes, zero-ended; that never changes either.
#pragma once

#include <array>
#include <cstdint>

namespace mars::wire {

inline constexpr std::uint8_t kWireVersion = 17;
inline constexpr std::uint32_t kByteOrder = 0x01020304;

struct WireStamp {
  std::array<char, 4> magic;
  std::uint32_t byte_order;
  std::uint8_t wire;
  std::array<std::uint8_t, 3> release;
  std::uint32_t sizes;

  bool operator==(const WireStamp&) const = default;
};
static_assert(sizeof(WireStamp) == 16);

}  // namespace mars::wire
