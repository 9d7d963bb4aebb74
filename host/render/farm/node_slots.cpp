#include "host/render/farm/node_slots.h"

#include "hal/nx/nx_messages.h"

namespace mars::farm {

NodeSlots::NodeSlots(int nodes, std::int32_t credits, wire::PixelFormat format)
    : credits_(static_cast<std::uint32_t>(credits)),
      slot_bytes_(wire::slot_bytes(format)),
      nodes_(static_cast<std::size_t>(nodes)) {}

void NodeSlots::attach(int node, const messages::MemoryName& name) {
  nodes_.at(static_cast<std::size_t>(node)).memory =
      messages::AttachedMemory::attach(node, name, credits_ * slot_bytes_);
}

void NodeSlots::give_all() {
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(nodes_.size()); ++node)
    for (std::uint32_t slot = 0; slot < credits_; ++slot) give({node, slot});
}

void NodeSlots::give(const NodeSlot& slot) {
  nodes_.at(static_cast<std::size_t>(slot.node)).owned |= std::uint32_t{1} << slot.slot;
  const wire::Credit credit{slot.slot, attached(slot.node) ? 0u : 1u};
  csend(wire::kCredit, &credit, sizeof credit, slot.node, 0);
}

bool NodeSlots::take(const NodeSlot& slot) {
  if (slot.slot >= credits_) return false;
  std::uint32_t& owned = nodes_.at(static_cast<std::size_t>(slot.node)).owned;
  const std::uint32_t bit = std::uint32_t{1} << slot.slot;
  const bool was_owned = (owned & bit) != 0;
  owned &= ~bit;
  return was_owned;
}

std::span<const std::byte> NodeSlots::bytes(const NodeSlot& slot) const {
  return of(slot.node).memory->bytes().subspan(slot.slot * slot_bytes_, slot_bytes_);
}

}  // namespace mars::farm
