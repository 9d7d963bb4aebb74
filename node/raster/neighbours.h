// The nodes of each group that are on one machine, the same on all nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "hal/messages/private_memory.h"
#include "hal/messages/shared_memory.h"

namespace mars::raster {

class Neighbours {
 public:
  // Of the caller, one of the nodes, each on its machine, that form `groups` groups side by side.
  Neighbours(std::span<const std::int32_t> machines, int groups);

  // The caller's.
  const collectives::Group& group() const { return group_; }
  // The first of the group's nodes on the machine of `node`, one of them.
  int head_of(int node) const { return heads_[static_cast<std::size_t>(node - group_.first)]; }
  bool are(int a, int b) const { return head_of(a) == head_of(b); }
  // Of the caller's group on its machine, in order, itself among them.
  std::span<const int> nodes() const { return nodes_; }
  // The most that any group has on a machine.
  std::size_t most() const { return most_; }

 private:
  friend class NeighboursMemory;

  static constexpr std::uint64_t kFirstReplica = 1;

  collectives::Group group_;
  std::vector<int> heads_;  // by node of the group
  std::vector<int> nodes_;
  std::size_t most_ = 0;
  std::size_t shared_blocks_ = 0;  // of the caller's machine: groups with several nodes there
  std::size_t own_block_ = 0;      // the caller's group's number among them
};

// Memory that a group's nodes on a machine share; of a node that is alone there, its own.
class NeighboursMemory {
 public:
  // What all machines of a group have the same, or each its own.
  enum class Contents { own, same };

  // `bytes` for each group with several nodes here, `alone` for a node that is alone. The machine gives pages as they
  // are first touched. Collective over a machine's nodes, all of which it throws Failure on where the machine does not
  // let them share that much.
  NeighboursMemory(const Neighbours& neighbours, std::size_t bytes, std::size_t alone, Contents contents);

  std::span<std::byte> bytes() const { return block_; }
  // As PrivateMemory's.
  void prefer_large_pages();

 private:
  std::shared_ptr<std::byte> replica_;            // of simulated machines that have the same
  std::optional<messages::SharedMemory> shared_;  // all that nodes of this machine share
  messages::PrivateMemory own_;
  std::span<std::byte> block_;
};

}  // namespace mars::raster
