// What of a band of lines is seen of one kind, still or moving: where points of shadows lie, and what is known of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/line_range.h"
#include "node/wire/still_plan.h"

namespace mars::shadow {

// One line's samples. Nothing is seen on it where `depth` is nullptr.
struct LayerLine {
  const float* depth = nullptr;  // by column, row by row of the pattern, `stride` apart
  std::size_t stride = 0;
  // Of casting light l and column x at l * width + x.
  wire::StillPairs* pairs = nullptr;  // what matters, and what still casters block of it
  std::uint16_t* moved = nullptr;     // what moving casters block beside that
  bool is_changed = false;            // they block any
};

struct Layer {
  std::uint32_t width;
  geometry::LineRange range;
  std::vector<LayerLine> lines;
  std::vector<std::uint32_t> tiles;  // squares (pairs.h) with points that count, numbered over the picture row by row

  void begin(std::uint32_t picture_width, const geometry::LineRange& some) {
    width = picture_width;
    range = some;
    lines.assign(some.count(), {});
    tiles.clear();
  }
  LayerLine& line(std::uint32_t number) { return lines[number - range.first]; }
  const LayerLine& line(std::uint32_t number) const { return lines[number - range.first]; }
  std::uint32_t tiles_across() const;
  // All on which something is seen.
  void count_all_tiles();
};

enum class Casting { still, moving };

}  // namespace mars::shadow
