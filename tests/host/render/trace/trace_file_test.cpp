#include "host/render/trace/trace_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "host/render/trace/timeline.h"
#include "tests/temporary_folder.h"

namespace mars::trace {
namespace {

using messages::Event;
using nlohmann::json;
using Kind = Event::Kind;

constexpr double kStart = 100;  // seconds of the host's clock at the trace's beginning

wire::Hello hello(std::int32_t node, const std::string& host) {
  wire::Hello hello{};
  hello.node = node;
  host.copy(hello.host.data(), hello.host.size() - 1);
  return hello;
}

Event closing(std::uint64_t lost = 0) { return {kStart, kStart, lost, Kind::lost, -1, -1, 0, -1, 0}; }

// Two nodes; node 0 sends node 1 two messages, of which the second was taken unseen.
Trace small_trace(std::size_t most = 100) {
  Trace trace(most);
  trace.begin(std::vector{hello(0, "ada"), hello(1, "a \"b\" \xff")}, kStart);
  const auto triangles = static_cast<std::int32_t>(wire::kTriangles);
  trace.add(0, std::vector<Event>{{kStart + 1e-3, kStart + 2e-3, 64, Kind::sent, triangles, 1, 0, 7, 0},
                                  {kStart + 3e-3, kStart + 4e-3, 32, Kind::sent, triangles, 1, 1, 7, 0},
                                  {kStart + 0e-3, kStart + 5e-3, 0, Kind::span, 3, -1, 0, 7, 0},
                                  closing()});
  trace.add(1, std::vector<Event>{{kStart + 2e-3, kStart + 6e-3, 64, Kind::taken, triangles, 0, 0, 7, 0}, closing(5)});
  return trace;
}

json written(const Trace& trace) {
  const test::TemporaryFolder folder;
  write_trace(folder / "trace.json", {"a film", "threads"}, trace);
  std::ifstream file(folder / "trace.json");
  return json::parse(file);
}

std::vector<json> of_phase(const json& trace, const std::string& phase) {
  std::vector<json> found;
  for (const json& event : trace.at("traceEvents"))
    if (event.at("ph") == phase) found.push_back(event);
  return found;
}

TEST(Timeline, EnclosingComesFirstAndMessagesAreMatched) {
  const auto items = timeline_of(small_trace());
  ASSERT_EQ(items.size(), 4u);
  EXPECT_EQ(items[0].record.event.kind, Kind::span);
  EXPECT_EQ(items[1].begin, 1'000'000);
  EXPECT_EQ(items[1].arrow, 1u);
  EXPECT_EQ(items[2].record.event.kind, Kind::taken);
  EXPECT_EQ(items[2].arrow, 1u);
  EXPECT_EQ(items[3].arrow, 0u) << "nobody took it";
}

TEST(TraceFile, HoldsNamesSlicesAndArrows) {
  const json trace = written(small_trace());
  EXPECT_EQ(trace.at("otherData").at("film"), "a film");
  EXPECT_EQ(trace.at("otherData").at("events_lost_by_ranks"), 5);
  EXPECT_EQ(of_phase(trace, "s").size(), 1u);
  EXPECT_EQ(of_phase(trace, "f").size(), 1u);
  const auto slices = of_phase(trace, "X");
  ASSERT_EQ(slices.size(), 4u);
  EXPECT_EQ(slices[0].at("name"), "exchange");
  EXPECT_EQ(slices[0].at("dur"), 5000);
  EXPECT_EQ(slices[1].at("name"), "send triangles");
  EXPECT_EQ(slices[1].at("args").at("to"), 1);
  EXPECT_EQ(slices[1].at("args").at("bytes"), 64);
  std::set<std::string> names;
  for (const json& name : of_phase(trace, "M"))
    if (name.at("name") == "process_name") names.insert(name.at("args").at("name"));
  EXPECT_EQ(names, (std::set<std::string>{"host", "node 0 on ada", "node 1 on a \"b\" \xEF\xBF\xBD"}));
}

TEST(TraceFile, TellsWhatIsBeyondTheBound) {
  const Trace full = small_trace(2);
  EXPECT_EQ(full.records().size(), 2u);
  EXPECT_EQ(full.left_out(), 2u + 5u);
  const json trace = written(full);
  EXPECT_EQ(trace.at("otherData").at("events_beyond_bound"), 2);
  const auto instants = of_phase(trace, "i");
  ASSERT_EQ(instants.size(), 1u);
  EXPECT_EQ(instants[0].at("name"), "the trace is full: 2 later events are left out");
  EXPECT_TRUE(of_phase(written(small_trace()), "i").empty());
}

TEST(TraceFile, TellsWhyTheRunFailed) {
  Trace failed = small_trace();
  failed.fail("node 1: a \"reason\"", kStart + 0.5);
  const json trace = written(failed);
  EXPECT_EQ(trace.at("otherData").at("fault"), "node 1: a \"reason\"");
  EXPECT_EQ(of_phase(trace, "i").at(0).at("ts"), 500'000);
}

TEST(TraceFile, ForeignClocksAreMapped) {
  Trace trace = small_trace();
  trace.add(1, ClockReading::of(kStart, kStart - 50, kStart + 2e-3));
  EXPECT_NEAR(trace.since_begin(1, kStart - 50), 1e-3, 1e-9);
  EXPECT_NEAR(written(trace).at("otherData").at("clock_error_microseconds").get<double>(), 1000, 1e-6);
}

}  // namespace
}  // namespace mars::trace
