// The events of one process, as recorder.h records them. Their memory is two halves set aside at the start: one
// is filled, the other may be on its way to the collector. Events that do not fit are left out and counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/messages/backend.h"

namespace mars::messages {

// Plain and little-endian, for processes send events to each other.
struct Event {
  enum class Kind : std::uint32_t {
    span,    // `what` is the program's own number
    sent,    // the call that gave a message to the backend
    taken,   // out of the backend, which is done within message calls only
    waited,  // until a message came; what and peer are -1 if until one that was sent had gone
    lost,    // ends each half: `value` events did not fit so far; `number` is 1 in a process's last
  };

  double begin;  // seconds of the process's clock, dclock()
  double end;
  std::uint64_t value;  // bytes of a message; of a span what the program likes
  Kind kind;
  std::int32_t what;     // message type
  std::int32_t peer;     // rank at the other end of a message, else -1
  std::uint32_t number;  // of a message among all from its sender to its receiver, from 0
  std::int32_t frame;    // the program's: last given to record_frame; -1 before
  std::uint32_t reserved;
};

class EventBuffer {
 public:
  // Halves of `capacity` events, in the time of `backend`, which outlives it; messages of `silent_type`,
  // which carry events, are not recorded.
  EventBuffer(const Backend& backend, std::size_t capacity, int silent_type);
  EventBuffer(const Backend&&, auto&&...) = delete;

  void message(Event::Kind kind, double begin, const Envelope& envelope, std::uint32_t number);
  void span(int what, double begin, double end, std::uint64_t value);
  void frame(std::int32_t frame) { frame_ = frame; }

  // The time to give as `begin`.
  double now() const { return backend_.seconds(); }

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  // The events of the current half, in the order of their ends, closed by one of kind lost. Recording goes on
  // in the other half, whose events are then gone.
  std::span<const Event> turn(bool last);

 private:
  void add(const Event& event);

  const Backend& backend_;
  std::size_t capacity_;
  int silent_type_;
  std::vector<Event> events_;  // both halves, each with one event more, which closes it
  std::size_t half_ = 0;
  std::size_t size_ = 0;  // of the current half
  std::uint64_t lost_ = 0;
  std::int32_t frame_ = -1;
};

}  // namespace mars::messages
