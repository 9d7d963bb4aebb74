#include "host/shell/launch/restarts.h"

#include <algorithm>

namespace mars::launch {
namespace {

constexpr std::uint32_t kLongestPause = 15;  // seconds
constexpr std::uint32_t kDoublings = 4;      // after which it is reached

}  // namespace

std::optional<std::chrono::seconds> Restarts::again(bool new_frames) {
  if (new_frames) number_ = 0;
  if (number_ >= most_) return std::nullopt;
  ++number_;
  ++all_;
  return std::chrono::seconds(std::min(kLongestPause, 1u << std::min(number_ - 1, kDoublings)));
}

}  // namespace mars::launch
