#include "node/edge_boxes.h"

#include <algorithm>
#include <utility>

namespace mars::node {
namespace {

// First row or column whose sample lies at or after `place`.
std::int32_t sample_at_or_after(std::int32_t place) { return (place + kSampleOffset - 1) >> 8; }

std::int32_t ceiling(double value) {
  const auto whole = static_cast<std::int32_t>(value);
  return static_cast<double>(whole) < value ? whole + 1 : whole;
}

}  // namespace

Crossings::Side Crossings::side(const Triangle& t, int from, int to) {
  return {static_cast<double>(t.y[from]), static_cast<double>(t.x[from] - kSampleOffset),
          static_cast<double>(t.x[to] - t.x[from]), static_cast<double>(t.y[to] - t.y[from])};
}

// The numerator is below 2^50 and exact; the quotient, if no whole number, is at least 1 / (256 dy) > 2^-33
// away from one while a double errs by less than 2^-36 of a pixel here, so the ceiling is exact.
std::int32_t Crossings::first_sample(const Side& s, double y) {
  return ceiling(((y - s.y0) * s.dx + s.x0 * s.dy) / (kSubpixels * s.dy));
}

Crossings::Crossings(const Triangle& t, std::int32_t width, std::int32_t height) : width_(width) {
  int top = 0, middle = 1, bottom = 2;
  if (t.y[middle] < t.y[top]) std::swap(top, middle);
  if (t.y[bottom] < t.y[middle]) std::swap(middle, bottom);
  if (t.y[middle] < t.y[top]) std::swap(top, middle);
  first_row = std::max(sample_at_or_after(t.y[top]), 0);
  last_row = std::min(sample_at_or_after(t.y[bottom]), height);
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  if (sample_at_or_after(left) >= std::min(sample_at_or_after(right), width) || sample_at_or_after(right) <= 0)
    last_row = first_row;
  if (first_row >= last_row) return;
  middle_ = t.y[middle];
  long_ = side(t, top, bottom);
  upper_ = side(t, top, middle);
  lower_ = side(t, middle, bottom);
}

Crossings::Columns Crossings::columns(std::int32_t row) const {
  const std::int32_t y = row * kSubpixels + kSampleOffset;
  const std::int32_t a = first_sample(long_, y);
  const std::int32_t b = first_sample(y < middle_ ? upper_ : lower_, y);
  return {std::max(std::min(a, b), 0), std::min(std::max(a, b), width_)};
}

std::uint32_t count_edge_boxes(const Crossings& crossings, std::span<std::uint32_t> counts) {
  std::uint32_t boxes = 0;
  for (std::int32_t row = crossings.first_row; row < crossings.last_row; ++row) {
    const auto columns = crossings.columns(row);
    if (columns.first >= columns.last) continue;
    ++counts[static_cast<std::size_t>(row)];
    ++boxes;
  }
  return boxes;
}

void place_edge_boxes(const Triangle& triangle, std::uint32_t number, std::int32_t width, const LineRange& lines,
                      std::span<std::uint64_t> cursor, std::span<EdgeBox> boxes) {
  const Crossings crossings(triangle, width, static_cast<std::int32_t>(lines.last));
  const auto first = static_cast<std::int32_t>(lines.first);
  for (std::int32_t row = std::max(crossings.first_row, first); row < crossings.last_row; ++row) {
    const auto columns = crossings.columns(row);
    if (columns.first >= columns.last) continue;
    const auto dy = static_cast<float>(row * kSubpixels + kSampleOffset - triangle.y[0]);
    boxes[cursor[static_cast<std::size_t>(row - first)]++] = {
        number, static_cast<std::uint16_t>(columns.first), static_cast<std::uint16_t>(columns.last), triangle.x[0],
        triangle.depth.at_first + dy * triangle.depth.per_y, triangle.depth.per_x};
  }
}

}  // namespace mars::node
