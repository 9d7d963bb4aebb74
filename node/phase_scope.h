// One phase of a frame on a node. While a PhaseScope lives the node's heartbeat names the phase; when it ends, the
// frame's report gets the time since the phase before, with the work that was charged meanwhile.
#pragma once

#include "node/frame_report.h"
#include "node/heartbeat.h"
#include "node/wire/protocol.h"

namespace mars::node {

class PhaseScope {
 public:
  // `heartbeat` and `report` outlive it.
  PhaseScope(wire::Phase phase, Heartbeat& heartbeat, FrameReport& report);
  ~PhaseScope();
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  const wire::Phase phase_;
  FrameReport& report_;
};

}  // namespace mars::node
