// Stretches of a picture's scanlines and columns.
#pragma once

#include <algorithm>
#include <cstdint>

namespace mars::geometry {

// Lines [first, last); may be empty.
struct LineRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;

  std::uint32_t count() const { return last - first; }
  bool has(std::uint32_t line) const { return first <= line && line < last; }
  bool operator==(const LineRange&) const = default;
};

// Columns [first, last) of a line.
struct ColumnRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

// A rectangle of a picture.
struct PictureBounds {
  LineRange lines;
  ColumnRange columns;
};

inline LineRange overlap(const LineRange& a, const LineRange& b) {
  const std::uint32_t first = std::max(a.first, b.first), last = std::min(a.last, b.last);
  return {first, std::max(first, last)};
}

}  // namespace mars::geometry
