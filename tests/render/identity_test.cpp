// Promise 1: a film's frames are the same bits however the work is divided, and the same as every frame drawn
// from scratch by one node.
#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

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
  wire::PixelFormat format = wire::PixelFormat::rgb8;
};

wire::FilmData agx(wire::FilmData film) {
  film.settings.curve = wire::Curve::agx;
  return film;
}

std::vector<Case> cases() {
  return {{"crowd", crowd(320, 180, 7, 7)},
          {"short-intervals", crowd(193, 127, 9, 2)},
          {"flight", flight(240, 135, 5)},
          {"ties", ties(160, 120)},
          {"one-pixel", crowd(1, 1, 3, 3)},
          {"one-line", crowd(301, 1, 3, 3)},
          {"one-column", crowd(1, 203, 3, 3)},
          {"one-frame", crowd(128, 96, 1, 1)},
          {"nothing", nothing(64, 48, 3)},
          {"samples-2", with_samples(crowd(97, 61, 4, 4), 2)},
          {"samples-4", richly_lit(with_samples(crowd(120, 68, 5, 5), 4))},
          {"samples-4-short-intervals", richly_lit(with_samples(crowd(120, 68, 5, 2), 4))},
          {"samples-16", richly_lit(with_samples(crowd(64, 40, 4, 4), 16))},
          {"flight-4", richly_lit(with_samples(flight(80, 45, 3), 4))},
          {"ties-8", with_samples(ties(60, 45), 8)},
          {"linear", richly_lit(crowd(120, 68, 3, 3))},
          {"one-pixel-16", richly_lit(with_samples(crowd(1, 1, 3, 3), 16))},
          {"one-column-4", with_samples(crowd(1, 53, 3, 3), 4)},
          {"nothing-4", with_samples(nothing(16, 12, 3), 4)},
          {"coded-rgb16", crowd(97, 61, 4, 4), wire::PixelFormat::rgb16},
          {"coded-half", crowd(97, 61, 4, 2), wire::PixelFormat::half},
          {"coded-rgb16-4", with_samples(crowd(97, 61, 4, 2), 4), wire::PixelFormat::rgb16},
          {"coded-half-4", with_samples(crowd(97, 61, 4, 4), 4), wire::PixelFormat::half},
          {"linear-rgb16", richly_lit(crowd(97, 61, 4, 4)), wire::PixelFormat::rgb16},
          {"linear-half", richly_lit(crowd(97, 61, 4, 2)), wire::PixelFormat::half},
          {"linear-rgb16-4", richly_lit(with_samples(crowd(97, 61, 4, 2), 4)), wire::PixelFormat::rgb16},
          {"rgba8", crowd(97, 61, 4, 2), wire::PixelFormat::rgba8},
          {"linear-rgba16-4", agx(richly_lit(with_samples(crowd(64, 40, 4, 2), 4))), wire::PixelFormat::rgba16},
          {"linear-half-alpha-4", richly_lit(with_samples(crowd(64, 40, 4, 4), 4)), wire::PixelFormat::half_alpha},
          {"linear-half-4", richly_lit(with_samples(crowd(97, 61, 4, 4), 4)), wire::PixelFormat::half}};
}

RunOptions from_scratch() {
  RunOptions options;
  options.work.coherence = false;
  options.simd = "sse2";
  return options;
}

class Identity : public testing::TestWithParam<Case> {
 protected:
  const wire::FilmSettings& settings() const { return GetParam().film.settings; }
  bool is_one_of(std::initializer_list<const char*> names) const {
    return std::ranges::any_of(names, [](const char* name) { return std::string(GetParam().name) == name; });
  }

  FilmRun draw(RunOptions options) const {
    options.format = GetParam().format;
    return run_film(FilmBlock(GetParam().film).bytes(), options);
  }
  const FilmRun& drawn_from_scratch() const {
    static std::map<std::string, FilmRun> drawn;
    FilmRun& run = drawn[GetParam().name];
    if (run.frames.empty()) run = draw(from_scratch());
    return run;
  }
  // The run with these options, whose frames are the same as from scratch.
  FilmRun expect_as_from_scratch(const RunOptions& options, const std::string& how) const {
    FilmRun run = draw(options);
    EXPECT_EQ(run.frames.size(), options.work.frames.empty() ? settings().frames : options.work.frames.size());
    expect_same(run, drawn_from_scratch(), settings(), std::string(GetParam().name) + "-" + how);
    return run;
  }
};

