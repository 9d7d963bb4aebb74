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

// Round nothing, and round both.
extern const GridBox kNowhere;
GridBox around(const GridBox& a, const GridBox& b);

// Boxes, boxes round sixteen of them each, and so on up to sixteen.
class BoxTree {
 public:
  void clear();
  void add(const GridBox& box);
  void finish();  // before it is asked
  std::uint32_t count() const { return count_; }

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

// Puts those points of a square on the view's grid that count(pairs, lane, moved) says, `moved` being what moving
// casters block; calls visit(points, vector) for each vector that has some.
template <typename Counts, typename Visit>
void for_each_vector(const PointSource& source, const Layer& layer, std::uint32_t tile, const Counts& counts,
                     const LightView& view, const Visit& visit);

// The points that one view decides about.
class Points {
 public:
  void clear();
  // Those of a layer that matter and are not blocked.
  void add(const PointSource& source, const LightView& view, const Layer& layer);
  void finish() { tree_.finish(); }

  bool empty() const { return vectors_.empty(); }
  std::uint64_t count() const { return count_; }
  BoxTree& tree() { return tree_; }
  PointVector* vectors() { return vectors_.data(); }
  // Writes down what is blocked since the last time.
  void note(const PointSource& source, Casting casting);

 private:
  struct Origin {
    const Layer* layer;
    std::uint32_t tile;
    std::uint32_t vector;
  };

  std::vector<PointVector> vectors_;
  std::vector<Origin> origins_;
  BoxTree tree_;
  std::uint64_t count_ = 0;
};

// The lines of a square; nullptr where nothing is seen.
using TileLines = std::array<const LayerLine*, kTile>;
TileLines lines_of(const Layer& layer, std::uint32_t top);

// Points far behind the others, which make a vector of their own: a box round both is in nobody's way by itself, but
// most casters are in its.
std::uint32_t far_ones(const float* inverse_w, std::uint32_t active);

template <typename Counts, typename Visit>
void for_each_vector(const PointSource& source, const Layer& layer, std::uint32_t tile, const Counts& counts,
                     const LightView& view, const Visit& visit) {
  alignas(64) float inverse_w[kPointLanes] = {};
  const std::uint32_t left = tile % layer.tiles_across() * kTile, top = tile / layer.tiles_across() * kTile;
  const std::size_t first = std::size_t{source.light} * layer.width + left;
  const std::uint32_t columns = std::min(kTile, layer.width - left);
  const TileLines lines = lines_of(layer, top);
  PointVector points;
  for (std::uint32_t v = 0; v < source.vectors.vectors(); ++v) {
    const VectorLanes& lanes = source.vectors.lanes(source.light_point, v);
    std::uint32_t active = 0;
    for (std::uint32_t k = 0; k < kPointLanes; ++k) {
      const Lane lane = lanes.lane[k];
      const LayerLine* line = lines[lane.line];
      if (line == nullptr || lane.column >= columns) continue;
      const std::size_t at = first + lane.column;
      if (!counts(line->pairs[at], lane, line->moved == nullptr ? std::uint16_t{0} : line->moved[at])) continue;
      active |= 1u << k;
      inverse_w[k] = line->depth[lane.sample * line->stride + left + lane.column];
    }
    const std::uint32_t far = far_ones(inverse_w, active);
    for (const std::uint32_t some : {active & ~far, far}) {
      if (some == 0) continue;
      source.kernels.put_points(view, source.frame, static_cast<float>(left), static_cast<float>(top), lanes.place,
                                inverse_w, some, points);
      if (points.active != 0) visit(points, v);
    }
  }
}

}  // namespace mars::shadow
