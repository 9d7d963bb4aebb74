// Linked into a test's node program with --wrap: the last node takes ten times as long for every step that computes.
#include <chrono>
#include <thread>

#include "hal/nx/nx_messages.h"
#include "node/frame_report.h"

// FrameReport::clock by its linker's name, and in its place.
// NOLINTBEGIN(bugprone-reserved-identifier): --wrap makes these names.
extern "C" {
void __real__ZN4mars4node11FrameReport5clockENS_4wire5PhaseE(mars::node::FrameReport* report, mars::wire::Phase phase);

void __wrap__ZN4mars4node11FrameReport5clockENS_4wire5PhaseE(mars::node::FrameReport* report, mars::wire::Phase phase) {
  using mars::wire::Phase;
  double& seconds = report->strip().times.*mars::node::kPhaseTimes[static_cast<std::size_t>(phase)];
  const double before = seconds;
  __real__ZN4mars4node11FrameReport5clockENS_4wire5PhaseE(report, phase);
  const bool computes = phase == Phase::dice || phase == Phase::fill || phase == Phase::scanline;
  if (!computes || mynode() != numnodes() - 1) return;
  std::this_thread::sleep_for(std::chrono::duration<double>(9 * (seconds - before)));
  __real__ZN4mars4node11FrameReport5clockENS_4wire5PhaseE(report, phase);
}
}
// NOLINTEND(bugprone-reserved-identifier)
