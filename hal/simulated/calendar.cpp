#include "hal/simulated/calendar.h"

#include <algorithm>
#include <iterator>

namespace mars::simulated {

double Calendar::free_at(double time, double seconds) const {
  auto next = busy_.upper_bound(time);
  if (next != busy_.begin()) time = std::max(time, std::prev(next)->second);
  for (; next != busy_.end() && next->first < time + seconds; ++next) time = std::max(time, next->second);
  return time;
}

double Calendar::book(double time, double seconds, double floor) {
  while (!busy_.empty() && busy_.begin()->second < floor) busy_.erase(busy_.begin());
  time = free_at(time, seconds);
  if (seconds <= 0) return time;
  const auto next = busy_.upper_bound(time);
  const bool goes_on = next != busy_.begin() && std::prev(next)->second == time;
  if (goes_on)
    std::prev(next)->second = time + seconds;
  else
    busy_.emplace_hint(next, time, time + seconds);
  return time;
}

}  // namespace mars::simulated
