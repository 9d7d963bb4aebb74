// What a transport gives for memory that one rank offers to others (offered_memory.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace mars::messages {

// Names memory that a rank has offered. Plain bytes, for any message; what they mean is the transport's.
struct MemoryName {
  std::array<std::uint64_t, 4> words;

  bool operator==(const MemoryName&) const = default;
};

struct Offer {
  MemoryName name{};
  std::shared_ptr<std::byte> block;  // null: the machine does not give that much
};

}  // namespace mars::messages
