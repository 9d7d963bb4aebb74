#include "host/experiments/forecast/computers.h"

#include <algorithm>
#include <cstddef>

namespace mars::forecast {

Computers::Computers(const simulated::Machine& machine, int nodes)
    : machine_(machine),
      nodes_(nodes),
      busy_(static_cast<std::size_t>(count()), std::vector<double>(static_cast<std::size_t>(machine.processors))) {
  if (machine.host_apart) busy_.emplace_back(static_cast<std::size_t>(machine.host_processors));
}

int Computers::of(int rank) const {
  if (rank < nodes_) return rank / machine_.nodes;
  return machine_.host_apart ? count() : 0;
}

bool Computers::crowded(int computer) const {
  const int nodes = std::clamp(nodes_ - computer * machine_.nodes, 0, machine_.nodes);
  const int ranks = nodes + (of(nodes_) == computer ? 1 : 0);
  return ranks > static_cast<int>(busy_[static_cast<std::size_t>(computer)].size());
}

double Computers::work(int rank, double now, double seconds) {
  return crowded(of(rank)) ? reserve(rank, now, seconds) : now + seconds;
}

double Computers::reserve(int rank, double now, double seconds) {
  double& free = *std::ranges::min_element(busy_[static_cast<std::size_t>(of(rank))]);
  return free = std::max(now, free) + seconds;
}

}  // namespace mars::forecast
