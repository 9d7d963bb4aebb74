#include "host/experiments/forecast/clockwork.h"

#include <utility>

namespace mars::forecast {

void Clockwork::run() {
  while (!events_.empty()) {
    const Action action = std::move(const_cast<Event&>(events_.top()).action);
    now_ = events_.top().time;
    events_.pop();
    action();
  }
}

}  // namespace mars::forecast
