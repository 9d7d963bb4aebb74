#include "node/shape/sample_pattern.h"

#include <algorithm>
#include <bit>

#include "hal/failure/failure.h"

namespace mars::shape {
namespace {

// `columns`: of each sample, of as many columns as there are samples; any two of a permutation differ.
template <int kCount>
constexpr SamplePattern pattern_of(const int (&columns)[kCount]) {
  SamplePattern pattern{kCount, std::countr_zero(static_cast<unsigned>(kCount)), {}, {}, {}};
  for (int s = 0; s < kCount; ++s) {
    pattern.x[s] = (2 * columns[s] + 1) * 128 / kCount;
    pattern.y[s] = (2 * s + 1) * 128 / kCount;
    pattern.by_distance[s] = static_cast<std::uint8_t>(s);
  }
  const auto distance = [&](std::uint8_t s) {
    const int x = pattern.x[s] - 128, y = pattern.y[s] - 128;
    return x * x + y * y;
  };
  std::sort(pattern.by_distance, pattern.by_distance + kCount, [&](std::uint8_t a, std::uint8_t b) {
    return distance(a) != distance(b) ? distance(a) < distance(b) : a < b;
  });
  return pattern;
}

// Chosen by how well they measure the part of a pixel on one side of a straight edge. The error is that of the share of
// samples there against the area, as root of the mean square over all edges that cross a pixel (uniform in angle and
// offset). Of the permutations within 1 % of the least such error, each pattern is the one whose greatest error is
// least: 0.50, 0.50, 0.31, 0.21 and 0.11; mean 0.25, 0.16, 0.092, 0.056 and 0.032. All permutations of 2, 4 and 8 were
// compared, and of 16 the minima of 5000 descents by exchanges.
constexpr SamplePattern kOne = pattern_of({0});
constexpr SamplePattern kTwo = pattern_of({0, 1});
constexpr SamplePattern kFour = pattern_of({1, 3, 0, 2});
constexpr SamplePattern kEight = pattern_of({3, 6, 0, 4, 2, 7, 5, 1});
constexpr SamplePattern kSixteen = pattern_of({4, 12, 8, 1, 15, 6, 10, 2, 13, 5, 9, 0, 14, 7, 3, 11});

}  // namespace

const SamplePattern& sample_pattern(std::uint32_t samples) {
  switch (samples) {
    case 1: return kOne;
    case 2: return kTwo;
    case 4: return kFour;
    case 8: return kEight;
    default: check(samples == kMostSamples, "a pixel has 1, 2, 4, 8 or 16 samples"); return kSixteen;
  }
}

}  // namespace mars::shape
