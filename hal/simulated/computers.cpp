#include "hal/simulated/computers.h"

#include <algorithm>
#include <cstddef>

namespace mars::simulated {

Computers::Computers(const Machine& machine, int nodes)
    : machine_(machine),
      nodes_(nodes),
      pace_(machine, count()),
      busy_(static_cast<std::size_t>(count()), std::vector<double>(static_cast<std::size_t>(machine.processors))) {
  if (machine.host_apart) busy_.emplace_back(static_cast<std::size_t>(machine.host_processors));
}

int Computers::of(int rank) const {
  if (rank < nodes_) return rank / machine_.nodes;
  return machine_.host_apart ? count() : 0;
}

int Computers::nodes_on(int computer) const {
  return std::clamp(nodes_ - computer * machine_.nodes, 0, machine_.nodes);
}

bool Computers::crowded(int computer) const {
  const int ranks = nodes_on(computer) + (of(nodes_) == computer ? 1 : 0);
  return ranks > static_cast<int>(busy_[static_cast<std::size_t>(computer)].size());
}

bool Computers::any_crowded() const {
  bool any = false;
  for (std::size_t computer = 0; computer < busy_.size(); ++computer) any |= crowded(static_cast<int>(computer));
  return any;
}

double Computers::work(int rank, double now, double seconds) {
  const int computer = of(rank);
  return crowded(computer) ? reserve(rank, now, seconds) : pace_.end({computer, own_processor(rank)}, now, seconds);
}

double Computers::reserve(int rank, double now, double seconds) {
  const int computer = of(rank);
  std::vector<double>& busy = busy_[static_cast<std::size_t>(computer)];
  const auto free = std::ranges::min_element(busy);
  return *free = pace_.end({computer, static_cast<int>(free - busy.begin())}, std::max(now, *free), seconds);
}

}  // namespace mars::simulated
