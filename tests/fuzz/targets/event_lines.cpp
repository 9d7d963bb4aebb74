// Lines of events from a host.
#include "hal/failure/failure.h"
#include "host/render/events/events.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::event_lines {

void take(std::string_view input) {
  const auto event = events::read_event(input);
  if (!event) return;
  const std::string line = events::line_of(*event);
  check(events::read_event(line).has_value(), "an event is read as it was written");
}

const Target target("event_lines", Form::text, take);

}  // namespace mars::fuzz::event_lines
