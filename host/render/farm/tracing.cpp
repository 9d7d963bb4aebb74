#include "host/render/farm/tracing.h"

#include "hal/nx/nx_messages.h"
#include "hal/messages/process.h"

namespace mars::host {
namespace {

constexpr std::size_t kHostEvents = 1 << 13;  // more than between two turns of the farm's loop
constexpr int kReadings = 16;                 // of a node's clock, of which the best counts

ClockReading read_clock_once(int node) {
  const double asked = dclock();
  csend(node::kClock, nullptr, 0, node, 0);
  double told = 0;
  crecv(node::kClock, &told, sizeof told);
  return ClockReading::of(asked, told, dclock());
}

ClockReading read_clock(int node) {
  ClockReading best = read_clock_once(node);
  for (int i = 1; i < kReadings && !best.shares_clock(); ++i) {
    const ClockReading next = read_clock_once(node);
    if (next.error < best.error) best = next;
  }
  return best;
}

}  // namespace

Tracing::Tracing(Trace* trace, std::span<const node::Hello> nodes, int credits) : trace_(trace) {
  if (trace_ == nullptr) return;
  trace_->begin(nodes, credits, dclock());
  for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
    const ClockReading reading = read_clock(node);
    trace_->add(node, reading);
    if (!reading.shares_clock()) foreign_.push_back(node);
  }
  nodes_left_ = static_cast<int>(nodes.size());
  recorder_.emplace(kHostEvents + 4 * nodes.size(), node::kTrace);
}

Tracing::~Tracing() {
  if (recorder_) empty_recorder(true);
}

void Tracing::drain() {
  if (recorder_ && recorder_->size() > recorder_->capacity() / 2) empty_recorder(false);
}

void Tracing::empty_recorder(bool last) { trace_->add(trace_->host(), recorder_->turn(last)); }

void Tracing::taken(const SinkPool::Taken& frame) {
  if (trace_ != nullptr) trace_->add(frame);
}

void Tracing::receive() {
  const int node = static_cast<int>(infonode());
  half_.resize(static_cast<std::size_t>(infocount()) / sizeof(hal::Event));
  crecv(node::kTrace, half_.data(), static_cast<long>(half_.size() * sizeof(hal::Event)));
  trace_->add(node, half_);
  if (half_.back().number == 1) --nodes_left_;
}

void Tracing::read_clocks_again() {
  for (const int node : foreign_) trace_->add(node, read_clock(node));
}

SpanOf::SpanOf(HostSpan what, std::uint64_t value)
    : what_(what), value_(value), begin_(hal::process().recorder() != nullptr ? dclock() : 0) {}

SpanOf::~SpanOf() {
  if (begin_ != 0) hal::record_span(static_cast<int>(what_), begin_, dclock(), value_);
}

}  // namespace mars::host
