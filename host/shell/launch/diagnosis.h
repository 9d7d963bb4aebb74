// Why a run failed, from what it left: its fault event, how its process ended, and its last words on standard
// error, among which Open MPI's many are understood where they matter.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/child/child.h"
#include "host/render/events/events.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

struct Remains {
  std::string run;  // the host's in the folder, if it came so far; "": it had none
  std::optional<events::Resumed> resumed;
  std::optional<events::Booted> booted;  // once all nodes were there
  std::vector<std::uint32_t> taken;      // frames, as they came
  std::optional<events::Drawing> drawing;
  std::optional<events::Fault> fault;
  std::optional<events::Done> done;
  std::string ended_for;  // why we ended it: what it did not say or do; "": we did not
  child::Ending ending;
  int passed_on = 0;                   // the signal with which the person stopped it; 0: none
  std::deque<std::string> last_words;  // lines of standard error, the last ones
  events::Progress progress;
  std::string program;  // that was started

  // All its frames are where they belong, though it may have had to be ended.
  bool well() const { return done && (ending.well() || !ended_for.empty()); }
};

// What is wrong with the surroundings, as lines without the last one's end; none: it is not asked for.
using Advice = std::function<std::string()>;

// Of a run that a person's signal ended.
Failure stopped(const Remains& remains, const options::RenderOptions& options);

struct Diagnosis {
  Failure failure;                   // the one message a person gets
  std::optional<std::int32_t> node;  // that died or failed
  std::string machine{};             // where it did, or which does not answer; "" where not known
  bool machine_lost = false;         // it does not answer
  bool killed = false;               // a process was, by a signal
};

// With advice where the run never began or nothing else is known.
Diagnosis diagnose(const Remains& remains, const options::RenderOptions& options, const Advice& advice);

// The frame that the node was drawing when it died, where that is known.
std::optional<std::uint32_t> frame_of_death(const Remains& remains, const Diagnosis& diagnosis);

}  // namespace mars::launch
