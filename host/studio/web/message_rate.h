// How many messages of a page are read: a hand makes a few hundred a second; of more, the rest waits at the page.
#pragma once

#include <algorithm>
#include <chrono>

namespace mars::web {

class MessageRate {
 public:
  using Clock = std::chrono::steady_clock;

  // One message came: how long until the next may be read.
  Clock::duration take(Clock::time_point now) {
    free_at_ = std::max(free_at_, now - kBurst * kEach) + kEach;
    return std::max(free_at_ - now, Clock::duration{0});
  }

 private:
  static constexpr Clock::duration kEach = std::chrono::microseconds(500);
  static constexpr int kBurst = 2000;

  Clock::time_point free_at_{};
};

}  // namespace mars::web
