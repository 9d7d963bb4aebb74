// Which nodes of a group receive for their machine what inbetweens need: of each machine that has contributors, nodes
// that draw inbetweens, the head (raster/neighbours.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/collectives/group.h"
#include "hal/nx/nx_messages.h"
#include "node/raster/neighbours.h"

namespace mars::group {

class Collectors {
 public:
  // `contributes`: of all the group's nodes, 1 for contributors; `collects`: as many, to be used. All outlive it.
  Collectors(const collectives::Group& group, std::span<const std::uint8_t> contributes,
             const raster::Neighbours& neighbours, std::span<std::uint8_t> collects)
      : group_(group), contributes_(contributes), neighbours_(neighbours), collects_(collects) {
    std::ranges::fill(collects_, std::uint8_t{0});
    for (int node = first(); node < last(); ++node)
      if (contributes_[index(node)] == 1) collects_[index(neighbours_.head_of(node))] = 1;
  }
  Collectors(const collectives::Group&&, auto&&...) = delete;
  Collectors(auto&&, auto&&, const raster::Neighbours&&, auto&&...) = delete;

  int self() const { return static_cast<int>(mynode()); }
  int first() const { return group_.first; }
  int last() const { return group_.first + group_.count; }
  std::size_t index(int node) const { return static_cast<std::size_t>(node - group_.first); }

  bool has(int node) const { return node >= first() && node < last(); }
  bool contributes(int node) const { return contributes_[index(node)] == 1; }
  bool share_a_machine(int a, int b) const { return neighbours_.are(a, b); }
  int head_of(int node) const { return neighbours_.head_of(node); }
  // Whether it is the head of a machine with contributors.
  bool collects(int node) const { return collects_[index(node)] == 1; }

  // Calls notify(node) for each other contributor on the caller's machine.
  template <typename Notify>
  void for_others_here(Notify notify) const {
    for (int node = first(); node < last(); ++node)
      if (node != self() && contributes(node) && share_a_machine(self(), node)) notify(node);
  }

 private:
  const collectives::Group& group_;
  const std::span<const std::uint8_t> contributes_;
  const raster::Neighbours& neighbours_;
  const std::span<std::uint8_t> collects_;
};

}  // namespace mars::group
