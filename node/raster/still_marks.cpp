#include "node/raster/still_marks.h"

namespace mars::raster {

bool any(MarkedTiles tiles) {
  return std::ranges::any_of(tiles, [](std::uint64_t word) { return word != 0; });
}

std::uint32_t count_columns(MarkedTiles tiles, std::uint32_t width) {
  std::uint32_t count = 0;
  visit_columns(tiles, width, [&](std::uint32_t first, std::uint32_t last) { count += last - first; });
  return count;
}

StillMarks::StillMarks(std::uint32_t width, std::uint32_t height)
    : across_(wire::still_tiles(width)),
      rows_(wire::still_tiles(height)),
      words_(wire::still_tile_words(width)),
      bits_(rows_ * words_) {}

void StillMarks::clear() { std::ranges::fill(bits_, std::uint64_t{0}); }

void StillMarks::mark_all() {
  for (std::uint32_t row = 0; row < rows_; ++row) mark(row, 0, across_);
}

void StillMarks::mark(const geometry::LineRange& lines, const geometry::ColumnRange& columns) {
  if (lines.first >= lines.last || columns.first >= columns.last) return;
  for (std::uint32_t row = lines.first / wire::kStillTile; row <= (lines.last - 1) / wire::kStillTile; ++row)
    mark(row, columns.first / wire::kStillTile, (columns.last - 1) / wire::kStillTile + 1);
}

void StillMarks::mark(std::uint32_t row, std::uint32_t first, std::uint32_t last) {
  std::uint64_t* const words = bits_.data() + row * words_;
  for (std::uint32_t tile = first; tile < last;) {
    const std::uint32_t end = std::min(last, (tile / 64 + 1) * 64);
    words[tile / 64] |= ~std::uint64_t{0} >> (64 - (end - tile)) << tile % 64;
    tile = end;
  }
}

}  // namespace mars::raster
