// In node/phase_scope.cpp's place in a node program: notes every frame that a node begins, and follows a plan. Both are
// files in the program's folder. In `begun` a line is: seconds (CLOCK_MONOTONIC), job, process, frame. `plan`, if it is
// there, is one line: "die 57" kills every node that begins frame 57; "garble 57" makes the first one send the host
// noise as a strip.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "hal/nx/nx_messages.h"
#include "node/phase_scope.h"

namespace {

namespace fs = std::filesystem;

fs::path beside_program(const char* name) { return fs::read_symlink("/proc/self/exe").parent_path() / name; }

// What started the ranks names the job; Slurm starts a job of the same name again.
std::string name_of_job() {
  std::string name;
  for (const char* variable : {"PMIX_NAMESPACE", "SLURM_RESTART_COUNT"})
    if (const char* value = std::getenv(variable)) name += value;
  return name;
}

// One write, so that lines of several nodes do not mix.
void note(std::uint32_t frame) {
  static const std::string job = name_of_job();
  static const int file = open(beside_program("begun").c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  std::array<char, 200> line{};
  const int length =
      std::snprintf(line.data(), line.size(), "%lld.%06ld %s %d %u\n", static_cast<long long>(now.tv_sec),
                    now.tv_nsec / 1000, job.c_str(), static_cast<int>(getpid()), frame);
  if (write(file, line.data(), static_cast<std::size_t>(length)) != length) std::abort();
}

void garble() {
  std::array<unsigned char, 5000> noise{};
  unsigned state = 1;
  for (unsigned char& byte : noise) byte = static_cast<unsigned char>((state = state * 1664525U + 1013904223U) >> 24);
  csend(mars::wire::kStrip, noise.data(), static_cast<long>(noise.size()), myhost(), 0);
}

void follow_plan(std::uint32_t frame) {
  const fs::path plan = beside_program("plan");
  std::ifstream file(plan);
  std::string action;
  std::uint32_t at = 0;
  if (!(file >> action >> at) || at != frame) return;
  if (action == "die") raise(SIGKILL);
  std::error_code taken;  // of several nodes that begin the frame one removes it
  if (action == "garble" && fs::remove(plan, taken)) garble();
}

// A frame that takes several passes begins once.
void begin_frame(std::uint32_t frame) {
  static std::optional<std::uint32_t> begun;
  if (begun == frame) return;
  begun = frame;
  note(frame);
  follow_plan(frame);
}

}  // namespace

namespace mars::node {

PhaseScope::PhaseScope(wire::Phase phase, Heartbeat& heartbeat, FrameReport& report) : phase_(phase), report_(report) {
  if (phase == wire::Phase::dice) begin_frame(report.strip().frame);
  heartbeat.enter(phase);
}

PhaseScope::~PhaseScope() { report_.clock(phase_); }

}  // namespace mars::node
