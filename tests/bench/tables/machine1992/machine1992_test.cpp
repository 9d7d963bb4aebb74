// The 1992 program draws what the product draws, and sends what the thesis says.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "hal/simulated/run_simulated.h"
#include "hal/threads/run_threads.h"
#include "tests/bench/tables/machine1992/job.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"

namespace mars::machine1992 {
namespace {

constexpr std::uint32_t kInbetweens = 6;

struct Drawn {
  test::FilmRun run;
  Records records;
};

Drawn draw(const test::FilmBlock& film, int nodes) {
  Drawn drawn;
  drawn.records = run_job(
      {film.view(), 0, film.view().settings().frames - 1}, nodes,
      [](int count, const auto& host, const auto& node) { threads::run_threads(count, host, node); },
      [&](std::uint32_t frame, const auto& screen) { drawn.run.frames[frame] = screen; });
  return drawn;
}

wire::FilmData film() { return test::crowd(193, 127, kInbetweens + 1, kInbetweens + 1); }

class Machine1992 : public testing::TestWithParam<int> {};

TEST_P(Machine1992, DrawsTheProductsFrames) {
  const test::FilmBlock block(film());
  test::expect_same(draw(block, GetParam()).run, test::run_film(block.bytes()), block.view().settings(), "machine1992");
}

TEST_P(Machine1992, DrawsTies) {
  const test::FilmBlock block(test::ties(160, 120));
  test::expect_same(draw(block, GetParam()).run, test::run_film(block.bytes()), block.view().settings(), "ties1992");
}

// A triangle much thinner than a pixel, 40 lines high as it stands and 40 columns wide as it lies, between pixels'
// centres.
wire::FilmData sliver(bool standing) {
  test::FilmMaker maker(160, 120, 1);
  modeler::Mesh mesh{.vertices = {{0.003f, 0, -2.013f}, {0.004f, 0, -2.013f}, {0.0035f, 0, 2}},
                     .normals = {},
                     .corners = {0, 1, 2},
                     .ends = {3}};
  if (!standing)
    for (auto& [x, y, z] : mesh.vertices) std::swap(x, z);
  maker.add_segment(maker.add_shape(modeler::cut_meshlets(mesh)), maker.add_material(test::kClay),
                    {test::placed({0, 0, 0}, 1)});
  maker.set_cameras({test::looking({0, -10, 0}, {0, 0, 0}, 2 * std::atan(0.6) * 180 / std::numbers::pi)});
  return maker.make();
}

WorkCounts work_of_keyframe(const wire::FilmData& film, int nodes) {
  const test::FilmBlock block(film);
  const Records records = draw(block, nodes).records;
  WorkCounts work;
  for (const auto& frames : records.nodes) {
    work += frames[0].lists;
    work += frames[0].lines;
  }
  return work;
}

// "Find and store the intersection points of each polygon with the scanlines", whether a pixel lies between them or
// not.
TEST_P(Machine1992, MakesAnEdgeBoxOnEachLineThatAPolygonCrosses) {
  const WorkCounts standing = work_of_keyframe(sliver(true), GetParam()),
                   lying = work_of_keyframe(sliver(false), GetParam());
  for (const Work kind : {Work::edge_box, Work::span}) {
    EXPECT_EQ(standing[kind], 40u);
    EXPECT_EQ(lying[kind], 0u);
  }
  EXPECT_EQ(standing[Work::set_up], 1u);
  EXPECT_EQ(lying[Work::set_up], 0u);
  for (const WorkCounts& work : {standing, lying}) {
    EXPECT_EQ(work[Work::polygon], 1u);
    EXPECT_EQ(work[Work::pixel], 0u);
  }
}

// Each node its edge boxes on others' lines, all pixels of its lines of both buffers, and its part of the CZB; of an
// inbetween, which one node draws, one message.
TEST_P(Machine1992, SendsWhatTheThesisSays) {
  const test::FilmBlock block(film());
  const Records records = draw(block, GetParam()).records;
  const std::uint64_t pixels = 193 * 127;
  std::uint64_t strip_bytes = 0, depth_bytes = 0, inbetweens = 0, made = 0, drawn_pixels = 0;
  for (std::size_t node = 0; node < records.nodes.size(); ++node) {
    const auto& frames = records.nodes[node];
    ASSERT_FALSE(frames.empty());
    EXPECT_TRUE(frames[0].keyframe);
    EXPECT_EQ(frames[0].strips.size(), 2u);
    for (const std::uint64_t bytes : frames[0].strips) strip_bytes += bytes - sizeof(StripHead);
    depth_bytes += frames[0].depths;
    EXPECT_EQ(frames[0].sent.size(), records.nodes.size());
    EXPECT_EQ(frames[0].sent[node], 0u);
    made += frames[0].lists[Work::edge_box];
    drawn_pixels += frames[0].lines[Work::pixel];
    for (std::size_t k = 1; k < frames.size(); ++k, ++inbetweens) {
      EXPECT_EQ((frames[k].frame - 1) % records.nodes.size(), node);
      EXPECT_EQ(frames[k].strips.size(), 1u);
      EXPECT_TRUE(frames[k].sent.empty());
    }
  }
  EXPECT_EQ(strip_bytes, 2 * 4 * pixels);
  EXPECT_EQ(depth_bytes, 4 * pixels);
  EXPECT_EQ(inbetweens, kInbetweens);
  const Records alone = draw(block, 1).records;
  EXPECT_EQ(made, alone.nodes[0][0].lists[Work::edge_box]);
  EXPECT_EQ(drawn_pixels, alone.nodes[0][0].lines[Work::pixel]);
}

TEST_P(Machine1992, CountsTheSameAgain) {
  const test::FilmBlock block(film());
  EXPECT_EQ(draw(block, GetParam()).records, draw(block, GetParam()).records);
}

struct Timed {
  Drawn drawn;
  double seconds;
};

Timed draw_simulated(const test::FilmBlock& film, int nodes, double unit) {
  simulated::Machine machine;
  machine.host_apart = true;
  machine.network = {.topology = simulated::Topology::hypercube, .hop = 30e-6, .byte = 1 / 2.8e6, .host_byte = 1e-6};
  machine.network.host_end = {{0, 0}, {1, 0.02}};
  machine.work.assign(kWorks, unit);
  Timed timed{};
  const Run run = [&](int count, const auto& host, const auto& node) {
    timed.seconds = simulated::run_simulated(
        machine, count, [&](simulated::World&) { host(); }, node);
  };
  timed.drawn.records =
      run_job({film.view(), 0, kInbetweens}, nodes, run,
              [&](std::uint32_t frame, const auto& screen) { timed.drawn.run.frames[frame] = screen; });
  return timed;
}

// Its time is at least the host's: whole CFB and MFB over its link, a cost for each strip, its own work.
TEST_P(Machine1992, TakesTheSameSimulatedTimeAgain) {
  const test::FilmBlock block(film());
  const double unit = 1e-6;
  const Timed once = draw_simulated(block, GetParam(), unit), again = draw_simulated(block, GetParam(), unit);
  test::expect_same(once.drawn.run, test::run_film(block.bytes()), block.view().settings(), "simulated1992");
  EXPECT_EQ(once.seconds, again.seconds);
  EXPECT_EQ(once.drawn.records, draw(block, GetParam()).records);
  double least = 0;
  for (const auto& node : once.drawn.records.nodes)
    for (const NodeRecord& frame : node)
      for (const std::uint64_t bytes : frame.strips) least += 0.02 + 1e-6 * static_cast<double>(bytes);
  for (const WorkCounts& frame : once.drawn.records.host)
    least += unit * static_cast<double>(frame[Work::copy] + frame[Work::look]);
  EXPECT_GT(once.seconds, least);
  EXPECT_GT(draw_simulated(block, GetParam(), 2 * unit).seconds, once.seconds);
}

INSTANTIATE_TEST_SUITE_P(Nodes, Machine1992, testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace mars::machine1992
