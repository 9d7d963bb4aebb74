#include "topology/placement.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <map>
#include <numeric>
#include <tuple>

#include "topology/hypercube.h"

namespace mars::topology {

std::string_view text_of(Closeness closeness) {
  constexpr std::array<std::string_view, 7> words{"a core",    "an L2 cache", "an L3 cache", "a NUMA domain",
                                                  "a package", "the machine", "the network"};
  return words[static_cast<std::size_t>(closeness)];
}

Closeness closeness(const Location& a, const Location& b) {
  if (a.machine != b.machine) return Closeness::network;
  for (int part = 0; part < kParts; ++part)
    if (a.seat[part] >= 0 && a.seat[part] == b.seat[part]) return static_cast<Closeness>(part);
  return Closeness::machine;
}

std::vector<Closeness> dimensions(std::span<const Location> nodes) {
  const int count = static_cast<int>(nodes.size());
  std::vector<Closeness> furthest(dimension(count), Closeness::core);
  for (int node = 0; node < count; ++node) {
    for (int d = 0; d < static_cast<int>(furthest.size()); ++d) {
      const int other = neighbour(node, d);
      if (other < count) furthest[d] = std::max(furthest[d], closeness(nodes[node], nodes[other]));
    }
  }
  return furthest;
}

std::vector<int> number_nodes(std::span<const Spot> processes) {
  std::map<int, unsigned> count;  // processes of each machine
  std::map<int, int> first;       // process of each machine
  for (int i = 0; i < static_cast<int>(processes.size()); ++i) {
    ++count[processes[i].machine];
    first.try_emplace(processes[i].machine, i);
  }
  std::vector<int> order(processes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto rank = [&](int i) {
    const Spot& spot = processes[i];
    return std::tuple(-std::countr_zero(count[spot.machine]), first[spot.machine], spot.core, i);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
  std::vector<int> ids(processes.size());
  for (int id = 0; id < static_cast<int>(order.size()); ++id) ids[order[id]] = id;
  return ids;
}

}  // namespace mars::topology
