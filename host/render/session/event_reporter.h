// Reports what happens on standard output (host/render/events) and on the status board, and how far the rendering is.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "host/render/events/course.h"
#include "host/render/events/events.h"
#include "host/render/farm/farm.h"
#include "host/render/session/status_board.h"

namespace mars::session {

class EventReporter {
 public:
  EventReporter(std::string backend, StatusBoard& board) : backend_(std::move(backend)), board_(board) {}

  void report(const events::Event& event) const;
  // A listener for render_film, of a film with this number of intervals. The reporter must outlive it.
  farm::FarmListener listener(std::size_t intervals);
  // By which it says how long the rest takes.
  void expect(events::Course course) { course_ = std::move(course); }

 private:
  void report_progress(double seconds);

  const std::string backend_;
  StatusBoard& board_;
  events::Course course_;
  events::Progress progress_;
};

}  // namespace mars::session
