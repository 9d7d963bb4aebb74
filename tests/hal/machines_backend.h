// Nodes of one process as if they lay on several machines: an equal number on each, in order of their ids. The host is
// on the first one.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <utility>

#include "tests/hal/counting_backend.h"

namespace mars::messages {

// Shared by all ranks of a run.
class Machines {
 public:
  explicit Machines(int nodes_each) : nodes_each_(nodes_each) {}

  Neighbourhood of(int node, int nodes) const {
    const int first = node / nodes_each_ * nodes_each_;
    return {first, node - first, std::min(nodes_each_, nodes - first), node, false};
  }
  bool on_one(int rank, int other, int nodes) const {
    const auto machine = [&](int each) { return each == nodes ? 0 : each / nodes_each_; };
    return machine(rank) == machine(other);
  }
  // Block number `number` of a machine, of which each of its nodes gets its part. In CZB's every float is not a number.
  std::shared_ptr<std::byte> share(int machine, int number, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    Block& block = blocks_[{machine, number}];
    if (!block.bytes) {
      block = {{new (std::align_val_t{64}) std::byte[bytes], Release()}, bytes};
      if (number == kCzb) std::fill_n(block.bytes.get(), bytes, kUntouched);
    }
    return block.bytes;
  }

  // Bytes of all machines' CZB, and how many of them were written.
  std::size_t shared() const {
    return add_up([](const Block& block) { return block.size; });
  }
  std::size_t written() const {
    return shared() - add_up([](const Block& block) {
             return static_cast<std::size_t>(std::count(block.bytes.get(), block.bytes.get() + block.size, kUntouched));
           });
  }

 private:
  struct Release {
    void operator()(std::byte* block) const { ::operator delete[](block, std::align_val_t{64}); }
  };
  struct Block {
    std::shared_ptr<std::byte> bytes;
    std::size_t size = 0;
  };
  static constexpr std::byte kUntouched{0xff};
  static constexpr int kCzb = 2;  // the film's block and frames' memory come before

  template <typename Count>
  std::size_t add_up(const Count& count) const {
    std::size_t sum = 0;
    for (const auto& [key, block] : blocks_)
      if (key.second == kCzb) sum += count(block);
    return sum;
  }

  int nodes_each_;
  std::mutex mutex_;
  std::map<std::pair<int, int>, Block> blocks_;  // by machine and number
};

class MachinesBackend : public CountingBackend {
 public:
  MachinesBackend(Backend& inner, Counts& counts, Machines& machines)
      : CountingBackend(inner, counts), machines_(machines) {}

  Neighbourhood neighbourhood() override { return machines_.of(rank(), nodes()); }
  std::shared_ptr<std::byte> share(std::size_t bytes) override {
    return machines_.share(neighbourhood().machine, shared_++, bytes);
  }

  std::shared_ptr<std::byte> attach(int other, const MemoryName& name, std::size_t bytes) override {
    return machines_.on_one(rank(), other, nodes()) ? CountingBackend::attach(other, name, bytes) : nullptr;
  }

 private:
  Machines& machines_;
  int shared_ = 0;
};

}  // namespace mars::messages
