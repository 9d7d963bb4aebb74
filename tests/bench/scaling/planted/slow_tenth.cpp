// In node/phase_scope.cpp's place in a test's node program: every step takes a tenth more of its processor.
#include <ctime>

#include "node/phase_scope.h"

namespace mars::node {

namespace {

double processor_seconds() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

thread_local double began = 0;

}  // namespace

PhaseScope::PhaseScope(wire::Phase phase, Heartbeat& heartbeat, FrameReport& report) : phase_(phase), report_(report) {
  heartbeat.enter(phase);
  began = processor_seconds();
}

PhaseScope::~PhaseScope() {
  const double now = processor_seconds();
  while (processor_seconds() < now + (now - began) / 10) {
  }
  report_.clock(phase_);
}

}  // namespace mars::node
