// Which samples a triangle covers: Outline against a plain test with edge functions in 64-bit integers, and
// meshes that must cover every sample once.
#include "node/raster/outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/node/raster/plain_set_up.h"
#include "tests/node/shape/patches.h"
#include "tests/node/shape/sample_counts.h"

namespace mars::raster {
namespace {

struct Point {
  std::int32_t x, y;  // 1/256 pixel
};

Corners triangle(const Point& a, const Point& b, const Point& c) { return {{a.x, b.x, c.x}, {a.y, b.y, c.y}}; }

// How often each sample of a picture is covered, row by row of the pattern.
class Coverage {
 public:
  Coverage(std::int32_t width, std::int32_t height, std::uint32_t samples)
      : pattern(shape::sample_pattern(samples)), width(width), rows(height * pattern.count), count(size()) {}

  void add(const Corners& t) {
    const Outline outline(t, width, rows / pattern.count, pattern);
    EXPECT_GE(outline.first_row, 0);
    EXPECT_LE(outline.last_row, std::max(rows, outline.first_row));
    for (std::int32_t row = outline.first_row; row < outline.last_row; ++row) {
      const auto columns = outline.columns(row);
      for (std::int32_t column = columns.first; column < columns.last; ++column)
        ++count.at(static_cast<std::size_t>(row * width + column));
    }
  }
  void add_plainly(const Corners& t) {
    for (std::size_t k = 0; k < size(); ++k)
      count[k] += covers(t, static_cast<std::int32_t>(k) % width, static_cast<std::int32_t>(k) / width, pattern);
  }
  std::size_t size() const { return static_cast<std::size_t>(width * rows); }

