#include "node/raster/outline.h"

#include <algorithm>
#include <utility>

namespace mars::raster {
namespace {

std::int32_t ceiling(double value) {
  const auto whole = static_cast<std::int32_t>(value);
  return static_cast<double>(whole) < value ? whole + 1 : whole;
}

}  // namespace

ColumnBounds column_bounds(std::int32_t left, std::int32_t right, const shape::SamplePattern& pattern) {
  const auto [least, most] = std::minmax_element(pattern.x, pattern.x + pattern.count);
  return {(left - *most + 255) >> 8, (right - *least + 255) >> 8};
}

Outline::Side Outline::side(const Corners& t, int from, int to) {
  return {static_cast<double>(t.y[from]), static_cast<double>(t.x[from]), static_cast<double>(t.x[to] - t.x[from]),
          static_cast<double>(t.y[to] - t.y[from])};
}

// The numerator is below 2^50 and exact; the quotient, if no whole number, is at least 1 / (256 dy) > 2^-33
// away from one while a double errs by less than 2^-36 of a pixel here, so the ceiling is exact.
std::int32_t Outline::first_column(const Side& s, double x, double y) {
  return ceiling(((y - s.y0) * s.dx + (s.x0 - x) * s.dy) / (shape::kSubpixels * s.dy));
}

Outline::Outline(const Corners& t, std::int32_t width, std::int32_t height, const shape::SamplePattern& pattern)
    : pattern_(pattern), width_(width) {
  int top = 0, middle = 1, bottom = 2;
  if (t.y[middle] < t.y[top]) std::swap(top, middle);
  if (t.y[bottom] < t.y[middle]) std::swap(middle, bottom);
  if (t.y[middle] < t.y[top]) std::swap(top, middle);
  first_row = std::max(row_at_or_after(t.y[top], pattern), 0);
  last_row = std::min(row_at_or_after(t.y[bottom], pattern), height * pattern.count);
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const ColumnBounds bounds = column_bounds(left, right, pattern);
  if (bounds.first >= std::min(bounds.last, width) || bounds.last <= 0) last_row = first_row;
  if (first_row >= last_row) return;
  middle_ = t.y[middle];
  long_ = side(t, top, bottom);
  upper_ = side(t, top, middle);
  lower_ = side(t, middle, bottom);
}

Outline::Columns Outline::columns(std::int32_t row) const {
  const std::int32_t sample = row & (pattern_.count - 1);
  const std::int32_t y = (row >> pattern_.log2_count) * shape::kSubpixels + pattern_.y[sample];
  const std::int32_t x = pattern_.x[sample];
  const std::int32_t a = first_column(long_, x, y);
  const std::int32_t b = first_column(y < middle_ ? upper_ : lower_, x, y);
  return {std::max(std::min(a, b), 0), std::min(std::max(a, b), width_)};
}

}  // namespace mars::raster
