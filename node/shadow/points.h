// Points of a band on the grid of one view, and which of them a caster may block.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "node/shadow/band.h"
#include "node/shadow/kernels.h"
#include "node/shadow/pairs.h"
#include "node/shape/sample_pattern.h"

namespace mars::shadow {

// Round nothing, round all, and round both.
extern const GridBox kNowhere, kEverywhere;
GridBox around(const GridBox& a, const GridBox& b);

// Boxes, boxes round sixteen of them each, and so on up to sixteen.
class BoxTree {
 public:
  void clear();
  void add(const GridBox& box);
  void finish();  // before it is asked
  std::uint32_t count() const { return count_; }
  std::size_t bytes() const;  // of memory, that it has

  // Whether a caster within `box` may block points of any box, by `spread` (kernels.h).
  bool any(const ShadowKernels& kernels, const GridBox& box, float spread);
  // Numbers of the boxes whose points it may block, in `found`, which grows where it is too short.
  std::span<const std::uint32_t> find(const ShadowKernels& kernels, const GridBox& box, float spread,
                                      std::vector<std::uint32_t>& found);

 private:
  // Boxes of one level, and the one round the last of them, which have none yet.
  struct Level {
    std::vector<float> low_x, high_x, low_y, high_y, low_z;
    GridBox last;

    void clear();
    void add(const GridBox& box);
    void fill_last();
    std::uint32_t size() const { return static_cast<std::uint32_t>(low_z.size()); }
    BoxArrays view() const { return {low_x.data(), high_x.data(), low_y.data(), high_y.data(), low_z.data()}; }
  };
  static constexpr std::size_t kLevels = 4;  // the lowest first

  void add(std::size_t level, const GridBox& box);
  std::uint32_t find_at(const ShadowKernels& kernels, std::size_t level, const GridBox& box, float spread,
                        std::vector<std::uint32_t>& found);

  std::array<Level, kLevels> levels_;
  std::uint32_t count_ = 0;
  std::array<std::vector<std::uint32_t>, kLevels> found_;  // of the level above each
};

// What points are made of, besides the view: the same throughout a picture.
struct PointSource {
  const ShadowKernels& kernels;
  const PointFrame& frame;
  const shape::SamplePattern& pattern;
  const PairVectors& vectors;
  std::uint32_t light;        // number of the casting light
  std::uint32_t light_point;  // of it
};

// Puts those points of a square on the views' grids that count(pairs, lane, moved) says, `moved` being what moving
// casters block; calls visit(points, vector, view) for each vector that has some.
template <typename Counts, typename Visit>
void for_each_vector(const PointSource& source, const Layer& layer, std::uint32_t tile, const Counts& counts,
                     std::span<const LightView> views, const Visit& visit);

// The points that one view decides about.
class Points {
 public:
  void clear();
  void add(Layer& layer, std::uint32_t tile, std::uint32_t vector, const PointVector& points);
  void finish() { tree_.finish(); }

  bool empty() const { return vectors_.empty(); }
  std::uint64_t count() const { return count_; }
  std::size_t vector_count() const { return vectors_.size(); }
  std::size_t bytes() const;  // of memory, that they have
  BoxTree& tree() { return tree_; }
  PointVector* vectors() { return vectors_.data(); }
  // Calls visit(layer, part) for each vector i of points of samples (PairVectors without size) where some[i] is set.
  template <typename Visit>
  void visit_squares(std::span<const std::uint8_t> some, std::uint32_t samples, const Visit& visit) const {
    for (std::size_t i = 0; i < some.size(); ++i)
      if (some[i] != 0) visit(origins_[i].layer, TilePart{origins_[i].tile, 1u << origins_[i].vector / samples});
  }
  // Writes down what is blocked since the last time.
  void note(const PointSource& source, Casting casting);

 private:
  struct Origin {
    Layer* layer;
    std::uint32_t tile;
    std::uint32_t vector;
  };

