// The samples that a triangle covers, row by row (SamplePattern). Decided in exact integers, half-open on the left and
// top, so neighbours neither share a sample nor leave one out.
#pragma once

#include <cstdint>

#include "node/shape/sample_pattern.h"
#include "node/shape/vertices.h"

namespace mars::raster {

// Screen places of a triangle's vertices.
struct Corners {
  std::int32_t x[3];
  std::int32_t y[3];
};

class Outline {
 public:
  // In a picture of width x height pixels. `pattern` outlives it.
  Outline(const Corners& triangle, std::int32_t width, std::int32_t height, const shape::SamplePattern& pattern);
  Outline(auto&&, auto&&, auto&&, const shape::SamplePattern&&) = delete;

  // Rows [first_row, last_row) may hold samples of the picture.
  std::int32_t first_row;
  std::int32_t last_row;

  struct Columns {
    std::int32_t first;
    std::int32_t last;  // one past; no sample where last <= first
  };
  Columns columns(std::int32_t row) const;

 private:
  // x of the crossing is ((y - y0) * dx + x0 * dy) / dy, all in 1/256 pixel.
  struct Side {
    double y0, x0, dx, dy;
  };
  static Side side(const Corners& triangle, int from, int to);
  // The first column whose sample, at `x` within its pixel, is at or after the crossing.
  static std::int32_t first_column(const Side& side, double x, double y);

  const shape::SamplePattern& pattern_;
  Side long_;
  Side upper_;
  Side lower_;
  std::int32_t middle_;  // y of the middle vertex
  std::int32_t width_;
};

// First row whose samples lie at or after y, 1/256 pixel; |y| < 2^26.
constexpr std::int32_t row_at_or_after(std::int32_t y, const shape::SamplePattern& pattern) {
  return (y * pattern.count + shape::kSubpixels / 2 - 1) >> 8;
}

// Columns [first, last) hold all samples from `left` to `right`, 1/256 pixel, on any row; with one sample a pixel no
// others.
struct ColumnBounds {
  std::int32_t first;
  std::int32_t last;
};
ColumnBounds column_bounds(std::int32_t left, std::int32_t right, const shape::SamplePattern& pattern);

}  // namespace mars::raster
