// A traced run: its pictures are the same, and its trace agrees with the report and with a counting backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "hal/messages/message_types.h"
#include "host/render/trace/trace_file.h"
#include "node/frame_report.h"
#include "tests/hal/counting_backend.h"
#include "tests/temporary_folder.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"

namespace mars::test {
namespace {

using nlohmann::json;
using trace::Trace;
using Kind = messages::Event::Kind;

constexpr std::uint32_t kTracedFrames = 9, kInterval = 3;

struct TracedCase {
  int nodes;
  std::uint64_t memory;  // bytes a frame; little makes several passes
};

void PrintTo(const TracedCase& c, std::ostream* out) { *out << c.nodes << " nodes, " << c.memory << " bytes"; }

class Tracing : public testing::TestWithParam<TracedCase> {
 protected:
  Tracing() : block_(crowd(160, 120, kTracedFrames, kInterval)) {
    RunOptions options;
    options.nodes = GetParam().nodes;
    options.memory = GetParam().memory;
    options.work.groups = 1;
    plain_ = run_film(block_.bytes(), options);
    options.farm.trace = &trace_;
    options.wrap = messages::counting(counts_);
    traced_ = run_film(block_.bytes(), options);
    options.farm.trace = nullptr;
    options.work.groups =
        static_cast<std::uint32_t>(GetParam().nodes);  // of one node, which give each other nothing else
    options.work.frames = {0};
    options.wrap = messages::counting(loading_);
    run_film(block_.bytes(), options);
  }

  int host() const { return GetParam().nodes; }
  json written() const {
    const test::TemporaryFolder folder;
    trace::write_trace(folder / "trace.json", {"crowd", "threads"}, trace_);
    std::ifstream file(folder / "trace.json");
    return json::parse(file);
  }