TEST_P(Identity, AnyNumberOfNodes) {
  for (const int nodes : {1, 2, 3, 5, 8}) {
    RunOptions options;
    options.nodes = nodes;
    expect_as_from_scratch(options, std::to_string(nodes) + "-nodes");
  }
}

TEST_P(Identity, AnyMappingAndGroups) {
  for (const auto& [groups, mapping] : {std::pair{1u, wire::Mapping::optimal},
                                        {1u, wire::Mapping::cost},
                                        {2u, wire::Mapping::greedy},
                                        {2u, wire::Mapping::cost},
                                        {5u, wire::Mapping::optimal}}) {
    RunOptions options;
    options.nodes = 5;
    options.work.groups = groups;
    options.farm.mapping = mapping;
    expect_as_from_scratch(options, std::to_string(groups) + "-groups-mapping-" + std::to_string(int(mapping)));
  }
}

TEST_P(Identity, AnyContributorsToKeyframes) {
  for (const auto& [groups, contributors] : {std::pair{1u, 1}, {1u, 3}, {2u, 2}}) {
    RunOptions options;
    options.nodes = 5;
    options.work.groups = groups;
    options.work.contributors = contributors;
    expect_as_from_scratch(options, std::to_string(groups) + "-groups-contributors-" + std::to_string(contributors));
  }
}

TEST_P(Identity, AnySharersOfInbetweens) {
  for (const auto& [nodes, groups, sharers] : {std::tuple{2, 1u, 2}, {5, 1u, 2}, {6, 2u, 3}, {7, 1u, 7}}) {
    RunOptions options;
    options.nodes = nodes;
    options.work.groups = groups;
    options.work.sharers = sharers;
    expect_as_from_scratch(options, std::to_string(nodes) + "-nodes-sharers-" + std::to_string(sharers));
  }
}

