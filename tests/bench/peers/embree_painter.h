// How Embree's rays become the pixels of a tile: one ray a pixel, or several.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "node/shape/sample_pattern.h"
#include "tests/bench/peers/embree_view.h"

namespace mars::bench {

inline constexpr int kTile = 16;  // pixels; a multiple of a packet's sides

struct Canvas {
  const Mesh& mesh;
  View standing, mover;
  std::optional<float> sun;          // its size (embree_sun.h); none: no shadows
  std::vector<std::uint32_t> frame;  // row by row
};

// Which views rays into a tile may meet.
struct Here {
  bool standing, mover;
};

// What may differ from what stands.
struct Changes {
  bool mover, shadow;
};

// Several threads may draw at a time, each a tile of its own.
class Painter {
 public:
  virtual ~Painter() = default;

  // All pixels of a tile.
  virtual void draw(const Area& tile, Here here) = 0;
  // What stands, and keeps of it what draw_mover() needs.
  virtual void keep(const Area& tile, bool standing_here) = 0;
  // What moves and its shadow, over a tile that shows what stands.
  virtual void draw_changes(const Area& tile, Changes here) = 0;
  // Whether shadow rays are traced; for measuring what they cost.
  virtual void set_tracing(bool traces) = 0;
};

// `keeps`: whether keep() will be asked for.
std::unique_ptr<Painter> make_pixel_painter(Canvas& canvas, bool keeps);
std::unique_ptr<Painter> make_sample_painter(Canvas& canvas, bool keeps, const shape::SamplePattern& pattern);

// Red in the lowest byte; levels of 0..1.
std::uint32_t pixel_of(const std::array<float, 3>& levels);

}  // namespace mars::bench
