#include "hal/messages/recorder.h"

#include "hal/failure/failure.h"
#include "hal/messages/process.h"

namespace mars::messages {

Recorder::Recorder(std::size_t capacity, int silent_type)
    : process_(process()), events_(process_.backend(), capacity, silent_type) {
  check(process_.recorder() == nullptr, "a process has one recorder");
  process_.record(&events_);
}

Recorder::~Recorder() { process_.record(nullptr); }

void record_span(int what, double begin, double end, std::uint64_t value) {
  if (EventBuffer* events = process().recorder()) events->span(what, begin, end, value);
}

void record_frame(std::int32_t frame) {
  if (EventBuffer* events = process().recorder()) events->frame(frame);
}

}  // namespace mars::messages
