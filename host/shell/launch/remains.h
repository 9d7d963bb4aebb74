// What a job left: the host's events, how its process ended, and its last words on standard error.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "host/child/child.h"
#include "host/render/events/events.h"
#include "host/shell/launch/slots.h"

namespace mars::launch {

struct Remains {
  std::string run;  // the host's in the folder, if it came so far; "": it had none
  std::optional<events::Resumed> resumed;
  std::optional<events::Booted> booted;  // once all nodes were there
  std::vector<std::uint32_t> taken;      // frames, as they came
  std::uint32_t recorded = 0;            // frames that its run had rendered, once it has ended; 0: that is not known
  std::optional<events::Drawing> drawing;
  std::optional<events::Fault> fault;
  std::optional<events::Done> done;
  std::string elsewhere;  // the machine where its frames are, where this one does not see them; "": it sees them
  std::string ended_for;  // why we ended it: what it did not say or do; "": we did not
  std::string cut_off;    // which machines do not reach each other, as the doctor found meanwhile; "": none is known
  child::Ending ending;
  int passed_on = 0;                   // the signal with which the person stopped it; 0: none
  std::deque<std::string> last_words;  // lines of standard error, the last ones
  events::Progress progress;
  std::string program;            // that was started
  std::vector<Slots> machines{};  // on which it was, in the order of its ranks; none: not known

  // The host or a node reported why it ends: as an event, or on standard error as our programs do: "mars: ...". That
  // another ceased to answer is no reason of its own.
  bool gave_reason() const {
    const auto is_own = [](const std::string& text) {
      return text.find("MPI_") == std::string::npos && text.find("nothing was heard of the host") == std::string::npos;
    };
    if (fault) return is_own(fault->problem);
    return std::ranges::any_of(last_words,
                               [&](const std::string& line) { return line.starts_with("mars: ") && is_own(line); });
  }
  // It could not begin, because machines do not reach each other: it would not begin another time either.
  bool is_cut_off() const { return !booted && !cut_off.empty(); }
  // All its frames are where they belong, though it may have had to be ended.
  bool well() const { return done && (ending.well() || !ended_for.empty()); }
  // Frames that it brought.
  std::uint32_t brought() const { return std::max(progress.done(), recorded); }
};

}  // namespace mars::launch
