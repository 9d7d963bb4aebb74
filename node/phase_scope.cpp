#include "node/phase_scope.h"

namespace mars::node {

PhaseScope::PhaseScope(wire::Phase phase, Heartbeat& heartbeat, FrameReport& report) : phase_(phase), report_(report) {
  heartbeat.enter(phase);
}

PhaseScope::~PhaseScope() { report_.clock(phase_); }

}  // namespace mars::node
