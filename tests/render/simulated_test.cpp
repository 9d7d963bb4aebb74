// Films over simulated machines: the same pictures as over threads, and the same times in every run.
#include <gtest/gtest.h>

#include <tuple>

#include "hal/simulated/run_simulated.h"
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

// A sink takes a frame in a millisecond.
FilmRun run_simulated(std::span<const std::byte> film, RunOptions options, const simulated::Machine& machine) {
  FilmRun run;
  const auto host = [&](simulated::World& world) {
    options.make_sinks = [&](sinks::Sink& sink, const sinks::SinkPool::Shape& shape) {
      return std::make_unique<sinks::ServedSinks>(sink, shape, [&](std::uint64_t) {
        const double end = world.reserve(world.nodes(), 1e-3);
        world.set_alarm(world.nodes(), end);
        return end;
      });
    };
    run = render_as_host(film, options);
  };
  simulated::run_simulated(machine, options.nodes, host, [&] { run_as_node(options); });
  return run;
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
