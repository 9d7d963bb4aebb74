// Nodes of one process as if they lay on several machines: on each machine so many, in order of their ids.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "tests/hal/counting_backend.h"

namespace mars::hal {

// Shared by all ranks of a run.
class Machines {
 public:
  explicit Machines(int nodes_each) : nodes_each_(nodes_each) {}

  Neighbourhood of(int node, int nodes) const {
    const int first = node / nodes_each_ * nodes_each_;
    return {first, node - first, std::min(nodes_each_, nodes - first), node, false};
  }
  // Block number `number` of a machine, of which each of its nodes gets its part.
  std::shared_ptr<std::byte> share(int machine, int number, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    auto& block = blocks_[{machine, number}];
    if (!block) block = {new (std::align_val_t{64}) std::byte[bytes], Release()};
    return block;
  }

 private:
  struct Release {
    void operator()(std::byte* block) const { ::operator delete[](block, std::align_val_t{64}); }
  };
  int nodes_each_;
  std::mutex mutex_;
  std::map<std::pair<int, int>, std::shared_ptr<std::byte>> blocks_;
};

class MachinesBackend : public CountingBackend {
 public:
  MachinesBackend(Backend& inner, Counts& counts, Machines& machines) : CountingBackend(inner, counts), machines_(machines) {}

  Neighbourhood neighbourhood() override { return machines_.of(rank(), nodes()); }
  std::shared_ptr<std::byte> share(std::size_t bytes) override {
    return machines_.share(neighbourhood().machine, shared_++, bytes);
  }

 private:
  Machines& machines_;
  int shared_ = 0;
};

}  // namespace mars::hal
