#include "host/render/sinks/growing_pauses.h"

#include <algorithm>

namespace mars::sinks {

std::chrono::microseconds GrowingPauses::next() {
  constexpr std::chrono::microseconds kLongest = std::chrono::milliseconds(100);
  std::uniform_int_distribution<std::chrono::microseconds::rep> from_half(longest_.count() / 2, longest_.count());
  longest_ = std::min(longest_ * 2, kLongest);
  return std::chrono::microseconds(from_half(random_));
}

}  // namespace mars::sinks
