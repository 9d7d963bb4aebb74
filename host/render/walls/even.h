// Work that idle nodes would help with: each node's share of its group's mean, and each group's of the job's.
#pragma once

#include <vector>

#include "hal/collectives/group.h"

namespace mars::walls {

// Seconds of a node's work.
struct Busy {
  double keyframes = 0;
  double inbetweens = 0;
};

// Of a node's work, the part that it does itself where others help that have nothing left: at most 1.
struct Pace {
  double keyframes = 1;
  double inbetweens = 1;
};

// `busy`: by node. Inbetweens are evened out over the nodes of a group, then all work over groups.
std::vector<Pace> even_out(const std::vector<Busy>& busy, const std::vector<collectives::Group>& groups);

}  // namespace mars::walls
