// Records the events of one process, for pictures of a run: every message sent, taken and waited for, and spans
// of time that the program names. While a Recorder lives, the calling thread's process (process.h) is
// recorded; without one a message costs a branch more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/messages/events.h"

namespace mars::messages {

class Process;

class Recorder {
 public:
  // As of EventBuffer.
  Recorder(std::size_t capacity, int silent_type);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // As of EventBuffer.
  std::size_t size() const { return events_.size(); }
  std::size_t capacity() const { return events_.capacity(); }
  std::span<const Event> turn(bool last) { return events_.turn(last); }

 private:
  Process& process_;
  EventBuffer events_;
};

// Of the calling process; without a recorder they do nothing.
void record_span(int what, double begin, double end, std::uint64_t value = 0);
void record_frame(std::int32_t frame);

}  // namespace mars::messages
