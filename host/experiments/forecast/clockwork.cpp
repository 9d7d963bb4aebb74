#include "host/experiments/forecast/clockwork.h"

#include <algorithm>
#include <utility>

namespace mars::forecast {

void Clockwork::at(double time, Action action) {
  events_.push_back({time, events_given_++, std::move(action)});
  std::push_heap(events_.begin(), events_.end());
}

void Clockwork::run() {
  while (!events_.empty()) {
    std::pop_heap(events_.begin(), events_.end());
    const Event event = std::move(events_.back());
    events_.pop_back();
    now_ = event.time;
    event.action();
  }
}

}  // namespace mars::forecast
