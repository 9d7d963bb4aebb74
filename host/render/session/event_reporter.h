// Reports what happens on standard output (host/render/events), and how far the rendering is.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <utility>

#include "host/render/events/course.h"
#include "host/render/events/events.h"
#include "host/render/farm/farm.h"

namespace mars::session {

class EventReporter {
 public:
  explicit EventReporter(std::string backend) : backend_(std::move(backend)) {}

  // From several threads at once.
  void report(const events::Event& event) const;
  // A listener for render_film, of a film with this number of intervals. The reporter must outlive it.
  farm::FarmListener listener(std::size_t intervals);
  // By which it says how long the rest takes.
  void expect(events::Course course) { course_ = std::move(course); }

 private:
  void report_progress(double seconds);

  const std::string backend_;
  mutable std::mutex mutex_;  // one line at a time
  events::Course course_;
  events::Progress progress_;
};

}  // namespace mars::session
