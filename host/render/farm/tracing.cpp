#include "host/render/farm/tracing.h"

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"

namespace mars::farm {
namespace {

constexpr std::size_t kHostEvents = 1 << 13;  // more than between two turns of the farm's loop
constexpr int kReadings = 16;                 // of a node's clock, of which the best counts

trace::ClockReading read_clock_once(int node, NodeInbox& inbox) {
  const double asked = dclock();
  csend(wire::kClock, nullptr, 0, node, 0);
  const double answer = inbox.receive_time(node);
  return trace::ClockReading::of(asked, answer, dclock());
}

trace::ClockReading read_clock(int node, NodeInbox& inbox) {
  trace::ClockReading best = read_clock_once(node, inbox);
  for (int i = 1; i < kReadings && !best.shares_clock(); ++i) {
    const trace::ClockReading next = read_clock_once(node, inbox);
    if (next.error < best.error) best = next;
  }
  return best;
}

}  // namespace

Tracing::Tracing(trace::Trace* trace, NodeInbox& inbox) : trace_(trace), inbox_(inbox) {
  if (trace_ == nullptr) return;
  const std::size_t nodes = inbox.hellos().size();
  trace_->begin(inbox.hellos(), dclock());
  for (int node = 0; node < static_cast<int>(nodes); ++node) {
    const trace::ClockReading reading = read_clock(node, inbox);
    trace_->add(node, reading);
    if (!reading.shares_clock()) foreign_.push_back(node);
  }
  recorder_.emplace(kHostEvents + 4 * nodes, wire::kTrace);
}

Tracing::~Tracing() {
  if (recorder_) empty_recorder(true);
}

void Tracing::drain() {
  if (recorder_ && recorder_->size() > recorder_->capacity() / 2) empty_recorder(false);
}

void Tracing::empty_recorder(bool last) { trace_->add(trace_->host(), recorder_->turn(last)); }

void Tracing::taken(const sinks::SinkPool::Taken& frame) {
  if (trace_ != nullptr) trace_->add(frame);
}

void Tracing::receive() {
  const int node = static_cast<int>(infonode());
  const auto events = inbox_.receive_events();
  if (trace_ == nullptr) inbox_.refuse(node, "events of a run that is not traced");
  trace_->add(node, events);
}

void Tracing::read_clocks_again() {
  for (const int node : foreign_) trace_->add(node, read_clock(node, inbox_));
}

void Tracing::finish() {
  if (trace_ == nullptr) return;
  for (int node = 0; node < static_cast<int>(inbox_.hellos().size()); ++node) {
    while (!inbox_.events_ended(node)) {
      inbox_.wait(wire::kTrace);
      receive();
    }
  }
}

ScopedSpan::ScopedSpan(trace::HostSpan what, std::uint64_t value)
    : what_(what), value_(value), begin_(messages::process().recorder() != nullptr ? dclock() : 0) {}

ScopedSpan::~ScopedSpan() {
  if (begin_ != 0) messages::record_span(static_cast<int>(what_), begin_, dclock(), value_);
}

}  // namespace mars::farm
