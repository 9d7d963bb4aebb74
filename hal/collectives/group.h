// Nodes [first, first + count), which work on one interval together.
#pragma once

#include <cstdint>

namespace mars::collectives {

struct Group {
  int first = 0;
  int count = 1;

  bool operator==(const Group&) const = default;
};

// Number `number` of `groups` groups of about equal size that `nodes` nodes form side by side.
constexpr Group group_of(int nodes, int groups, int number) {
  const auto begin = [=](std::int64_t group) { return static_cast<int>(nodes * group / groups); };
  return {begin(number), begin(std::int64_t{number} + 1) - begin(number)};
}

}  // namespace mars::collectives
