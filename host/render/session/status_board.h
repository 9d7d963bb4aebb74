// A rendering's status (sinks/status.h) as its events tell it.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "host/render/events/events.h"
#include "host/render/farm/farm.h"
#include "host/render/sinks/status.h"

namespace mars::session {

class StatusBoard {
 public:
  // Of a run of this process.
  explicit StatusBoard(std::string film);

  // From any thread.
  void note(const events::Event& event);
  void note_drawn(const farm::FinishedFrame& frame);
  void note_slow(int node, double slowness);
  sinks::Status status() const;

 private:
  void note_booted(const events::Booted& booted);
  void note_progress(const events::Progress& progress);
  void note_beat(const events::Beat& beat);
  void note_warning(const events::Warning& warning);

  mutable std::mutex mutex_;
  sinks::Status status_;
  const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::vector<std::uint32_t> drawn_;  // frames, by node
};

}  // namespace mars::session