  const shape::SamplePattern& pattern;
  std::int32_t width, rows;
  std::vector<int> count;
};

// Each kind's corners fall where coverage is hard to decide.
Point random_point(shape::Random& random, int kind) {
  const auto beside = [&](std::int32_t most) { return random.whole(-most, 24 * 256 + most); };
  switch (kind) {
    case 0: return {beside(600), beside(600)};
    case 1: return {random.whole(2560, 3100), random.whole(2560, 3100)};                  // about two pixels
    case 2: return {256 * random.whole(-3, 27) + 128, 256 * random.whole(-3, 27) + 128};  // on samples
    case 3: return {128 * random.whole(-6, 54), 128 * random.whole(-6, 54)};
    case 4: return {random.whole(-8400000, 8400000), random.whole(-8400000, 8400000)};  // all the guard band
    default: return {random.whole(0, 1) ? 8400000 : -8400000, beside(5000)};
  }
}

Corners random_triangle(shape::Random& random) {
  const int kind = random.whole(0, 5);
  Point p[3];
  for (Point& corner : p) corner = random_point(random, kind);
  switch (random.whole(0, 6)) {
    case 0: p[1].y = p[0].y; break;                                                      // a horizontal edge
    case 1: p[1].x = p[0].x; break;                                                      // a vertical one
    case 2: p[2] = {p[0].x + random.whole(-2, 2), p[0].y + random.whole(-2, 2)}; break;  // a sliver
    case 3: p[2] = {p[0].x / 2 + p[1].x / 2 + random.whole(-1, 1), p[0].y / 2 + p[1].y / 2}; break;
    default: break;
  }
  return triangle(p[0], p[1], p[2]);
}

TEST(Outline, ColumnsAreThoseOfAPlainTest) {
  shape::Random random(5);
  int covered = 0;
  for (std::size_t trial = 0; trial < 6000; ++trial) {
    const Corners t = random_triangle(random);
    const std::uint32_t samples = shape::kSampleCounts[trial % 5];
    Coverage fast(24, 24, samples), plain(24, 24, samples);
    fast.add(t);
    plain.add_plainly(t);
    ASSERT_EQ(fast.count, plain.count) << "trial " << trial << ": " << t.x[0] << ',' << t.y[0] << ' ' << t.x[1] << ','
                                       << t.y[1] << ' ' << t.x[2] << ',' << t.y[2];
    covered += std::count(fast.count.begin(), fast.count.end(), 1) > 0;
  }
  EXPECT_GT(covered, 1500);
}

// Where numbers are largest: pictures as long as they may be, corners beyond the guard band.
TEST(Outline, LongPictures) {
  shape::Random random(6);
  for (std::size_t trial = 0; trial < 60; ++trial) {
    const std::uint32_t samples = shape::kSampleCounts[trial % 5];
    Corners t{};
    for (int k = 0; k < 3; ++k) {
      t.x[k] = random.whole(-8400000, 12600000);
      t.y[k] = random.whole(-8400000, 12600000);
    }
    if (trial % 4 == 0) t.x[1] = t.x[0] + random.whole(-3, 3);
    Coverage wide(16384, 1, samples), wide_plain(16384, 1, samples);
    Coverage high(1, 16384, samples), high_plain(1, 16384, samples);
    wide.add(t);
    wide_plain.add_plainly(t);
    ASSERT_EQ(wide.count, wide_plain.count) << "trial " << trial;
    high.add(t);
    high_plain.add_plainly(t);
    ASSERT_EQ(high.count, high_plain.count) << "trial " << trial;
  }
}

TEST(Outline, FansCoverEverySampleOnce) {
  shape::Random random(7);
  for (std::size_t trial = 0; trial < 500; ++trial) {
    const Point middle = random_point(random, trial % 2 ? 2 : 3);
    const std::int32_t far = trial % 3 ? 10000 : 8400000;
    std::vector<Point> ring;  // once round the picture
    for (int k = -4; k < 4; ++k) ring.push_back({far * k / 4, -far});
    for (int k = -4; k < 4; ++k) ring.push_back({far, far * k / 4});
    for (int k = 4; k > -4; --k) ring.push_back({far * k / 4, far});
    for (int k = 4; k > -4; --k) ring.push_back({-far, far * k / 4});
    Coverage coverage(24, 24, shape::kSampleCounts[trial / 6 % 5]);
    for (std::size_t k = 0; k < ring.size(); ++k) coverage.add(triangle(middle, ring[k], ring[(k + 1) % ring.size()]));
    ASSERT_EQ(coverage.count, std::vector<int>(coverage.size(), 1)) << "trial " << trial;
  }
}

// Rows of strips with corners moved at random, often onto samples (but by less than a quarter of a cell, or
// quads would fold), drawn with either diagonal.
TEST(Outline, StripsCoverEverySampleOnce) {
  shape::Random random(8);
  constexpr int kCells = 10;
  for (std::size_t trial = 0; trial < 500; ++trial) {
    Point grid[kCells + 1][kCells + 1];
    const std::int32_t cell = trial % 2 ? 3 * 256 : 797;
    for (int j = 0; j <= kCells; ++j)
      for (int i = 0; i <= kCells; ++i) {
        Point& p = grid[j][i] = {cell * i - 400, cell * j - 400};
        if (random.whole(0, 2)) p = {p.x + random.whole(-60, 60), p.y + random.whole(-60, 60)};
        if (random.whole(0, 1)) p = {(p.x >> 8) * 256 + 128, (p.y >> 8) * 256 + 128};
      }
    Coverage coverage(24, 24, shape::kSampleCounts[trial / 2 % 5]);
    for (int j = 0; j < kCells; ++j)
      for (int i = 0; i < kCells; ++i) {
        const Point &a = grid[j][i], &b = grid[j][i + 1], &c = grid[j + 1][i + 1], &d = grid[j + 1][i];
        const bool turned = random.whole(0, 1) == 1;
        coverage.add(turned ? triangle(a, b, d) : triangle(a, b, c));
        coverage.add(turned ? triangle(d, b, c) : triangle(c, a, d));
      }
    ASSERT_EQ(coverage.count, std::vector<int>(coverage.size(), 1)) << "trial " << trial;
  }
}

}  // namespace
}  // namespace mars::raster
