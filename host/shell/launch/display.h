// What a person sees of a rendering: on a terminal one line that keeps up with it, in a pipe or file a plain
// line now and then.
#pragma once

#include <chrono>
#include <ostream>
#include <string>

#include "host/render/events/events.h"

namespace mars::launch {

// Seconds as 0:07 or 1:02:03.
std::string clock_text(double seconds);

// "frame 12 of 72, interval 2 of 5, 8.3 frames/s, 0:07 left (keyframes 0:03, inbetweens 0:04)"
std::string progress_text(const events::Progress& progress);
// The same after "Progress: 16%, ", for render managers: this is what they look for in a program's output.
std::string progress_line(const events::Progress& progress);

// "12 of 72 frames are there already"
std::string resumed_text(const events::Resumed& resumed);
std::string booted_text(const events::Booted& booted);
std::string done_text(const events::Done& done);

class Display {
 public:
  enum class Kind { silent, lines, terminal };

  // `out` takes what moves the cursor as it is (child::raw_output).
  Display(Kind kind, std::ostream& out) : kind_(kind), out_(out) {}

  // A line that stays.
  void print(const std::string& line);
  // How far it is: shown when due.
  void show(const events::Progress& progress);
  void show(const std::string& line);
  // After a job: leaves the terminal's progress line as it is and goes below it.
  void settle();

 private:
  bool due();

  Kind kind_;
  std::ostream& out_;
  bool line_open_ = false;  // the terminal's progress line is being shown
  std::chrono::steady_clock::time_point last_{};
  std::uint32_t shown_ = 0;  // frames that the last plain line reported
};

// For standard output.
Display::Kind kind_of_output(bool quiet);

}  // namespace mars::launch
