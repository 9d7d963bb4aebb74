#include "hal/messages/recorder.h"

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "hal/messages/process.h"

namespace mars::hal {

Recorder::Recorder(std::size_t capacity, int silent_type)
    : process_(process()), capacity_(capacity), silent_type_(silent_type), events_(2 * (capacity + 1)) {
  check(process_.recorder() == nullptr, "a process has one recorder");
  process_.record(this);
}

Recorder::~Recorder() { process_.record(nullptr); }

void Recorder::message(Event::Kind kind, double begin, const Envelope& envelope, std::uint32_t number) {
  if (envelope.type == silent_type_) return;
  add({begin, dclock(), envelope.length, kind, envelope.type, envelope.from, number, frame_, 0});
}

void Recorder::span(int what, double begin, double end, std::uint64_t value) {
  add({begin, end, value, Event::Kind::span, what, -1, 0, frame_, 0});
}

void Recorder::add(const Event& event) {
  if (size_ == capacity_) {
    ++lost_;
    return;
  }
  events_[half_ * (capacity_ + 1) + size_++] = event;
}

std::span<const Event> Recorder::turn(bool last) {
  const std::span<Event> full = std::span(events_).subspan(half_ * (capacity_ + 1), size_ + 1);
  const double now = dclock();
  full.back() = {now, now, lost_, Event::Kind::lost, -1, -1, last ? 1u : 0u, frame_, 0};
  half_ = 1 - half_;
  size_ = 0;
  return full;
}

void record_span(int what, double begin, double end, std::uint64_t value) {
  if (Recorder* recorder = process().recorder()) recorder->span(what, begin, end, value);
}

void record_frame(std::int32_t frame) {
  if (Recorder* recorder = process().recorder()) recorder->frame(frame);
}

}  // namespace mars::hal
