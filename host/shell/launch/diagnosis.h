// Why a run failed, from what it left: its fault event, how its process ended, and its last words on standard
// error, among which Open MPI's many are understood where they matter.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "hal/failure/failure.h"
#include "host/child/child.h"
#include "host/render/events/events.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

struct Remains {
  std::optional<events::Booted> booted;  // once all nodes were there
  std::optional<events::Fault> fault;
  child::Ending ending;
  int passed_on = 0;                   // the signal with which the person stopped it; 0: none
  std::deque<std::string> last_words;  // lines of standard error, the last ones
  events::Progress progress;
  std::string program;  // that was started
};

// What is wrong with the surroundings, as lines without the last one's end.
using Advice = std::function<std::string()>;

// Of a run that a person's signal ended.
Failure stopped(const Remains& remains, const options::RenderOptions& options);

// The one message a person gets; with advice where the run never began or nothing else is known.
Failure diagnose(const Remains& remains, const options::RenderOptions& options, const Advice& advice);

}  // namespace mars::launch
