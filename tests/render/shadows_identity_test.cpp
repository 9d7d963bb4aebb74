// Films whose lights cast shadows have the same bits however the work is divided, too: as of identity_test.cpp, which
// see.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "host/content/modeler/primitives.h"
#include "node/shadow/shadow_plan.h"
#include "node/wire/still_plan.h"
#include "tests/hal/machines_backend.h"
#include "tests/node/simd/instruction_sets.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

struct Case {
  const char* name;
  wire::FilmData film;
};

// Few bodies, still and moving, of patches and of a mesh, with the lights of the crowd: where each of many points of a
// light sees all casters.
wire::FilmData few(std::uint32_t width, std::uint32_t height, std::uint32_t frames, std::uint32_t interval) {
  FilmMaker maker(width, height, frames);
  const std::uint32_t box = maker.add_shape(modeler::make_box()), sphere = maker.add_shape(modeler::make_sphere()),
                      mesh = maker.add_shape(modeler::cut_meshlets(mesh_ball(4, 180)));
  const std::uint32_t clay = maker.add_material(kClay),
                      green = maker.add_material({{0.2f, 0.6f, 0.3f}, 0.2f, 0.7f, 0, 1, 2});
  maker.add_segment(box, clay, {placed({-6, -6, -12}, 12)});
  maker.add_segment(box, green, {placed({0.5, -1, 0}, 1.5, 0.4)});
  maker.add_segment(sphere, clay, {placed({-2, -0.5, 0.5}, 1.7)});
  for (const auto& [shape, x] : {std::pair{sphere, -1.0}, {box, -3.5}, {mesh, 1.5}}) {
    std::vector<wire::Matrix> motion;
    for (std::uint32_t f = 0; f < frames; ++f) motion.push_back(placed({x + 0.3 * f, -2.5, 1 + 0.1 * f}, 1.4, 0.2 * f));
    maker.add_segment(shape, green, motion);
  }
  for (const wire::Light& light : crowd(1, 1, 1, 1).lights) maker.add_light(light);
  maker.set_cameras({looking({1, -10, 7}, {0, -0.5, 0}, 36)});
  return maker.make(interval);
}

// Each interval is seen from elsewhere.
wire::FilmData cut() {
  wire::FilmData film = casting(few(64, 40, 9, 3), {0.0f});
  film.cameras.push_back(looking({9, 6, 6}, {0, 0, 0}, 40));
  film.cameras.push_back(looking({-10, -3, 5}, {0, 0, 0}, 35));
  film.settings.camera = {static_cast<std::uint32_t>(film.changes.size()), 3};
  for (std::uint32_t k = 0; k < 3; ++k) film.changes.push_back({3 * k, k});
  return film;
}

std::vector<Case> cases() {
  return {{"directional", casting(crowd(97, 61, 4, 4), {0.0f})},
          {"directional_large", casting(with_samples(few(40, 27, 3, 3), 4), {0.05f})},
          {"point", casting(crowd(64, 40, 4, 2), {-1.0f, 0.0f})},
          {"point_large", casting(with_samples(few(32, 20, 2, 2), 4), {-1.0f, 0.4f})},
          {"all", casting(richly_lit(few(40, 27, 3, 3)), {0.0f, 0.3f, 0.0f})},
          {"all_4", casting(richly_lit(with_samples(few(40, 27, 4, 2), 4)), {0.03f, 0.0f, 0.0f})},
          {"all_16", casting(richly_lit(with_samples(crowd(40, 24, 3, 3), 16)), {0.0f, 0.0f, 0.0f})},
          {"large_16", casting(richly_lit(with_samples(few(32, 20, 2, 2), 16)), {0.1f, -1.0f, 0.2f})},
          {"flight", casting(with_samples(flight(40, 24, 3), 4), {0.0f, 0.0f})},
          {"ties", casting(with_samples(ties(32, 24), 4), {0.0f, 0.2f})},
          {"one_column", casting(with_samples(few(1, 43, 2, 2), 2), {0.0f, 0.2f})},
          {"cut", cut()},
          {"overhead", casting(overhead(128, 96, 6, 3), {0.0f})},
          {"overhead_4", casting(with_samples(overhead(128, 96, 4, 4), 4), {-1.0f, 0.0f})},
          {"overhead_large", casting(richly_lit(with_samples(overhead(96, 72, 3, 3), 4)), {0.04f, 0.0f})},
          {"corner", casting(with_samples(corner(160, 120, 4), 4), {0.0f})},
          {"nothing", casting(nothing(16, 12, 2), {})}};
}

class ShadowsIdentity : public testing::TestWithParam<Case> {
 protected:
  const wire::FilmData& film() const { return GetParam().film; }
  const wire::FilmSettings& settings() const { return film().settings; }
  bool is(const char* name) const { return std::string(name) == GetParam().name; }

