#include "node/raster/neighbours.h"

#include <algorithm>

#include "hal/collectives/group.h"
#include "hal/nx/nx_messages.h"

namespace mars::raster {

Neighbours::Neighbours(std::span<const std::int32_t> machines, int groups) {
  const auto nodes = static_cast<int>(machines.size()), self = static_cast<int>(mynode());
  const auto machine = [&](int node) { return machines[static_cast<std::size_t>(node)]; };
  std::vector<std::size_t> counts(machines.size());  // of a head's neighbours
  for (int number = 0; number < groups; ++number) {
    const collectives::Group group = collectives::group_of(nodes, groups, number);
    if (self >= group.first) group_ = static_cast<std::uint64_t>(group.first);
    for (int node = group.first; node < group.first + group.count; ++node) {
      int head = group.first;
      while (machine(head) != machine(node)) ++head;
      heads_.push_back(head);
      most_ = std::max(most_, ++counts[static_cast<std::size_t>(head)]);
    }
  }
  for (int head = 0; head < nodes; ++head) {
    if (head == head_of(self)) own_block_ = shared_blocks_;
    shared_blocks_ += machine(head) == machine(self) && counts[static_cast<std::size_t>(head)] > 1;
  }
  for (int node = 0; node < nodes; ++node)
    if (are(node, self)) nodes_.push_back(node);
}

NeighboursMemory::NeighboursMemory(const Neighbours& neighbours, std::size_t bytes, std::size_t alone,
                                   Contents contents) {
  if (contents == Contents::same)
    replica_ = messages::replica(Neighbours::kFirstReplica + neighbours.group_, std::max(bytes, alone));
  if (replica_ != nullptr) {
    block_ = {replica_.get(), neighbours.nodes().size() > 1 ? bytes : alone};
    return;
  }
  if (neighbours.shared_blocks_ > 0) shared_.emplace(neighbours.shared_blocks_ * bytes);
  if (neighbours.nodes().size() > 1) {
    block_ = shared_->bytes().subspan(neighbours.own_block_ * bytes, bytes);
  } else {
    own_ = messages::PrivateMemory(alone);
    block_ = own_.bytes();
  }
}

void NeighboursMemory::prefer_large_pages() {
  if (replica_ != nullptr) return;
  if (own_.bytes().empty())
    shared_->prefer_large_pages();
  else
    own_.prefer_large_pages();
}

}  // namespace mars::raster
