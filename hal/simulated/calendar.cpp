#include "hal/simulated/calendar.h"

#include <algorithm>
#include <iterator>

namespace mars::simulated {

double Calendar::book(double time, double seconds, double floor) {
  while (!busy_.empty() && busy_.begin()->second < floor) busy_.erase(busy_.begin());
  auto next = busy_.upper_bound(time);
  if (next != busy_.begin()) time = std::max(time, std::prev(next)->second);
  for (; next != busy_.end() && next->first < time + seconds; ++next) time = std::max(time, next->second);
  if (seconds <= 0) return time;
  const bool goes_on = next != busy_.begin() && std::prev(next)->second == time;
  if (goes_on)
    std::prev(next)->second = time + seconds;
  else
    busy_.emplace_hint(next, time, time + seconds);
  return time;
}

}  // namespace mars::simulated