TEST_P(Identity, SharedInbetweensWhereMemoryIsShort) {
  for (const auto& [memory, still] : {std::pair{std::uint64_t{300'000} + 200 * settings().height, 0}, {256 << 20, 0}}) {
    RunOptions options;
    options.nodes = 3;
    options.work.sharers = 3;
    options.memory = memory;
    options.farm.asked_memory.still = still;
    expect_as_from_scratch(options, "sharers-short-memory");
  }
}

TEST_P(Identity, AnyCutsOfIntervals) {
  for (const auto& [groups, most, sharers] : {std::tuple{1u, 2u, 1}, {2u, 3u, 1}, {3u, 1u, 1}, {2u, 2u, 2}}) {
    RunOptions options;
    options.nodes = 5;
    options.work.groups = groups;
    options.work.most_frames = most;
    options.work.sharers = sharers;
    expect_as_from_scratch(options, std::to_string(groups) + "-groups-most-" + std::to_string(most));
  }
}

TEST_P(Identity, AnyMachines) {
  for (const auto& [nodes, nodes_each, groups] : {std::tuple{4, 1, 1u}, {5, 2, 1u}, {7, 3, 2u}}) {
    messages::Machines machines(nodes_each);
    messages::Counts counts;
    RunOptions options;
    options.nodes = nodes;
    options.work.groups = groups;
    options.work.contributors = nodes == 4 ? 0 : 2;
    options.wrap = [&](messages::Backend& inner) {
      return std::make_unique<messages::MachinesBackend>(inner, counts, machines);
    };
    expect_as_from_scratch(options, std::to_string(nodes_each) + "-a-machine");
  }
}

TEST_P(Identity, AnyBlockSize) {
  for (const std::uint32_t block : {1u, 7u, 64u, 5000u}) {
    RunOptions options;
    options.nodes = 3;
    options.block = block;
    expect_as_from_scratch(options, "block-" + std::to_string(block));
  }
}

TEST_P(Identity, AnyInstructionSet) {
  for (const simd::InstructionSet set : simd::all_sets()) {
    RunOptions options;
    options.nodes = 2;
    options.simd = simd::name_of(set);
    expect_as_from_scratch(options, simd::name_of(set));
  }
}

TEST_P(Identity, WithoutCoherenceOnManyNodes) {
  RunOptions options;
  options.nodes = 5;
  options.work.coherence = false;
  options.work.groups = 1;
  expect_as_from_scratch(options, "scratch-5-nodes");
}

std::uint64_t most_memory(const FilmRun& run) {
  std::uint64_t most = 0;
  for (const wire::Strip& strip : run.report.strips) most = std::max(most, strip.work.memory);
  return most;
}

TEST_P(Identity, InSeveralPassesWhenMemoryIsShort) {
  const std::uint64_t memory = 300'000 + 200 * settings().height;
  const bool is_short = most_memory(drawn_from_scratch()) > memory;
  EXPECT_TRUE(is_short || !is_one_of({"crowd", "flight", "samples-4", "samples-16", "linear-half-4"}));
  for (const int nodes : {1, 3}) {
    RunOptions options;
    options.nodes = nodes;
    options.memory = memory;
    options.farm.asked_memory.still = 0;
    const FilmRun run = expect_as_from_scratch(options, "passes");
    std::uint32_t passes = 1;
    for (const wire::Strip& strip : run.report.strips) {
      passes = std::max(passes, strip.work.passes);
      EXPECT_LE(strip.work.memory, memory / (nodes > 1 ? 2 : 1));
      // All triangles are made before a frame turns out to need several passes, as far as they fit.
      const std::uint64_t made = 64 * strip.work.triangles + 12 * strip.work.edge_boxes_diced;
      if (strip.work.passes > 1) {
        EXPECT_GE(strip.work.memory, std::min(made, memory / 2 - 50'000)) << "of all passes";
      }
    }
    if (is_short && nodes == 1) {
      EXPECT_GT(passes, 1u);
    }
  }
}

// Inbetweens draw stationary parts again on lines that are not kept.
TEST_P(Identity, WithLittleMemoryForStationaryParts) {
  // A line of which each sample may show another triangle.
  const std::uint64_t a_line =
      wire::plan_still_lines(settings().width, 1, settings().samples, std::uint64_t{1} << 40).line_bytes;
  for (const std::uint64_t nodes : {1u, 3u}) {
    const auto edge_boxes = [&](std::optional<std::uint64_t> still_memory, const std::string& how) {
      RunOptions options;
      options.nodes = static_cast<int>(nodes);
      options.farm.asked_memory.still = still_memory;
      return edge_boxes_of_inbetweens(expect_as_from_scratch(options, how));
    };
    const std::uint64_t kept = edge_boxes({}, "still-memory");
    const std::uint64_t some_kept = edge_boxes(a_line * (settings().height / 3) / nodes, "some-still-memory");
    const std::uint64_t none_kept = edge_boxes(0, "no-still-memory");
    if (is_one_of({"samples-2", "samples-4", "samples-4-short-intervals", "samples-16", "linear-rgb16-4"})) {
      EXPECT_LT(kept, some_kept);
      EXPECT_LT(some_kept, none_kept);
    }
    if (settings().samples == 1) {
      EXPECT_EQ(kept, none_kept) << "CZB comes on top";
    }
  }
}

TEST_P(Identity, OnlySomeFrames) {
  RunOptions options;
  options.nodes = 3;
  options.work.frames = {settings().frames - 1};
  if (settings().frames > 2) options.work.frames = {1, settings().frames - 1};
  expect_as_from_scratch(options, "some-frames");
}

INSTANTIATE_TEST_SUITE_P(Films, Identity, testing::ValuesIn(cases()), [](const auto& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// Of a triangle as tall as the picture, a pass has only some rows.
TEST(Memory, OfAPassHoldsWhatItsLinesNeed) {
  wire::FilmData data = crowd(1, 2000, 2, 2);
  data.settings.samples = 16;
  const FilmBlock block(data);
  RunOptions options;
  options.nodes = 2;
  const FilmRun whole = run_film(block.bytes(), options);
  options.memory = 700'000;
  const FilmRun in_passes = run_film(block.bytes(), options);
  EXPECT_GT(in_passes.report.strips.front().work.passes, 1u);
  expect_same(in_passes, whole, data.settings, "in passes");
}

// Memory so short that a single line does not fit is the user's fault, and is reported as such; no rank hangs.
TEST(Memory, TooShortForOneLineIsOneClearFailure) {
  const FilmBlock block(crowd(640, 360, 2, 2));
  RunOptions options;
  options.nodes = 3;
  options.memory = 60'000;
  try {
    run_film(block.bytes(), options);
    FAIL() << "rendered within 60 kB";
  } catch (const std::exception& failure) {
    EXPECT_NE(std::string(failure.what()).find("MARS_MEMORY"), std::string::npos) << failure.what();
    EXPECT_NE(std::string(failure.what()).find("node "), std::string::npos) << failure.what();
  }
}

}  // namespace
}  // namespace mars::test
