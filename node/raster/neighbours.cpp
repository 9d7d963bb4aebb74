#include "node/raster/neighbours.h"

#include <algorithm>

#include "hal/nx/nx_messages.h"

namespace mars::raster {

Neighbours::Neighbours(std::span<const std::int32_t> machines, int groups) {
  const auto nodes = static_cast<int>(machines.size()), self = static_cast<int>(mynode());
  const auto machine_of = [&](int node) { return static_cast<std::size_t>(machines[static_cast<std::size_t>(node)]); };
  std::vector<int> heads(machines.size(), -1);       // of the group in hand, by machine
  std::vector<std::size_t> counts(machines.size());  // of a head's neighbours
  for (int number = 0; number < groups; ++number) {
    const collectives::Group group = collectives::group_of(nodes, groups, number);
    const bool own = group.first <= self && self < group.first + group.count;
    if (own) group_ = group;
    for (int node = group.first; node < group.first + group.count; ++node) {
      int& head = heads[machine_of(node)];
      if (head < group.first) head = node;
      most_ = std::max(most_, ++counts[static_cast<std::size_t>(head)]);
      if (own) heads_.push_back(head);
    }
    const int here = heads[machine_of(self)];
    if (own) own_block_ = shared_blocks_;
    shared_blocks_ += here >= group.first && counts[static_cast<std::size_t>(here)] > 1;
  }
  for (int node = group_.first; node < group_.first + group_.count; ++node)
    if (are(node, self)) nodes_.push_back(node);
}

NeighboursMemory::NeighboursMemory(const Neighbours& neighbours, std::size_t bytes, std::size_t alone,
                                   Contents contents) {
  if (contents == Contents::same)
    replica_ = messages::replica(Neighbours::kFirstReplica + static_cast<std::uint64_t>(neighbours.group().first),
                                 std::max(bytes, alone));
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
  if (!own_.bytes().empty())
    own_.prefer_large_pages();
  else if (shared_)
    shared_->prefer_large_pages();
}

}  // namespace mars::raster
