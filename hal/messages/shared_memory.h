// Memory that all nodes of one machine see, so that data that are the same for all (the patches of a film) are stored
// once a machine. The host takes no part.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "hal/messages/neighbourhood.h"

namespace mars::messages {

// Of the calling node.
Neighbourhood neighbourhood();

// `bytes` bytes (aligned to 64, with anything in them) that all nodes of one machine see; the machine gives pages as
// they are first touched. Making and destroying one are collective: all nodes of the machine do it at the same point of
// their work, with the same `bytes`. The users order writes and reads, by messages or gsync. Throws a Failure on all of
// them when the machine cannot give that much.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t bytes);

  std::span<std::byte> bytes() const { return {block_.get(), size_}; }

 private:
  std::shared_ptr<std::byte> block_;
  std::size_t size_;
};

}  // namespace mars::messages
