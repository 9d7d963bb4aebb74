#include "node/raster/arena.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::node {

Arena::Arena(std::size_t bytes) : block_(bytes), size_(bytes / kGrain * kGrain), back_(size_) {
  block_.prefer_large_pages();
}

std::byte* Arena::take_bytes(std::size_t bytes) {
  std::byte* start = block_.bytes().data() + front_;
  keep(bytes, 0);
  return start;
}

void Arena::keep(std::size_t at_front, std::size_t at_back) {
  const auto grains = [](std::size_t bytes) { return (bytes + kGrain - 1) / kGrain * kGrain; };
  check(grains(at_front) <= back_ - front_ && grains(at_back) <= back_ - front_ - grains(at_front),
        "an arena has room for what is taken from it");
  front_ += grains(at_front);
  back_ -= grains(at_back);
  fullest_ = std::max(fullest_, used());
}

}  // namespace mars::node
