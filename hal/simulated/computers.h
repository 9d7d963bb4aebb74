// The computers of a machine, and when their processors have done work: for ranks that are simulated, and for a run
// that a forecast plays through.
#pragma once

#include <vector>

#include "hal/simulated/machine.h"
#include "hal/simulated/pace.h"

namespace mars::simulated {

class Computers {
 public:
  // `machine` lasts.
  Computers(const Machine& machine, int nodes);
  Computers(const Machine&&, auto&&...) = delete;

  // Of the nodes.
  int count() const { return (nodes_ + machine_.nodes - 1) / machine_.nodes; }
  // Nodes, but on the last.
  int nodes_on_each() const { return machine_.nodes; }
  // Of a node, or of the host, whose rank is the number of nodes.
  int of(int rank) const;
  int nodes_on(int computer) const;
  // Whether it has fewer processors than ranks: these are given work in the order of its times then.
  bool crowded(int computer) const;
  bool any_crowded() const;

  // When a rank has done work that it begins now. Ranks with a processor each never wait for one.
  double work(int rank, double now, double seconds);
  // When a processor of the rank's computer has done work that is none of a rank's.
  double reserve(int rank, double now, double seconds);

 private:
  int own_processor(int rank) const { return rank < nodes_ ? rank % machine_.nodes : nodes_on(of(rank)); }

  const Machine& machine_;
  const int nodes_;
  const Pace pace_;
  std::vector<std::vector<double>> busy_;  // until, by computer and processor
};

}  // namespace mars::simulated
