// Seconds in which at least one of several things is under way, which are added as they end.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace mars::sinks {

class BusyTime {
 public:
  void add(double begin, double end) {
    while (!times_.empty() && times_.back().second >= begin) {
      begin = std::min(begin, times_.back().first);
      end = std::max(end, times_.back().second);
      seconds_ -= times_.back().second - times_.back().first;
      times_.pop_back();
    }
    times_.emplace_back(begin, end);
    seconds_ += end - begin;
  }
  double seconds() const { return seconds_; }

 private:
  std::vector<std::pair<double, double>> times_;  // apart from each other, ascending
  double seconds_ = 0;
};

}  // namespace mars::sinks
