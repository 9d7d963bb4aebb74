#include "host/render/trace/node_clock.h"

#include <algorithm>

namespace mars::trace {

ClockReading ClockReading::of(double asked, double answer, double heard) {
  return {answer, (asked + heard) / 2 - answer, (heard - asked) / 2};
}

void NodeClock::add(const ClockReading& reading) {
  const ClockReading exact = reading.shares_clock() ? ClockReading{reading.node, 0, 0} : reading;
  (first_ ? last_ : first_) = exact;
}

double NodeClock::to_host(double time) const {
  if (!first_) return time;
  if (!last_ || last_->node <= first_->node) return time + first_->offset;
  const double part = (time - first_->node) / (last_->node - first_->node);
  return time + first_->offset + part * (last_->offset - first_->offset);
}

double NodeClock::error() const { return std::max(first_ ? first_->error : 0, last_ ? last_->error : 0); }

}  // namespace mars::trace
