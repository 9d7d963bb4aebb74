// Sample patterns: a column and a line of its own for each sample, and how well they measure edges.
#include "node/shape/sample_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace mars::shape {
namespace {

constexpr int kPixel = 256;  // the grid's steps

// Of a square of side 1 round 0 the part where (p, unit normal) <= offset. `major` >= `minor` >= 0: the normal's parts.
double area_within(double major, double minor, double offset) {
  const double corner = (major + minor) / 2, inner = (major - minor) / 2;
  if (std::abs(offset) <= inner) return 0.5 + offset / major;
  const double cut = std::max(corner - std::abs(offset), 0.0);
  const double rest = cut * cut / (2 * major * minor);
  return offset < 0 ? rest : 1 - rest;
}

struct EdgeError {
  double mean;  // root of the mean square
  double greatest;
};

// Over edges that cross a pixel, evenly by angle and offset.
EdgeError edge_error(const SamplePattern& pattern) {
  constexpr int kAngles = 360, kOffsets = 500;
  double squares = 0, greatest = 0;
  int edges = 0;
  for (int a = 0; a < kAngles; ++a) {
    const double angle = std::numbers::pi * (a + 0.5) / kAngles;
    const double x = std::cos(angle), y = std::sin(angle);
    const double major = std::max(std::abs(x), std::abs(y)), minor = std::min(std::abs(x), std::abs(y));
    for (int k = 0; k < kOffsets; ++k) {
      const double offset = (2 * (k + 0.5) / kOffsets - 1) * std::numbers::sqrt2 / 2;
      if (std::abs(offset) >= (major + minor) / 2) continue;
      int within = 0;
      for (int s = 0; s < pattern.count; ++s)
        within += x * (pattern.x[s] - kPixel / 2) + y * (pattern.y[s] - kPixel / 2) <= offset * kPixel ? 1 : 0;
      const double error = std::abs(static_cast<double>(within) / pattern.count - area_within(major, minor, offset));
      squares += error * error;
      greatest = std::max(greatest, error);
      ++edges;
    }
  }
  return {std::sqrt(squares / edges), greatest};
}

TEST(SamplePattern, EachSampleHasAColumnAndALineOfItsOwn) {
  for (const int samples : {1, 2, 4, 8, 16}) {
    const SamplePattern& pattern = sample_pattern(static_cast<std::uint32_t>(samples));
    ASSERT_EQ(pattern.count, samples);
    const int cell = kPixel / samples;
    std::set<int> columns;
    for (int s = 0; s < samples; ++s) {
      EXPECT_EQ(pattern.y[s], s * cell + cell / 2);
      EXPECT_EQ(pattern.x[s] % cell, cell / 2);
      columns.insert(pattern.x[s] / cell);
    }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(samples));
    EXPECT_EQ(*columns.rbegin(), samples - 1);
  }
}

// The bounds are what the best permutations reach; a diagonal of 16 samples has 0.105 and 0.49.
TEST(SamplePattern, EdgesAreMeasuredAsWellAsSoManySamplesCan) {
  const struct {
    std::uint32_t samples;
    double mean, greatest;
  } bounds[] = {{1, 0.247, 0.5}, {2, 0.161, 0.5}, {4, 0.0919, 0.31}, {8, 0.0561, 0.21}, {16, 0.032, 0.112}};
  for (const auto& bound : bounds) {
    const EdgeError error = edge_error(sample_pattern(bound.samples));
    EXPECT_LE(error.mean, bound.mean) << bound.samples;
    EXPECT_LE(error.greatest, bound.greatest) << bound.samples;
  }
}

}  // namespace
}  // namespace mars::shape
