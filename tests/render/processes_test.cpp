// Films on processes that share memory without MPI: the same pictures as on threads, and triangles are read in place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "hal/processes/run_processes.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

// What nodes send each other for a frame is its sums: a number a line, and two, at most twice for each of log2 P steps.
bool only_sums(const wire::Strip& strip, const wire::FilmSettings& settings) {
  return strip.work.bytes_to_nodes <= 2 * 3 * (settings.height + 2) * sizeof(std::uint64_t);
}

struct Case {
  std::uint64_t memory;
  std::uint32_t samples;
  wire::PixelFormat format = wire::PixelFormat::rgb8;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.memory << " bytes, " << c.samples << " samples, format " << static_cast<int>(c.format);
}

class OnProcesses : public testing::TestWithParam<Case> {};

TEST_P(OnProcesses, PicturesAreTheSame) {
  const wire::FilmData data = with_samples(crowd(160, 120, 12, 4), GetParam().samples);
  const FilmBlock film(data);
  RunOptions options;
  options.memory = GetParam().memory;
  options.format = GetParam().format;
  const FilmRun expected = run_film(film.bytes(), options);
  ASSERT_EQ(expected.frames.size(), 12u);
  for (const int nodes : {1, 2, 5}) {
    options.nodes = nodes;
    const auto host = [&] {
      const FilmRun run = render_as_host(film.bytes(), options);
      const bool divided = std::ranges::all_of(run.report.strips, [&](const wire::Strip& strip) {
        return strip.work.passes > 1 || only_sums(strip, data.settings);
      });
      return run.frames == expected.frames && divided ? 0 : 1;
    };
    const auto node = [&] {
      run_as_node(options);
      return 0;
    };
    EXPECT_EQ(processes::run_processes(nodes, host, node), 0) << nodes << " nodes";
  }
}

// The second is so little that keyframes take several passes.
INSTANTIATE_TEST_SUITE_P(Memory, OnProcesses,
                         testing::Values(Case{64 << 20, 1}, Case{200'000, 1}, Case{64 << 20, 4},
                                         Case{64 << 20, 4, wire::PixelFormat::rgb16},
                                         Case{64 << 20, 4, wire::PixelFormat::half}));

}  // namespace
}  // namespace mars::test
