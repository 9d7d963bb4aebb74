// Edge boxes: a triangle's crossings of scanlines. Whether a sample lies in a triangle is decided in exact
// integers, half-open on the left and top, so neighbours neither share a sample nor leave one out. EBC counts
// the boxes of every line; its prefix sum is the offset table by which they are put into one array.
#pragma once

#include <cstdint>
#include <span>

#include "node/mapping.h"
#include "node/triangle.h"

namespace mars::node {

// The samples of one triangle, row by row.
class Crossings {
 public:
  Crossings(const Triangle& triangle, std::int32_t width, std::int32_t height);

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
  static Side side(const Triangle& triangle, int from, int to);
  static std::int32_t first_sample(const Side& side, double y);

  Side long_;
  Side upper_;
  Side lower_;
  std::int32_t middle_;  // y of the middle vertex
  std::int32_t width_;
};

// Adds the boxes of `triangle` to counts[row]; how many there were.
std::uint32_t count_edge_boxes(const Crossings& crossings, std::span<std::uint32_t> counts);

// Whether any box lies on lines for which `wanted(row)`.
template <typename Wanted>
bool has_edge_box(const Crossings& crossings, const Wanted& wanted) {
  for (std::int32_t row = crossings.first_row; row < crossings.last_row; ++row) {
    if (!wanted(row)) continue;
    const auto columns = crossings.columns(row);
    if (columns.first < columns.last) return true;
  }
  return false;
}

// Puts the boxes of triangles[number] on lines [lines.first, lines.last) at boxes[cursor[row - lines.first]++].
void place_edge_boxes(const Triangle& triangle, std::uint32_t number, std::int32_t width, const LineRange& lines,
                      std::span<std::uint64_t> cursor, std::span<EdgeBox> boxes);

}  // namespace mars::node
