#include "node/raster/arena.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::raster {

Arena::Arena(std::size_t bytes) : block_(bytes), size_(bytes / kGrain * kGrain), back_(size_) {
  block_.prefer_large_pages();
}

std::byte* Arena::take_bytes(std::size_t bytes) {
  std::byte* start = block_.bytes().data() + front_;
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
