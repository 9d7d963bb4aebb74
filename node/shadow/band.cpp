#include "node/shadow/band.h"

#include <algorithm>

#include "node/shadow/pairs.h"

namespace mars::shadow {

std::uint32_t Layer::tiles_across() const { return (width + kTile - 1) / kTile; }

void Layer::count_all_tiles() {
  tiles.clear();
  for (std::uint32_t row = range.first / kTile; row * kTile < range.last; ++row) {
    const std::uint32_t first = std::max(row * kTile, range.first), last = std::min((row + 1) * kTile, range.last);
    bool any = false;
    for (std::uint32_t number = first; number < last; ++number) any |= line(number).depth != nullptr;
    for (std::uint32_t x = 0; any && x < tiles_across(); ++x) tiles.push_back(row * tiles_across() + x);
  }
}

}  // namespace mars::shadow
