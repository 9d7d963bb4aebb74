// When a part of a network (port, channel, link) is busy. Messages take the first stretch that is free and long enough,
// so they may be given in any order.
#pragma once

#include <map>

namespace mars::simulated {

class Calendar {
 public:
  // When work of `seconds` could begin, not before `time`.
  double free_at(double time, double seconds) const;
  // When work of `seconds` begins that could begin at `time`. Nothing comes that begins before `floor`.
  double book(double time, double seconds, double floor);

  // When it is free for ever.
  double end() const { return busy_.empty() ? 0 : busy_.rbegin()->second; }

 private:
  std::map<double, double> busy_;  // from, until; apart from each other
};

}  // namespace mars::simulated
