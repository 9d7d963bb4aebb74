// Nodes [first, first + count), which work on one interval together.
#pragma once

namespace mars::collectives {

struct Group {
  int first = 0;
  int count = 1;

  bool operator==(const Group&) const = default;
};

// Number `number` of `groups` groups of about equal size that `nodes` nodes form side by side.
constexpr Group group_of(int nodes, int groups, int number) {
  const int first = nodes * number / groups;
  return {first, nodes * (number + 1) / groups - first};
}

}  // namespace mars::collectives
