// Which columns of which lines of a picture moving parts, or their shadows, may change in an interval's inbetweens: one
// bit for each tile of kStillTile x kStillTile pixels. What stands still is kept for inbetweens there alone.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/line_range.h"
#include "node/wire/still_plan.h"

namespace mars::raster {

// Of one line: the tiles from left to right, the first in the lowest bit of the first word. Bits beyond the picture are
// 0.
using MarkedTiles = std::span<const std::uint64_t>;

constexpr bool has_tile(MarkedTiles tiles, std::uint32_t tile) { return (tiles[tile / 64] >> tile % 64 & 1) != 0; }
constexpr bool has_column(MarkedTiles tiles, std::uint32_t column) {
  return has_tile(tiles, column / wire::kStillTile);
}
bool any(MarkedTiles tiles);
// Of a line of `width` columns, how many are in marked tiles.
std::uint32_t count_columns(MarkedTiles tiles, std::uint32_t width);

// Calls visit(first, last) for the columns of neighbouring marked tiles, from left to right.
template <typename Visit>
void visit_columns(MarkedTiles tiles, std::uint32_t width, const Visit& visit) {
  const std::uint32_t count = wire::still_tiles(width);
  for (std::uint32_t first = 0, last; first < count; first = last) {
    const std::uint64_t rest = tiles[first / 64] >> first % 64;
    if (rest == 0) {
      last = (first / 64 + 1) * 64;
      continue;
    }
    first += static_cast<std::uint32_t>(std::countr_zero(rest));
    for (last = first + 1; last < count && has_tile(tiles, last);) ++last;
    visit(first * wire::kStillTile, std::min(last * wire::kStillTile, width));
  }
}

// And for those between, and at the ends.
template <typename Visit>
void visit_other_columns(MarkedTiles tiles, std::uint32_t width, const Visit& visit) {
  std::uint32_t done = 0;
  visit_columns(tiles, width, [&](std::uint32_t first, std::uint32_t last) {
    if (done < first) visit(done, first);
    done = last;
  });
  if (done < width) visit(done, width);
}

class StillMarks {
 public:
  // None.
  StillMarks(std::uint32_t width, std::uint32_t height);

  void clear();
  void mark_all();
  // Tiles are numbered over the picture row by row.
  void mark_tile(std::uint32_t tile) { mark(tile / across_, tile % across_, tile % across_ + 1); }
  bool has(std::uint32_t tile) const { return has_tile(row(tile / across_), tile % across_); }
  // Of tiles with a pixel on both the lines and the columns.
  void mark(const geometry::LineRange& lines, const geometry::ColumnRange& columns);

  MarkedTiles on(std::uint32_t line) const { return row(line / wire::kStillTile); }

 private:
  MarkedTiles row(std::uint32_t number) const { return std::span(bits_).subspan(number * words_, words_); }
  void mark(std::uint32_t row, std::uint32_t first, std::uint32_t last);

  std::uint32_t across_;
  std::uint32_t rows_;
  std::size_t words_;  // of a row
  std::vector<std::uint64_t> bits_;
};

}  // namespace mars::raster
