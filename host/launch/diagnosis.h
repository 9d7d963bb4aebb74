// Why a run failed, from what it left: its fault event, how its process ended, and its last words on standard
// error, among which Open MPI's many are understood where they matter.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "hal/failure.h"
#include "host/events/events.h"
#include "host/launch/child.h"
#include "host/options/render_options.h"

namespace mars::host {

struct Remains {
  std::optional<Booted> booted;        // once all nodes were there
  std::optional<Fault> fault;
  Ending ending;
  int passed_on = 0;                   // the signal with which the person stopped it; 0: none
  std::deque<std::string> last_words;  // lines of standard error, the last ones
  Progress progress;
  std::string program;  // that was started
};

// The one message a person gets.
Failure diagnose(const Remains& remains, const RenderOptions& options);

}  // namespace mars::host
