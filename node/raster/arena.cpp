#include "node/raster/arena.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::raster {

Arena::Arena(std::span<std::byte> block) : block_(block.first(block.size() / kGrain * kGrain)), back_(block_.size()) {}

std::byte* Arena::take_bytes(std::size_t bytes) {
  std::byte* start = block_.data() + front_;
  take_ends(bytes, 0);
  return start;
}

void Arena::take_ends(std::size_t at_front, std::size_t at_back) {
  const auto grains = [](std::size_t bytes) { return (bytes + kGrain - 1) / kGrain * kGrain; };
  check(grains(at_front) <= back_ - front_ && grains(at_back) <= back_ - front_ - grains(at_front),
        "what is taken from an arena fits");
  front_ += grains(at_front);
  back_ -= grains(at_back);
  peak_ = std::max(peak_, used());
}

}  // namespace mars::raster
