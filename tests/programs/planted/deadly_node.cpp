// Linked into a node program with --wrap: a node that begins the frame named in the file "deadly", beside the program,
// fails: "throw 57" or "kill 57".
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "node/frame_report.h"

namespace {

void fail_at(std::uint32_t frame) {
  std::ifstream file(std::filesystem::read_symlink("/proc/self/exe").parent_path() / "deadly");
  std::string way;
  std::uint32_t at = 0;
  if (!(file >> way >> at) || at != frame) return;
  if (way == "kill") raise(SIGKILL);
  throw std::runtime_error("a fault on purpose");
}

}  // namespace

// FrameReport::begin by its linker's name, and in its place.
// NOLINTBEGIN(bugprone-reserved-identifier): --wrap makes these names.
extern "C" {
void __real__ZN4mars4node11FrameReport5beginENS_4wire9FrameKindEjj(mars::node::FrameReport* report,
                                                                   mars::wire::FrameKind kind, std::uint32_t frame,
                                                                   std::uint32_t interval);

void __wrap__ZN4mars4node11FrameReport5beginENS_4wire9FrameKindEjj(mars::node::FrameReport* report,
                                                                   mars::wire::FrameKind kind, std::uint32_t frame,
                                                                   std::uint32_t interval) {
  __real__ZN4mars4node11FrameReport5beginENS_4wire9FrameKindEjj(report, kind, frame, interval);
  fail_at(frame);
}
}
// NOLINTEND(bugprone-reserved-identifier)
