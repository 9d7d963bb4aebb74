#include "hal/messages/events.h"

namespace mars::messages {

EventBuffer::EventBuffer(const Backend& backend, std::size_t capacity, int silent_type)
    : backend_(backend), capacity_(capacity), silent_type_(silent_type), events_(2 * (capacity + 1)) {}

void EventBuffer::message(Event::Kind kind, double begin, const Envelope& envelope, std::uint32_t number) {
  if (envelope.type == silent_type_) return;
  add({begin, now(), envelope.length, kind, envelope.type, envelope.from, number, frame_, 0});
}

void EventBuffer::span(int what, double begin, double end, std::uint64_t value) {
  add({begin, end, value, Event::Kind::span, what, -1, 0, frame_, 0});
}

void EventBuffer::add(const Event& event) {
  if (size_ == capacity_) {
    ++lost_;
    return;
  }
  events_[half_ * (capacity_ + 1) + size_++] = event;
}

std::span<const Event> EventBuffer::turn(bool last) {
  const std::span<Event> full = std::span(events_).subspan(half_ * (capacity_ + 1), size_ + 1);
  const double time = now();
  full.back() = {time, time, lost_, Event::Kind::lost, -1, -1, last ? 1u : 0u, frame_, 0};
  half_ = 1 - half_;
  size_ = 0;
  return full;
}

}  // namespace mars::messages
