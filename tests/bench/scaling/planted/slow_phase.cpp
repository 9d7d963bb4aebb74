// Linked into a test's node program with --wrap: in every frame the step SLOW_PHASE takes 20 milliseconds longer.
#include <chrono>
#include <thread>

#include "node/frame_report.h"

// FrameReport::clock by its linker's name, and in its place.
// NOLINTBEGIN(bugprone-reserved-identifier): --wrap makes these names.
extern "C" {
void __real__ZN4mars4node11FrameReport5clockENS_4wire5PhaseE(mars::node::FrameReport* report, mars::wire::Phase phase);

void __wrap__ZN4mars4node11FrameReport5clockENS_4wire5PhaseE(mars::node::FrameReport* report, mars::wire::Phase phase) {
  if (phase == mars::wire::Phase::SLOW_PHASE) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  __real__ZN4mars4node11FrameReport5clockENS_4wire5PhaseE(report, phase);
}
}
// NOLINTEND(bugprone-reserved-identifier)
