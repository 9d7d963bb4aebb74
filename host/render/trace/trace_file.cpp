#include "host/render/trace/trace_file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>

#include "hal/messages/message_types.h"
#include "host/content/document/whole_file.h"
#include "host/render/trace/timeline.h"

namespace mars::trace {
namespace {

using nlohmann::ordered_json;
using Kind = messages::Event::Kind;

constexpr int kMainThread = 1;  // thread ids of 0 mean "idle" to some viewers
constexpr int kFirstSinkThread = 2;
constexpr std::size_t kBlock = 1 << 20;  // bytes written at a time

constexpr std::array kHostSpanNames{"load film", "give", "strip", "prepare", "compose", "wait for sinks", "write"};
constexpr std::array kMessageNames{"",      "Hello",      "Load",    "film",      "Loaded", "Render",    "Credit",
                                   "Strip", "Fault",      "Stop",    "Clock",     "Trace",  "triangles", "CZB",
                                   "Beat",  "BeginView",  "Draw",    "CloseView", "Drawn",  "Written",   "Storage",
                                   "edge",  "background", "picture", "Write",     "bands"};
static_assert(kMessageNames.size() == wire::kBands + 1);
constexpr std::array kCounterNames{"credits", "strips on the way", "frames with the sinks"};

// Names contain what people typed, which need not be UTF-8.
std::string text_of(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

class Writer {
 public:
  Writer(const Trace& trace, const document::Write& write) : trace_(trace), write_(write) {}

  void write(const TraceHead& head);

 private:
  void names();
  void name(const char* what, int process, int thread, const ordered_json& arguments);
  void event(const ordered_json& event);
  void slice(const TimelineItem& item);
  void arrow(const TimelineItem& item);
  void counter(const CounterStep& step);
  void instant(const std::string& text, double seconds);
  std::string peer_text(int rank) const { return rank == trace_.host() ? "\"host\"" : std::to_string(rank); }
  std::string slice_name(const Trace::Record& record) const;
  std::string slice_arguments(const Trace::Record& record) const;
  int thread_of(const Trace::Record& record) const;

  // Begins the next event by hand, for there are up to millions of them: {"ph":"X","pid":0,"tid":1,"ts":12.345
  void open(char phase, int process, int thread, std::int64_t nanoseconds);
  void put(std::string_view text) { text_ += text; }
  void begin_line();
  void flush();

  const Trace& trace_;
  const document::Write& write_;
  std::string text_;
  bool first_ = true;
};

std::string microseconds(std::int64_t nanoseconds) {
  char text[40];
  const int length = std::snprintf(text, sizeof text, "%.3f", static_cast<double>(nanoseconds) / 1000);
  return {text, static_cast<std::size_t>(length)};
}

void Writer::begin_line() {
  if (text_.size() > kBlock) flush();
  put(first_ ? "\n" : ",\n");
  first_ = false;
}

void Writer::event(const ordered_json& event) {
  begin_line();
  put(text_of(event));
}

void Writer::open(char phase, int process, int thread, std::int64_t nanoseconds) {
  begin_line();
  put("{\"ph\":\"");
  text_ += phase;
  put("\",\"pid\":" + std::to_string(process) + ",\"tid\":" + std::to_string(thread) +
      ",\"ts\":" + microseconds(nanoseconds));
}

void Writer::flush() {
  write_(text_);
  text_.clear();
}

void Writer::name(const char* what, int process, int thread, const ordered_json& arguments) {
  event({{"ph", "M"}, {"pid", process}, {"tid", thread}, {"ts", 0}, {"name", what}, {"args", arguments}});
}

// The host on top, then the nodes in their order.
void Writer::names() {
  const auto process = [this](int rank, const std::string& called, int place) {
    name("process_name", rank, kMainThread, {{"name", called}});
    name("process_sort_index", rank, kMainThread, {{"sort_index", place}});
  };
  process(trace_.host(), "host", 0);
  name("thread_name", trace_.host(), kMainThread, {{"name", "farm"}});
  for (const wire::Hello& node : trace_.nodes()) {
    std::string called = "node " + std::to_string(node.node) + " on " + node.host.data();
    if (node.binding[0] != '\0') called += std::string(", ") + node.binding.data();
    process(node.node, called, node.node + 1);
    name("thread_name", node.node, kMainThread, {{"name", "node"}});
  }
  int sinks = 0;
  for (const Trace::Record& record : trace_.records()) sinks = std::max(sinks, thread_of(record) - kMainThread);
  for (int sink = 0; sink < sinks; ++sink)
    name("thread_name", trace_.host(), kFirstSinkThread + sink, {{"name", "sink " + std::to_string(sink)}});
}

int Writer::thread_of(const Trace::Record& record) const {
  const messages::Event& event = record.event;
  const bool of_sink =
      event.kind == Kind::span && record.rank == trace_.host() && event.what == static_cast<int>(HostSpan::write);
  return of_sink ? kFirstSinkThread + event.peer : kMainThread;
}

std::string Writer::slice_name(const Trace::Record& record) const {
  const messages::Event& event = record.event;
  if (event.kind == Kind::sent) return "send " + message_name(event.what);
  if (event.kind == Kind::taken) return "take " + message_name(event.what);
  if (event.kind == Kind::waited) return event.peer < 0 ? "wait until sent" : "wait for " + message_name(event.what);
  const auto what = static_cast<std::size_t>(event.what);
  if (record.rank == trace_.host()) return kHostSpanNames.at(what);
  const bool frame = what >= static_cast<std::size_t>(wire::Phase::keyframe);
  return wire::kPhaseNames.at(what) + (frame ? " " + std::to_string(event.frame) : std::string());
}

std::string Writer::slice_arguments(const Trace::Record& record) const {
  const messages::Event& event = record.event;
  const std::string value = std::to_string(event.value);
  std::string frame = record.rank == trace_.host() ? "" : "\"frame\":" + std::to_string(event.frame);
  if (event.kind != Kind::span) {
    if (event.peer < 0) return frame;
    if (!frame.empty()) frame = "," + frame;
    return (event.kind == Kind::sent ? "\"to\":" : "\"from\":") + peer_text(event.peer) + ",\"bytes\":" + value + frame;
  }
  if (record.rank != trace_.host()) {
    const bool whole = event.what >= static_cast<int>(wire::Phase::keyframe);
    return frame + (whole ? ",\"interval\":" + value : "");
  }
  switch (static_cast<HostSpan>(event.what)) {
    case HostSpan::load: return "\"bytes\":" + value;
    case HostSpan::give: return "\"interval\":" + value;
    case HostSpan::prepare:
    case HostSpan::finish: return "";
    case HostSpan::write: return "\"frame\":" + value + ",\"queued_microseconds\":" + std::to_string(event.number);
    default: return "\"frame\":" + value;
  }
}

void Writer::slice(const TimelineItem& item) {
  const Trace::Record& record = item.record;
  constexpr std::array categories{"phase", "message", "message", "wait"};  // by Kind
  open('X', record.rank, thread_of(record), item.begin);
  put(",\"dur\":" + microseconds(item.end - item.begin) + ",\"name\":\"" + slice_name(record) + "\",\"cat\":\"" +
      categories[static_cast<std::size_t>(record.event.kind)] + "\"");
  if (record.event.kind == Kind::waited) put(",\"cname\":\"grey\"");
  put(",\"args\":{" + slice_arguments(record) + "}}");
}

// From the beginning of the sending to the middle of the taking, so that each end lies within its slice.
void Writer::arrow(const TimelineItem& item) {
  const bool sent = item.record.event.kind == Kind::sent;
  open(sent ? 's' : 'f', item.record.rank, kMainThread, sent ? item.begin : (item.begin + item.end) / 2);
  put(",\"id\":" + std::to_string(item.arrow) + ",\"name\":\"" + message_name(item.record.event.what) +
      "\",\"cat\":\"message\"" + (sent ? "}" : ",\"bp\":\"e\"}"));
}

void Writer::counter(const CounterStep& step) {
  open('C', step.rank, kMainThread, step.time);
  const std::string name = kCounterNames[static_cast<std::size_t>(step.counter)];
  put(",\"name\":\"" + name + "\",\"args\":{\"count\":" + std::to_string(step.value) + "}}");
}

void Writer::instant(const std::string& text, double seconds) {
  event({{"ph", "i"}, {"pid", trace_.host()}, {"tid", kMainThread}, {"ts", seconds * 1e6}, {"s", "g"}, {"name", text}});
}

void Writer::write(const TraceHead& head) {
  const ordered_json other = {{"film", head.film},
                              {"backend", head.backend},
                              {"nodes", trace_.nodes().size()},
                              {"events", trace_.records().size()},
                              {"events_beyond_bound", trace_.beyond_bound()},
                              {"events_lost_by_ranks", trace_.lost()},
                              {"clock_error_microseconds", trace_.clock_error() * 1e6},
                              {"fault", trace_.fault() ? trace_.fault()->reason : ""}};
  put("{\"displayTimeUnit\":\"ms\",\"otherData\":" + text_of(other) + ",\"traceEvents\":[");
  names();
  const std::vector<TimelineItem> timeline = timeline_of(trace_);
  for (const TimelineItem& item : timeline) {
    slice(item);
    if (item.arrow != 0) arrow(item);
  }
  for (const CounterStep& step : counters_of(trace_, timeline)) counter(step);
  if (const auto& first = trace_.first_beyond())
    instant("the trace is full: " + std::to_string(trace_.beyond_bound()) + " later events are left out",
            trace_.since_begin(first->rank, first->event.begin));
  if (trace_.fault())
    instant("failed: " + trace_.fault()->reason, trace_.since_begin(trace_.host(), trace_.fault()->time));
  put("\n]}\n");
  flush();
}

}  // namespace

std::string message_name(std::int32_t type) {
  if (type >= messages::kFirstInternalType) return "sums";
  const auto index = static_cast<std::size_t>(type);
  return index < kMessageNames.size() ? kMessageNames[index] : "type " + std::to_string(type);
}

void write_trace(const std::filesystem::path& path, const TraceHead& head, const Trace& trace) {
  document::write_whole_file(path, [&](const document::Write& write) { Writer(trace, write).write(head); });
}

}  // namespace mars::trace
