// Films over simulated machines: the same pictures as over threads, and the same times in every run.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <tuple>
#include <vector>

#include "hal/simulated/run_simulated.h"
#include "host/content/modeler/primitives.h"
#include "host/render/sinks/served_sinks.h"
#include "node/wire/work.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

simulated::Machine machine(int nodes, int processors) {
  simulated::Machine machine{.nodes = nodes, .processors = processors, .host_apart = nodes == 1};
  machine.work.assign(wire::kWorkNames.size(), 1e-8);
  machine.network = {.latency = 1e-6, .byte = 1e-10, .local_latency = 1e-7, .local_byte = 1e-10};
  machine.network.send = machine.network.receive = {{0, 1e-6}};
  return machine;
}

FilmRun run_simulated(std::span<const std::byte> film, RunOptions options, const simulated::Machine& machine,
                      double sink_seconds = 1e-3) {
  FilmRun run;
  const auto host = [&](simulated::World& world) {
    options.make_sinks = [&](sinks::Sink& sink, const sinks::SinkPool::Shape& shape) {
      return std::make_unique<sinks::ServedSinks>(sink, shape, [&](const images::FileWork&) {
        const double end = world.reserve(world.nodes(), sink_seconds);
        world.set_alarm(world.nodes(), end);
        return sinks::ServedSinks::Times{sink_seconds, end, end};
      });
    };
    run = render_as_host(film, options);
  };
  simulated::run_simulated(machine, options.nodes, host, [&] { run_as_node(options); });
  return run;
}

// Every inbetween takes about as long.
wire::FilmData turning_box(std::uint32_t interval) {
  FilmMaker maker(60, 34, std::max(401u, interval));
  const std::uint32_t box = maker.add_shape(modeler::make_box());
  const std::uint32_t clay = maker.add_material(kClay);
  std::vector<wire::Matrix> motion;
  for (std::uint32_t frame = 0; frame < maker.film.settings.frames; ++frame)
    motion.push_back(placed({0, 0, 0}, 1, 0.37 * frame));
  maker.add_segment(box, clay, motion);
  maker.add_segment(box, clay, {placed({1, 0, 0}, 1)});
  maker.set_cameras({looking({1, -5, 3}, {0, 0, 0}, 40)});
  return maker.make(interval);
}

// A film of one long interval, or of many short ones, on four computers of which number 2 is slow at times. The host
// has a computer of its own, and work costs so much that messages count for little.
class SlowComputer : public testing::Test {
 protected:
  static constexpr std::uint32_t kAll = 401;  // frames: in one interval

  // `slowness`: of the computer at a time.
  FilmRun render(std::uint32_t interval, const std::function<double(double)>& slowness, bool adapts = true) {
    const FilmBlock block(turning_box(interval));
    RunOptions options;
    options.nodes = 4;
    options.work.groups = 1;
    options.farm.adapts = adapts;
    simulated::Machine machine = test::machine(1, 1);
    machine.host_apart = true;
    machine.work.assign(wire::kNodeKinds, 1e-4);
    machine.work[static_cast<std::size_t>(wire::Work::first_frame)] = 0;
    machine.work[static_cast<std::size_t>(wire::Work::fresh_byte)] = 0;
    machine.slowness = [=](int computer, double now) { return computer == 2 ? slowness(now) : 1; };
    return run_simulated(block.bytes(), options, machine, 0);
  }
  static std::vector<int> inbetweens(const FilmRun& run) {
    std::vector<int> drawn(4);
    for (const wire::Strip& strip : run.report.strips)
      drawn[static_cast<std::size_t>(strip.node)] += strip.kind == wire::FrameKind::inbetween;
    return drawn;
  }
};

double never_slow(double) { return 1; }
double at_half_speed(double) { return 2; }

TEST_F(SlowComputer, WhereNoneIsSlowInbetweensGoInTurns) {
  for (const std::uint32_t interval : {kAll, 41u, 9u}) {
    const FilmRun fixed = render(interval, never_slow, false), adapted = render(interval, never_slow);
    EXPECT_EQ(inbetweens(adapted), inbetweens(fixed));
    EXPECT_NEAR(adapted.report.total_seconds, fixed.report.total_seconds, 1e-4 * fixed.report.total_seconds)
        << "portions cost nothing";
    EXPECT_TRUE(adapted.report.slow_times.empty());
  }
}

