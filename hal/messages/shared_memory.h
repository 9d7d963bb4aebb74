// Memory that all nodes of one machine see, so that what is the same for all (the patches of a film) is
// stored once a machine. The host takes no part.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace mars::hal {

// The nodes of this node's machine.
struct Neighbourhood {
  int machine = 0;      // lowest node id on it
  int index = 0;        // of this node among them, in order of node id
  int count = 1;        // of them
  int rank = 0;         // of this node for whoever started it (MPI's)
  bool placed = false;  // whoever started them gave them processors of their own: do not bind them again
};

// Of the calling node.
Neighbourhood neighbourhood();

// `bytes` bytes (aligned to 64, with anything in them) that all nodes of one machine see; the machine gives pages as
// they are first touched. Making and destroying one are
// collective: all nodes of the machine do it at the same point of their work, with the same `bytes`. Who
// writes what, and when others may read it, is the users' affair (messages and gsync order it). Throws a Failure on all
// of them when the machine cannot give that much.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t bytes);

  std::span<std::byte> bytes() const { return {block_.get(), size_}; }

 private:
  std::shared_ptr<std::byte> block_;
  std::size_t size_;
};

}  // namespace mars::hal
