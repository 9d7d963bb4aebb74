#include "node/arena.h"

#include <algorithm>
#include <new>
#include <string>

#include "hal/failure.h"

namespace mars::node {
namespace {

constexpr std::size_t kGrain = 16;  // items begin on multiples of this

}  // namespace

Arena::Arena(std::size_t bytes) : size_(bytes / kGrain * kGrain) {
  block_.reset(new (std::nothrow) std::byte[size_]);
  if (!block_)
    throw Failure("the machine does not give a node " + std::to_string(bytes >> 20) + " MiB", "memory",
                  "start fewer nodes a machine, or set MARS_MEMORY to fewer MiB");
}

std::byte* Arena::take_bytes(std::size_t bytes) {
  const std::size_t grains = (bytes + kGrain - 1) / kGrain * kGrain;
  check(grains <= size_ - used_, "an arena has room for what is taken from it");
  std::byte* start = block_.get() + used_;
  used_ += grains;
  fullest_ = std::max(fullest_, used_);
  return start;
}

}  // namespace mars::node
