#include "host/render/trace/timeline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace mars::trace {
namespace {

using Kind = messages::Event::Kind;

// Names a message among all: between two ranks they arrive in the order sent.
struct MessageKey {
  int from;
  int to;
  std::uint32_t number;

  auto operator<=>(const MessageKey&) const = default;
};

MessageKey key_of(const Trace::Record& record) {
  const messages::Event& event = record.event;
  if (event.kind == Kind::sent) return {record.rank, event.peer, event.number};
  return {event.peer, record.rank, event.number};
}

void match_messages(std::vector<TimelineItem>& items) {
  using Place = std::pair<MessageKey, std::size_t>;
  std::vector<Place> sent;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].record.event.kind == Kind::sent) sent.emplace_back(key_of(items[i].record), i);
  std::sort(sent.begin(), sent.end());
  std::uint32_t arrow = 0;
  for (TimelineItem& item : items) {
    if (item.record.event.kind != Kind::taken) continue;
    const MessageKey key = key_of(item.record);
    const auto found = std::lower_bound(sent.begin(), sent.end(), Place{key, 0});
    if (found == sent.end() || found->first != key) continue;
    item.arrow = items[found->second].arrow = ++arrow;
  }
}

struct Change {
  std::int64_t time;
  Counter counter;
  int rank;
  int by;
};

void add_changes(const TimelineItem& item, int host, std::vector<Change>& changes) {
  const auto& [event, rank] = item.record;
  if (event.kind == Kind::sent && event.what == wire::kStrip) {
    changes.push_back({item.begin, Counter::credits, rank, -1});
    changes.push_back({item.begin, Counter::strips_on_the_way, host, 1});
  } else if (event.kind == Kind::taken && event.what == wire::kStrip) {
    changes.push_back({item.end, Counter::strips_on_the_way, host, -1});
  } else if (event.kind == Kind::taken && event.what == wire::kCredit) {
    changes.push_back({item.end, Counter::credits, rank, 1});
  } else if (event.kind == Kind::span && rank == host && event.what == static_cast<int>(HostSpan::write)) {
    changes.push_back({item.begin - std::int64_t{event.number} * 1000, Counter::frames_with_sinks, host, 1});
    changes.push_back({item.end, Counter::frames_with_sinks, host, -1});
  }
}

}  // namespace

std::vector<TimelineItem> timeline_of(const Trace& trace) {
  std::vector<TimelineItem> items;
  items.reserve(trace.records().size());
  const auto nanoseconds = [&](int rank, double time) { return std::llround(trace.since_begin(rank, time) * 1e9); };
  for (const Trace::Record& record : trace.records())
    items.push_back(
        {nanoseconds(record.rank, record.event.begin), nanoseconds(record.rank, record.event.end), record, 0});
  std::stable_sort(items.begin(), items.end(), [](const TimelineItem& a, const TimelineItem& b) {
    return std::tie(a.begin, b.end) < std::tie(b.begin, a.end);
  });
  match_messages(items);
  return items;
}

std::vector<CounterStep> counters_of(const Trace& trace, const std::vector<TimelineItem>& timeline) {
  std::vector<Change> changes;
  for (const TimelineItem& item : timeline) add_changes(item, trace.host(), changes);
  std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.time < b.time; });
  std::map<std::pair<Counter, int>, int> values;
  for (int node = 0; node < trace.host(); ++node) values[{Counter::credits, node}] = 0;
  std::vector<CounterStep> steps;
  for (const auto& [counter_of, value] : values) steps.push_back({0, counter_of.first, counter_of.second, value});
  for (const Change& change : changes) {
    int& value = values[{change.counter, change.rank}];
    steps.push_back({change.time, change.counter, change.rank, value += change.by});
  }
  return steps;
}

}  // namespace mars::trace
