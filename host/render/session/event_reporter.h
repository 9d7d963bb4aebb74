// Reports what happens on standard output (host/render/events) and on the status board, and how far the rendering is.
#pragma once

#include <cstddef>
#include <exception>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "host/render/events/course.h"
#include "host/render/events/events.h"
#include "host/render/farm/farm.h"
#include "host/render/session/status_board.h"

namespace mars::session {

class EventReporter {
 public:
  EventReporter(std::string backend, StatusBoard& board) : backend_(std::move(backend)), board_(board) {}

  // From any thread.
  void report(const events::Event& event) const;
  // Throws where standard output takes no more.
  void report_beat(const std::string& doing, const std::vector<farm::SilentNode>& silent) const;
  void report_drawing(const std::vector<farm::NodeFrame>& drawing) const;
  // A listener for render_film, of a film with this number of intervals. The reporter must outlive it.
  farm::FarmListener listener(std::size_t intervals);
  // By which it says how long the rest takes.
  void expect(events::Course course) { course_ = std::move(course); }

 private:
  void report_progress(double seconds);

  const std::string backend_;
  StatusBoard& board_;
  mutable std::mutex mutex_;  // one line at a time
  events::Course course_;
  events::Progress progress_;
};

// Why a run ends, and the node that fails, if it is a node's failure.
events::Fault fault_of(const std::exception& reason);

}  // namespace mars::session
