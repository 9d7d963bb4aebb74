// Real nodes whose rendering is cancelled while they draw, wait for credit and have work ahead: all end in order.
#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <vector>

#include "host/render/sinks/sink_pool.h"
#include "node/firmware.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"

namespace mars::test {
namespace {

constexpr std::uint32_t kFrames = 400;

// Cancels with the frame of this number of those it takes.
class CancellingSink : public sinks::Sink {
 public:
  CancellingSink(farm::Cancellation& cancellation, int after) : cancellation_(cancellation), left_(after) {}
  void take(compositor::Frame&) override {
    if (--left_ == 0) cancellation_.cancel();
  }

 private:
  farm::Cancellation& cancellation_;
  std::atomic<int> left_;
};

struct Cancelled {
  farm::FarmReport report;
  std::size_t frames = 0;
  int nodes_ended = 0;
};

Cancelled cancel_after(int frames, std::uint32_t interval, int nodes, trace::Trace* trace = nullptr) {
  const FilmBlock block(crowd(64, 48, kFrames, interval));
  farm::PlanRequest work{std::vector<std::uint32_t>(kFrames), true, 2};
  std::iota(work.frames.begin(), work.frames.end(), 0u);
  const farm::Plan plan = farm::make_plan(block.view(), work, nodes);
  farm::Cancellation cancellation;
  CancellingSink sink(cancellation, frames);
  farm::FarmOptions options;
  options.cancellation = &cancellation;
  options.trace = trace;
  Cancelled out;
  farm::FarmListener listener;
  listener.finished = [&](const farm::FinishedFrame&) { ++out.frames; };
  std::atomic<int> ended = 0;
  const auto host = [&] {
    sinks::SinkPool pool(sink, {64, 48, 16, 3, 1});
    out.report = farm::render_film(block.bytes(), plan, options, pool, listener);
  };
  const auto node = [&] {
    node::run_node({"test", "", {}, 16 << 20, ""});
    ++ended;
  };
  threads::run_threads(nodes, host, node);
  out.nodes_ended = ended;
  return out;
}

TEST(Cancel, NodesEndInOrder) {
  for (const int nodes : {1, 2, 5})
    for (const std::uint32_t interval : {1u, 4u, kFrames}) {
      const Cancelled cancelled = cancel_after(9, interval, nodes);
      EXPECT_TRUE(cancelled.report.cancelled);
      EXPECT_LT(cancelled.frames, kFrames / 2);
      EXPECT_EQ(cancelled.nodes_ended, nodes);
    }
}

TEST(Cancel, ATracedRunHasItsTrace) {
  trace::Trace trace;
  const Cancelled cancelled = cancel_after(9, 4, 3, &trace);
  EXPECT_TRUE(cancelled.report.cancelled);
  EXPECT_FALSE(trace.records().empty());
  EXPECT_EQ(cancelled.nodes_ended, 3);
}

}  // namespace
}  // namespace mars::test
