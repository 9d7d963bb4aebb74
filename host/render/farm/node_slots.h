// The slots in which nodes make their strips (node/wire/protocol.h): whose each is now, and where it lies, if the host
// sees it. A node that fails may write into its slots at any time, so nothing but pixels may depend on what is there.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hal/messages/offered_memory.h"
#include "node/wire/protocol.h"

namespace mars::farm {

struct NodeSlot {
  std::int32_t node;
  std::uint32_t slot;

  bool operator==(const NodeSlot&) const = default;
};

class NodeSlots {
 public:
  // `credits` slots of each node, for strips of this format. All are the host's.
  NodeSlots(int nodes, std::int32_t credits, wire::PixelFormat format = wire::PixelFormat::rgb8);

  // The node's slots have this name. Where the host cannot see them, its strips come by message.
  void attach(int node, const messages::MemoryName& name);
  bool attached(int node) const { return of(node).memory.has_value(); }

  // All slots go to their nodes.
  void give_all();
  // Sends the credit that gives a slot to its node.
  void give(const NodeSlot& slot);
  // A strip came in it: it is the host's again. False: it was not the node's.
  bool take(const NodeSlot& slot);

  // How many are the node's.
  std::size_t owned(int node) const { return static_cast<std::size_t>(std::popcount(of(node).owned)); }

  // What lies in a slot of a node that is attached.
  std::span<const std::byte> bytes(const NodeSlot& slot) const;

 private:
  struct Node {
    std::optional<messages::AttachedMemory> memory;
    std::uint32_t owned = 0;  // a bit for each slot that is the node's
  };

  const Node& of(int node) const { return nodes_.at(static_cast<std::size_t>(node)); }

  std::uint32_t credits_;
  std::size_t slot_bytes_;
  std::vector<Node> nodes_;
};

}  // namespace mars::farm
