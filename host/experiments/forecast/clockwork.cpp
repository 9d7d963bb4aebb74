#include "host/experiments/forecast/clockwork.h"

#include <algorithm>
#include <utility>

namespace mars::forecast {

void Clockwork::at(double time, Action action) {
  if (free_.empty()) {
    free_.push_back(actions_.size());
    actions_.emplace_back();
  }
  const std::size_t place = free_.back();
  free_.pop_back();
  actions_[place] = std::move(action);
  events_.push_back({time, events_given_++, place});
  std::push_heap(events_.begin(), events_.end());
}

bool Clockwork::run(double limit) {
  while (!events_.empty()) {
    std::pop_heap(events_.begin(), events_.end());
    const Event event = events_.back();
    events_.pop_back();
    now_ = event.time;
    if (now_ > limit) return false;
    free_.push_back(event.action);
    std::exchange(actions_[event.action], {})();
  }
  return events_.empty();
}

}  // namespace mars::forecast
