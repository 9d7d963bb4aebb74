// In node/phase_scope.cpp's place in a test's node program: in every frame the step SLOW_PHASE takes 20 milliseconds
// longer.
#include <chrono>
#include <thread>

#include "node/phase_scope.h"

namespace mars::node {

PhaseScope::PhaseScope(wire::Phase phase, Heartbeat& heartbeat, FrameReport& report) : phase_(phase), report_(report) {
  heartbeat.enter(phase);
}

PhaseScope::~PhaseScope() {
  if (phase_ == wire::Phase::SLOW_PHASE) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  report_.clock(phase_);
}

}  // namespace mars::node
