// Processors of a platform's computers while a run is played through: as hal/simulated/world.h shares them among ranks.
#pragma once

#include <vector>

#include "hal/simulated/machine.h"

namespace mars::forecast {

class Computers {
 public:
  Computers(const simulated::Machine& machine, int nodes);

  int count() const { return (nodes_ + machine_.nodes - 1) / machine_.nodes; }
  // Nodes, but on the last.
  int nodes_on_each() const { return machine_.nodes; }
  // Of a node, or of the host, whose rank is the number of nodes.
  int of(int rank) const;
  // When a rank has done work that it begins now. Ranks with a processor each never wait for one.
  double work(int rank, double now, double seconds);
  // When a processor of the rank's computer has done work that is none of a rank's.
  double reserve(int rank, double now, double seconds);

 private:
  bool crowded(int computer) const;

  const simulated::Machine& machine_;
  const int nodes_;
  std::vector<std::vector<double>> busy_;  // until, by computer
};

}  // namespace mars::forecast
