#include "tests/bench/tables/machine1992/edge_lists.h"

#include <algorithm>

namespace mars::machine1992 {

void EdgeLists::clear() {
  triangles_.clear();
  boxes_.clear();
  std::ranges::fill(stationary_, kEnd);
  std::ranges::fill(moving_, kEnd);
}

void EdgeLists::add(const SentBox& box) {
  std::uint32_t& first = (box.moving == 1 ? moving_ : stationary_)[box.line];
  triangles_.push_back(box.triangle);
  boxes_.push_back({first, box.first, box.last});
  first = static_cast<std::uint32_t>(boxes_.size() - 1);
}

}  // namespace mars::machine1992
