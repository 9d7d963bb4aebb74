// The samples that a triangle covers, row by row. Decided in exact integers, half-open on the left and top, so
// neighbours neither share a sample nor leave one out.
#pragma once

#include <cstdint>

#include "node/shape/vertices.h"

namespace mars::raster {

// Screen places of a triangle's vertices.
struct Corners {
  std::int32_t x[3];
  std::int32_t y[3];
};

class Outline {
 public:
  Outline(const Corners& triangle, std::int32_t width, std::int32_t height);

  // Rows [first_row, last_row) may hold samples of the picture.
  std::int32_t first_row;
  std::int32_t last_row;

  struct Columns {
    std::int32_t first;
    std::int32_t last;  // one past; no sample where last <= first
  };
  Columns columns(std::int32_t row) const;

 private:
  // x of the crossing is ((y - y0) * dx + x0 * dy) / dy, all in 1/256 pixel relative to sample places.
  struct Side {
    double y0, x0, dx, dy;
  };
  static Side side(const Corners& triangle, int from, int to);
  static std::int32_t first_sample(const Side& side, double y);

  Side long_;
  Side upper_;
  Side lower_;
  std::int32_t middle_;  // y of the middle vertex
  std::int32_t width_;
};

// First row or column whose sample lies at or after `place`.
constexpr std::int32_t sample_at_or_after(std::int32_t place) { return (place + shape::kSampleOffset - 1) >> 8; }

}  // namespace mars::raster