  std::vector<PointVector> vectors_;
  std::vector<Origin> origins_;
  BoxTree tree_;
  std::uint64_t count_ = 0;
};

// Adds those of a part of a layer that matter and are not blocked to the views that decide about them.
void add_points(const PointSource& source, std::span<const LightView> views, Layer& layer, const TilePart& part,
                std::span<Points> points);

// The lines of a square; nullptr where nothing is seen.
using TileLines = std::array<const LayerLine*, kTile>;
TileLines lines_of(const Layer& layer, std::uint32_t top);

// Points far behind the others, which make a vector of their own: a box round both is in nobody's way by itself, but
// most casters are in its.
std::uint32_t far_ones(const PointFrame& frame, const float* depths, std::uint32_t active);

// Where a square lies in its lines: its first pairs, its first column, and how many there are.
struct TilePlace {
  std::size_t pairs;
  std::uint32_t left;
  std::uint32_t columns;
};

// Of four points next to each other, the first of which is `lane`.
template <typename Counts>
std::uint32_t gather_row(const Lane lane, const LayerLine& line, const TilePlace& place, const Counts& counts,
                         float* depths) {
  const wire::StillPairs* const pairs = line.pairs + place.pairs + lane.column;
  const std::uint16_t* const moved = line.moved == nullptr ? nullptr : line.moved + place.pairs + lane.column;
  const float* const depth = line.depth + lane.sample * line.stride + place.left + lane.column;
  std::uint32_t active = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    depths[k] = depth[k];
    active |= static_cast<std::uint32_t>(counts(pairs[k], lane, moved == nullptr ? std::uint16_t{0} : moved[k])) << k;
  }
  return active;
}

// The depths of those points of a vector that count; which they are.
template <typename Counts>
std::uint32_t gather(const PointSource& source, const VectorLanes& lanes, const TileLines& lines,
                     const TilePlace& place, const Counts& counts, float* depths) {
  std::uint32_t active = 0;
  const auto take = [&](std::uint32_t k, const LayerLine& line) {
    const Lane lane = lanes.lane[k];
    const std::size_t at = place.pairs + lane.column;
    const std::uint16_t moved = line.moved == nullptr ? std::uint16_t{0} : line.moved[at];
    active |= static_cast<std::uint32_t>(counts(line.pairs[at], lane, moved)) << k;
    depths[k] = line.depth[lane.sample * line.stride + place.left + lane.column];
  };
  if (source.vectors.are_rows() && place.columns == kTile) {
    for (std::uint32_t k = 0; k < kPointLanes; k += 4)
      if (const LayerLine* line = lines[lanes.lane[k].line])
        active |= gather_row(lanes.lane[k], *line, place, counts, depths + k) << k;
    return active;
  }
  for (std::uint32_t k = 0; k < kPointLanes; ++k)
    if (const LayerLine* line = lines[lanes.lane[k].line]; line != nullptr && lanes.lane[k].column < place.columns)
      take(k, *line);
  return active;
}

template <typename Counts, typename Visit>
void for_each_vector(const PointSource& source, const Layer& layer, std::uint32_t tile, const Counts& counts,
                     std::span<const LightView> views, const Visit& visit) {
  alignas(64) float depths[kPointLanes] = {};
  const std::uint32_t left = tile % layer.tiles_across() * kTile, top = tile / layer.tiles_across() * kTile;
  const std::size_t first = std::size_t{source.light} * layer.width + left;
  const std::uint32_t columns = std::min(kTile, layer.width - left);
  const TileLines lines = lines_of(layer, top);
  PointVector points;
  for (std::uint32_t v = 0; v < source.vectors.vectors(); ++v) {
    const VectorLanes& lanes = source.vectors.lanes(source.light_point, v);
    const std::uint32_t active = gather(source, lanes, lines, {first, left, columns}, counts, depths);
    const std::uint32_t far = far_ones(source.frame, depths, active);
    for (const std::uint32_t some : {active & ~far, far}) {
      if (some == 0) continue;
      for (std::size_t f = 0; f < views.size(); ++f) {
        source.kernels.put_points(views[f], source.frame, static_cast<float>(left), static_cast<float>(top),
                                  lanes.place, depths, some, points);
        if (points.active != 0) visit(points, v, f);
      }
    }
  }
}

}  // namespace mars::shadow