  FilmBlock block_;
  FilmRun plain_, traced_;
  messages::Counts counts_;
  messages::Counts loading_;  // what nodes give each other while a film is loaded, before recording begins
  Trace trace_;
};

TEST_P(Tracing, PicturesAreTheSame) {
  expect_same(traced_, plain_, block_.view().settings(), "traced");
  EXPECT_EQ(traced_.frames.size(), kTracedFrames);
  EXPECT_EQ(trace_.left_out(), 0u);
  EXPECT_EQ(trace_.clock_error(), 0) << "all share one clock";
}

// The spans of a node for a frame are the report's seconds, phase by phase.
TEST_P(Tracing, PhasesAddUpToTheReport) {
  std::map<std::tuple<int, int, int>, std::pair<int, double>> spans;  // by node, frame, phase: how many, seconds
  for (const auto& [event, rank] : trace_.records()) {
    if (event.kind != Kind::span || rank == host()) continue;
    auto& [count, seconds] = spans[{rank, event.frame, event.what}];
    ++count;
    seconds += event.end - event.begin;
  }
  std::size_t frames = 0;
  std::uint32_t passes = 0;
  for (const wire::Strip& strip : traced_.report.strips) {
    ++frames;
    passes = std::max(passes, strip.work.passes);
    const auto of = [&](wire::Phase phase) {
      return spans[{strip.node, static_cast<int>(strip.frame), static_cast<int>(phase)}];
    };
    for (std::size_t phase = 0; phase < node::kPhaseTimes.size(); ++phase) {
      const auto [count, seconds] = of(static_cast<wire::Phase>(phase));
      EXPECT_NEAR(seconds, strip.times.*node::kPhaseTimes[phase], 1e-12)
          << "phase " << phase << " of frame " << strip.frame;
      const bool gives_depth = strip.kind == wire::FrameKind::keyframe && host() > 1;
      const auto which = static_cast<wire::Phase>(phase);
      const bool writes = which >= wire::Phase::compose && which <= wire::Phase::storage;  // the host does here
      const bool expected = !writes && which != wire::Phase::shadow && (which != wire::Phase::depth || gives_depth);
      EXPECT_EQ(count > 0, expected) << "phase " << phase << " of frame " << strip.frame << " on node " << strip.node;
    }
    EXPECT_GE(of(wire::Phase::fill).first, static_cast<int>(strip.work.passes));
    const bool keyframe = strip.kind == wire::FrameKind::keyframe;
    EXPECT_EQ(of(wire::Phase::keyframe).first, keyframe ? 1 : 0);
    EXPECT_EQ(of(wire::Phase::inbetween).first, keyframe ? 0 : 1);
  }
  EXPECT_EQ(passes > 1, GetParam().memory < (1 << 20)) << "short memory makes several passes";
  EXPECT_EQ(frames,
            kTracedFrames / kInterval * static_cast<std::size_t>(host()) + kTracedFrames - kTracedFrames / kInterval);
}

// Messages from when recording began, by what a backend counts. Sums with nothing in them are the gsync before.
TEST_P(Tracing, MessagesAreThoseSent) {
  std::map<std::tuple<int, int, int>, messages::Counts::Sent> traced;
  for (const auto& [event, rank] : trace_.records()) {
    if (event.kind != Kind::sent) continue;
    messages::Counts::Sent& sent = traced[{rank, event.peer, event.what}];
    ++sent.messages;
    sent.bytes += event.value;
  }
  std::uint64_t between_nodes = 0;
  for (const auto& [key, sent] : traced) {
    const auto& [from, to, type] = key;
    const auto counted = counts_.sent({.from = from, .to = to, .type = type});
    const bool inside = from != host() && to != host();
    const std::uint64_t before = inside ? loading_.sent({.from = from, .to = to, .type = type}).bytes : 0;
    EXPECT_EQ(sent.bytes, counted.bytes - before) << from << " to " << to << ", type " << type;
    if (type < messages::kFirstInternalType) {
      EXPECT_EQ(sent.messages, counted.messages) << from << " to " << to << ", type " << type;
    }
    if (inside) between_nodes += sent.bytes;
  }
  std::uint64_t reported = 0, strips = 0;
  for (const wire::Strip& strip : traced_.report.strips) {
    reported += strip.work.bytes_to_nodes;
    strips += strip.work.passes;
  }
  EXPECT_EQ(between_nodes, reported);
  std::uint64_t traced_strips = 0;
  for (int node = 0; node < host(); ++node) traced_strips += traced[{node, host(), wire::kStrip}].messages;
  EXPECT_EQ(traced_strips, strips);
}

// In an inbetween nothing passes between nodes, tracing or not.
TEST_P(Tracing, InbetweensSendNothingToNodes) {
  std::set<int> keyframes;
  for (const auto& frame : traced_.report.frames)
    if (frame.kind == wire::FrameKind::keyframe) keyframes.insert(static_cast<int>(frame.number));
  for (const auto& [event, rank] : trace_.records()) {
    const bool to_node = event.kind == Kind::sent && rank != host() && event.peer != host();
    EXPECT_TRUE(!to_node || keyframes.contains(event.frame)) << "frame " << event.frame;
  }
}

// Of one thread's slices, each two lie apart or one within the other.
TEST_P(Tracing, SlicesNest) {
  std::map<std::pair<int, int>, std::vector<std::pair<std::int64_t, std::int64_t>>> threads;  // begin, end in ns
  const json trace = written();
  for (const json& event : trace.at("traceEvents")) {
    if (event.at("ph") != "X") continue;
    const auto nanoseconds = [&](const char* key) { return std::llround(event.at(key).get<double>() * 1000); };
    const std::int64_t begin = nanoseconds("ts");
    ASSERT_GE(nanoseconds("dur"), 0);
    threads[{event.at("pid"), event.at("tid")}].emplace_back(begin, begin + nanoseconds("dur"));
  }
  EXPECT_EQ(threads.size(), static_cast<std::size_t>(host()) + 2) << "nodes, host and one sink";
  for (auto& [thread, slices] : threads) {
    std::sort(slices.begin(), slices.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first : a.second > b.second;
    });
    std::vector<std::int64_t> open;  // ends
    for (const auto& [begin, end] : slices) {
      while (!open.empty() && open.back() <= begin) open.pop_back();
      const bool nests = open.empty() || end <= open.back();
      ASSERT_TRUE(nests) << "thread " << thread.first << "." << thread.second << " at " << begin;
      open.push_back(end);
    }
  }
}

// Every message taken has an arrow, which ends no earlier than it begins.
TEST_P(Tracing, ArrowsRunForward) {
  const json trace = written();
  std::map<int, double> begins, ends;
  std::size_t taken = 0;
  for (const json& event : trace.at("traceEvents")) {
    const std::string phase = event.at("ph");
    if (phase == "s" || phase == "f") {
      const bool fresh = (phase == "s" ? begins : ends).emplace(event.at("id"), event.at("ts")).second;
      EXPECT_TRUE(fresh) << event.dump();
    }
    if (phase == "X") taken += event.at("name").get<std::string>().starts_with("take ");
  }
  EXPECT_EQ(ends.size(), taken);
  EXPECT_EQ(begins.size(), taken);
  for (const auto& [id, end] : ends) EXPECT_GE(end, begins.at(id));
}

// Credits come back, never above what was given, and sinks and the way are empty in the end.
TEST_P(Tracing, CountersBalance) {
  const json trace = written();
  std::map<std::pair<int, std::string>, int> last;
  for (const json& event : trace.at("traceEvents")) {
    if (event.at("ph") != "C") continue;
    const int value = event.at("args").at("count");
    EXPECT_GE(value, 0) << event.dump();
    if (event.at("name") == "credits") {
      EXPECT_LE(value, 4);
    }
    last[{event.at("pid"), event.at("name")}] = value;
  }
  EXPECT_EQ((last[{host(), "strips on the way"}]), 0);
  EXPECT_EQ((last[{host(), "frames with the sinks"}]), 0);
  std::set<std::string> written_frames;
  for (const json& event : trace.at("traceEvents"))
    if (event.at("name") == "write") written_frames.insert(event.at("args").at("frame").dump());
  EXPECT_EQ(written_frames.size(), kTracedFrames);
}

INSTANTIATE_TEST_SUITE_P(Runs, Tracing,
                         testing::Values(TracedCase{1, 256 << 20}, TracedCase{2, 256 << 20}, TracedCase{3, 256 << 20},
                                         TracedCase{5, 256 << 20}, TracedCase{3, 340'000}));

class TracingShadows : public testing::Test {
 protected:
  TracingShadows() {
    wire::FilmData film = crowd(160, 120, kTracedFrames, kInterval);
    film.lights.front().casts = 1;
    block_.emplace(film);
  }

  // Nothing is kept for inbetweens.
  FilmRun render(int nodes, Trace* trace = nullptr) const {
    RunOptions options;
    options.nodes = nodes;
    options.work.groups = 1;
    options.farm.asked_memory.still = 0;
    options.farm.trace = trace;
    return run_film(block_->bytes(), options);
  }
  static std::uint64_t charged(const wire::Strip& strip, wire::Work kind) {
    return strip.work.charged[static_cast<std::size_t>(kind)];
  }

  std::optional<FilmBlock> block_;
};

TEST_F(TracingShadows, AreAPhaseOfEachFrame) {
  Trace trace;
  const FilmRun run = render(2, &trace);
  std::map<std::pair<int, int>, double> spans;  // by node and frame
  for (const auto& [event, rank] : trace.records())
    if (event.kind == Kind::span && rank < 2 && event.what == static_cast<int>(wire::Phase::shadow))
      spans[{rank, event.frame}] += event.end - event.begin;
  for (const wire::Strip& strip : run.report.strips) {
    EXPECT_GT(strip.times.shadow, 0) << "frame " << strip.frame;
    EXPECT_GT(strip.times.scanline, 0) << "frame " << strip.frame;
    EXPECT_NEAR((spans[{strip.node, static_cast<int>(strip.frame)}]), strip.times.shadow, 1e-12);
  }
}

TEST_F(TracingShadows, AreWorkOfTheirOwn) {
  using wire::Work;
  for (const wire::Strip& strip : render(1).report.strips) {
    for (const Work kind : {Work::casting_light, Work::shadow_point, Work::caster_vertex, Work::caster_triangle,
                            Work::line, Work::shaded, Work::pixel})
      EXPECT_GT(charged(strip, kind), 0u) << wire::kWorkNames[static_cast<std::size_t>(kind)] << " of " << strip.frame;
    EXPECT_EQ(charged(strip, Work::casting_light), charged(strip, Work::shaded)) << "one light casts";
    EXPECT_EQ(charged(strip, Work::pixel), strip.work.pixels);
    EXPECT_EQ(strip.work.lines_drawn_again > 0, strip.kind == wire::FrameKind::inbetween) << strip.frame;
  }
}

// Points are divided with the lines; casters are not: a node dices those of others.
TEST_F(TracingShadows, OfSeveralNodesHaveThePointsOfOne) {
  std::map<int, std::map<wire::Work, std::uint64_t>> sums;
  for (const int nodes : {1, 3})
    for (const wire::Strip& strip : render(nodes).report.strips)
      for (const wire::Work kind : {wire::Work::shadow_point, wire::Work::casting_light, wire::Work::caster_vertex,
                                    wire::Work::caster, wire::Work::diced_vertex})
        sums[nodes][kind] += charged(strip, kind);
  EXPECT_EQ(sums[1][wire::Work::shadow_point], sums[3][wire::Work::shadow_point]);
  EXPECT_EQ(sums[1][wire::Work::casting_light], sums[3][wire::Work::casting_light]);
  for (const wire::Work kind : {wire::Work::caster_vertex, wire::Work::caster, wire::Work::diced_vertex})
    EXPECT_LT(sums[1][kind], sums[3][kind]) << wire::kWorkNames[static_cast<std::size_t>(kind)];
}

// A trace that is full takes no more, and the run goes on.
TEST(TraceBound, IsHeld) {
  const FilmBlock block(crowd(64, 40, 60, 3));
  Trace trace(200);
  RunOptions options;
  options.nodes = 2;
  options.farm.trace = &trace;
  const FilmRun run = run_film(block.bytes(), options);
  EXPECT_EQ(run.frames.size(), 60u);
  EXPECT_EQ(trace.records().size(), 200u);
  EXPECT_GT(trace.beyond_bound(), 200u);
}

}  // namespace
}  // namespace mars::test