  FilmRun draw(const RunOptions& options) const { return run_film(FilmBlock(film()).bytes(), options); }
  const FilmRun& drawn_from_scratch() const {
    static std::map<std::string, FilmRun> drawn;
    FilmRun& run = drawn[GetParam().name];
    if (!run.frames.empty()) return run;
    RunOptions options;
    options.work.coherence = false;
    options.simd = "sse2";
    return run = draw(options);
  }
  FilmRun expect_as_from_scratch(const RunOptions& options, const std::string& how) const {
    FilmRun run = draw(options);
    EXPECT_EQ(run.frames.size(), settings().frames);
    expect_same(run, drawn_from_scratch(), settings(), std::string("shadows-") + GetParam().name + "-" + how);
    return run;
  }
};

TEST_P(ShadowsIdentity, ShadowsOfWhatIsNotInThePictureRunOverIt) {
  if (!is("overhead") && !is("overhead_4") && !is("overhead_large")) return;
  const Pixels& first = drawn_from_scratch().frames.at(0);
  const Pixels& last = drawn_from_scratch().frames.at(settings().frames - 1);
  std::size_t changed = 0;
  for (std::size_t k = 0; k < first.size(); ++k) changed += first[k] != last[k] ? 1 : 0;
  EXPECT_GT(changed, first.size() / 100);
  EXPECT_LT(changed, first.size() / 4);
}

TEST_P(ShadowsIdentity, AnyNumberOfNodes) {
  for (const int nodes : {1, 2, 3}) {
    RunOptions options;
    options.nodes = nodes;
    expect_as_from_scratch(options, std::to_string(nodes) + "-nodes");
  }
}

TEST_P(ShadowsIdentity, SharedInbetweensAndCutIntervals) {
  for (const auto& [nodes, groups, sharers, most] : {std::tuple{3, 1u, 3, 0u}, {5, 2u, 2, 0u}, {4, 2u, 2, 2u}}) {
    RunOptions options;
    options.nodes = nodes;
    options.work.groups = groups;
    options.work.sharers = sharers;
    options.work.most_frames = most;
    expect_as_from_scratch(options, std::to_string(nodes) + "-nodes-sharers-" + std::to_string(sharers));
  }
}

TEST_P(ShadowsIdentity, AnyGroupsContributorsAndMachines) {
  for (const auto& [nodes, groups, contributors, nodes_each] :
       {std::tuple{4, 2u, 0, 4}, {2, 1u, 1, 2}, {3, 1u, 2, 1}, {5, 2u, 2, 2}}) {
    messages::Machines machines(nodes_each);
    messages::Counts counts;
    RunOptions options;
    options.nodes = nodes;
    options.work.groups = groups;
    options.work.contributors = contributors;
    options.wrap = [&](messages::Backend& inner) {
      return std::make_unique<messages::MachinesBackend>(inner, counts, machines);
    };
    expect_as_from_scratch(options, std::to_string(nodes) + "-nodes-" + std::to_string(groups) + "-groups");
  }
}

TEST_P(ShadowsIdentity, AnyInstructionSet) {
  for (const simd::InstructionSet set : simd::all_sets()) {
    RunOptions options;
    options.simd = simd::name_of(set);
    expect_as_from_scratch(options, simd::name_of(set));
  }
}

TEST_P(ShadowsIdentity, WithoutCoherenceOnManyNodes) {
  RunOptions options;
  options.nodes = 3;
  options.work.coherence = false;
  options.work.groups = 1;
  expect_as_from_scratch(options, "scratch-3-nodes");
}

TEST_P(ShadowsIdentity, InSeveralPassesWhenMemoryIsShort) {
  for (const int nodes : {1, 3}) {
    RunOptions options;
    options.nodes = nodes;
    const std::uint64_t others = 150'000 + 200 * settings().height + 20'000 * (settings().samples - 1);
    const auto needs = shadow::shadow_needs(FilmBlock(film()).view());
    options.farm.asked_memory = {others / 4, 0};  // as little as possible for shadows
    options.memory = shadow::least_shadow_bytes(needs) + others;
    const FilmRun run = expect_as_from_scratch(options, "passes");
    std::uint32_t passes_of_inbetweens = 1;
    for (const wire::Strip& strip : run.report.strips)
      if (strip.kind == wire::FrameKind::inbetween)
        passes_of_inbetweens = std::max(passes_of_inbetweens, strip.work.passes);
    if (is("directional") || is("all_16")) {
      EXPECT_GT(passes_of_inbetweens, 1u);
    }
  }
}

TEST_P(ShadowsIdentity, WithLittleMemoryForStationaryParts) {
  const auto casts = static_cast<std::uint32_t>(std::ranges::count(film().lights, 1u, &wire::Light::casts));
  const std::uint64_t a_line =
      wire::plan_still_lines(settings().width, 1, settings().samples, std::uint64_t{1} << 40, casts).line_bytes;
  for (const std::uint64_t lines : {settings().height / 3, 0u}) {
    RunOptions options;
    options.farm.asked_memory.still = lines * a_line;
    const FilmRun run = expect_as_from_scratch(options, "still-memory-of-" + std::to_string(lines));
    if (is("directional") || is("all_4") || is("all_16")) {
      EXPECT_GT(edge_boxes_of_inbetweens(run), edge_boxes_of_inbetweens(draw({}))) << "lines are drawn again";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Films, ShadowsIdentity, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace mars::test
