#include "host/render/trace/trace.h"

#include <algorithm>
#include <numeric>

namespace mars::trace {

Trace::Trace(std::size_t most_events) : most_(most_events) { records_.reserve(most_events); }

void Trace::begin(std::span<const wire::Hello> nodes, double now) {
  nodes_.assign(nodes.begin(), nodes.end());
  clocks_.resize(nodes.size() + 1);
  lost_.resize(nodes.size() + 1);
  begin_ = now;
}

void Trace::add(int rank, std::span<const messages::Event> half) {
  for (const messages::Event& event : half.first(half.size() - 1)) store({event, rank});
  lost_.at(static_cast<std::size_t>(rank)) = half.back().value;
}

void Trace::add(const sinks::SinkPool::Taken& frame) {
  messages::Event event{};
  event.begin = frame.begun;
  event.end = frame.ended;
  event.kind = messages::Event::Kind::span;
  event.what = static_cast<std::int32_t>(HostSpan::write);
  event.value = frame.number;
  event.peer = static_cast<std::int32_t>(frame.thread);
  event.number = static_cast<std::uint32_t>((frame.begun - frame.submitted) * 1e6);
  store({event, host()});
}

void Trace::fail(const std::string& reason, double now) { fault_ = {reason, now}; }

void Trace::store(const Record& record) {
  if (records_.size() < most_) {
    records_.push_back(record);
    return;
  }
  ++beyond_bound_;
  if (!first_beyond_) first_beyond_ = record;
}

double Trace::since_begin(int rank, double time) const {
  return clocks_.at(static_cast<std::size_t>(rank)).to_host(time) - begin_;
}

double Trace::clock_error() const {
  double error = 0;
  for (const NodeClock& clock : clocks_) error = std::max(error, clock.error());
  return error;
}

std::uint64_t Trace::lost() const { return std::accumulate(lost_.begin(), lost_.end(), std::uint64_t{0}); }

}  // namespace mars::trace
