// Time as a process that looks now and then has lived it: between two looks at most a second counts. Suspended with all
// that it watches, by a signal or a laptop's lid, it does not take the pause for their silence.
#pragma once

#include <algorithm>
#include <chrono>

namespace mars::launch {

class ObservedTime {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ObservedTime(Clock::time_point start) : last_(start) {}

  void look(Clock::time_point now) {
    passed_ += std::clamp<Clock::duration>(now - last_, Clock::duration::zero(), kMostOfALook);
    last_ = now;
  }
  Clock::duration passed() const { return passed_; }

 private:
  static constexpr std::chrono::seconds kMostOfALook{1};

  Clock::time_point last_;
  Clock::duration passed_{};
};

}  // namespace mars::launch