// Three nodes and a half.
TEST_F(SlowComputer, ALongIntervalTakesWhatTheNodesCanDo) {
  const double ideal = render(kAll, never_slow).report.total_seconds * 4 / 3.5;
  const FilmRun run = render(kAll, at_half_speed);
  EXPECT_LT(run.report.total_seconds, 1.05 * ideal);
  EXPECT_GT(render(kAll, at_half_speed, false).report.total_seconds, 1.6 * ideal) << "in turns";
  expect_same(run, render(kAll, never_slow, false), turning_box(kAll).settings, "slow-computer");
  ASSERT_EQ(run.report.slow_times.size(), 1u);
  const farm::SlowTime slow = run.report.slow_times.front();
  EXPECT_EQ(slow.node, 2);
  EXPECT_NEAR(slow.slowness, 2, 0.2);
  EXPECT_FALSE(slow.end);
}

TEST_F(SlowComputer, ShortIntervalsGiveItFewer) {
  const FilmRun fixed = render(41, at_half_speed, false), adapted = render(41, at_half_speed);
  EXPECT_LT(adapted.report.total_seconds, 0.85 * fixed.report.total_seconds);
  EXPECT_LT(inbetweens(adapted)[2], 80) << "of 392";
  expect_same(adapted, fixed, turning_box(41).settings, "slow-computer");
}

TEST_F(SlowComputer, GetsItsTurnsAgainWhenItHasRecovered) {
  const auto slow_at_first = [](double now) { return now < 14 ? 2.0 : 1.0; };
  const FilmRun run = render(2 * kAll, slow_at_first);
  ASSERT_EQ(run.report.slow_times.size(), 1u);
  const farm::SlowTime slow = run.report.slow_times.front();
  EXPECT_LT(slow.begin, 14);
  ASSERT_TRUE(slow.end);
  EXPECT_GT(*slow.end, 14);
  EXPECT_LT(*slow.end, 24);
}

// A node that stops for long is not waited for with more than it has been given.
TEST_F(SlowComputer, AVerySlowOneIsNotGivenALongInterval) {
  const FilmRun run = render(kAll, [](double) { return 20.0; });
  EXPECT_LE(inbetweens(run)[2], 20);
  EXPECT_LT(run.report.total_seconds, 0.2 * render(
                                                kAll, [](double) { return 20.0; }, false)
                                                .report.total_seconds);
}

class Simulated : public testing::TestWithParam<std::uint32_t> {  // samples a pixel
 protected:
  const wire::FilmData film = with_samples(crowd(120, 68, 7, 3), GetParam());
};

TEST_P(Simulated, PicturesAreThoseOfThreads) {
  const FilmBlock block(film);
  const FilmRun expected = run_film(block.bytes());
  for (const auto& [nodes, groups, each, processors] :
       {std::tuple{1, 1u, 1, 1}, {3, 1u, 1, 1}, {8, 2u, 1, 1}, {8, 2u, 3, 1}, {7, 3u, 2, 4}}) {
    RunOptions options;
    options.nodes = nodes;
    options.work.groups = groups;
    expect_same(run_simulated(block.bytes(), options, machine(each, processors)), expected, film.settings,
                "simulated-" + std::to_string(nodes) + "-" + std::to_string(groups) + "-" + std::to_string(each));
  }
}

TEST_P(Simulated, EveryRunTakesTheSameTime) {
  const FilmBlock block(film);
  RunOptions options;
  options.nodes = 6;
  options.work.groups = 2;
  const auto first = run_simulated(block.bytes(), options, machine(1, 1)).report,
             again = run_simulated(block.bytes(), options, machine(1, 1)).report;
  EXPECT_GT(first.total_seconds, 0.007) << "a millisecond for each frame's sink";
  EXPECT_EQ(first.total_seconds, again.total_seconds);
  EXPECT_EQ(first.load_seconds, again.load_seconds);
  ASSERT_EQ(first.frames.size(), again.frames.size());
  for (std::size_t i = 0; i < first.frames.size(); ++i) EXPECT_EQ(first.frames[i].seconds, again.frames[i].seconds);
}

INSTANTIATE_TEST_SUITE_P(Samples, Simulated, testing::Values(1, 4));

}  // namespace
}  // namespace mars::test
