// In node/phase_scope.cpp's place in a test's node program: the last node takes ten times as long for every step that
// computes, and a tenth of a second at least, which is more than other programs take from the other nodes.
#include <algorithm>
#include <chrono>
#include <thread>

#include "hal/nx/nx_messages.h"
#include "node/phase_scope.h"

namespace mars::node {

PhaseScope::PhaseScope(wire::Phase phase, Heartbeat& heartbeat, FrameReport& report) : phase_(phase), report_(report) {
  heartbeat.enter(phase);
}

PhaseScope::~PhaseScope() {
  const double& seconds = report_.strip().times.*kPhaseTimes[static_cast<std::size_t>(phase_)];
  const double before = seconds;
  report_.clock(phase_);
  const bool computes = phase_ == wire::Phase::dice || phase_ == wire::Phase::fill || phase_ == wire::Phase::scanline;
  if (!computes || mynode() != numnodes() - 1) return;
  std::this_thread::sleep_for(std::chrono::duration<double>(std::max(9 * (seconds - before), 0.1)));
  report_.clock(phase_);
}

}  // namespace mars::node
