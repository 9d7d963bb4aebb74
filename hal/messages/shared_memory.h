// Memory that all nodes of one machine see, so that data that are the same for all (the patches of a film) are stored
// once a machine. The host takes no part. Memory that one rank offers to others: offered_memory.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "hal/messages/neighbourhood.h"

namespace mars::messages {

// The nodes that share memory with the calling node: those of its machine or, where `refusal` says why they cannot, the
// calling node alone.
Neighbourhood neighbourhood();

// All nodes of the calling node's machine, whether they share memory or not.
Neighbourhood machine_neighbourhood();

// `bytes` bytes (aligned to 64, with anything in them) that all nodes of neighbourhood() see; the machine gives pages
// as they are first touched, so there may be far more bytes than memory. Making one is collective: all these nodes do
// it at the same point of their work, with the same `bytes`. Each lets go by itself. The users order writes and reads,
// by messages or gsync. Throws a Failure on all of them when one of them cannot have that much.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t bytes);
  // A replica where there are such.
  SharedMemory(std::uint64_t key, std::size_t bytes);

  std::span<std::byte> bytes() const { return {block_.get(), size_}; }

  // As PrivateMemory's. Each node asks for itself.
  void prefer_large_pages();

 private:
  std::shared_ptr<std::byte> block_;
  std::size_t size_;
};

// Memory into which all ranks write the same, whatever machine they are on: one for all of them where machines are
// simulated, else nullptr. Not collective.
std::shared_ptr<std::byte> replica(std::uint64_t key, std::size_t bytes);

}  // namespace mars::messages
