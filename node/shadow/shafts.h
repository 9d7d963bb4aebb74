// Shafts: which casters may block points of a light that has a size from any place of it, and the squares of points
// that they may block, so that the light's points are asked about these alone (E. Haines, J. Wallace, "Shaft culling
// for efficient ray-traced radiosity", 1991). A shaft is wider than all rays from a point to the light, on the grid of
// the light's middle: what is left out is what no point of the light finds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "node/shadow/band.h"
#include "node/shadow/block_plainly.h"
#include "node/shadow/casters.h"
#include "node/shadow/grid_caster.h"
#include "node/shadow/light_views.h"
#include "node/shadow/points.h"

namespace mars::shadow {

// Of points on a grid of a light's middle: their shafts, and how near to a light with a place a surface may be that
// blocks them though it is not before that grid's view: all may where the points are too near the light.
struct ShaftReach {
  Shaft shaft;
  float near;
};
// `high_z`: the greatest z of the points; 0 if there are none, which no surface is near enough to block.
ShaftReach reach_of(const LightViews& light, float high_z);
bool is_near(const LightViews& light, std::size_t face, const ShaftReach& reach, const Hull& hull);

// What shafts find. Its casters are good until the next time.
struct Touched {
  std::vector<ChunkCaster> casters;          // with those of their batches that matter
  std::vector<std::vector<TilePart>> parts;  // by layer
};

class Shafts {
 public:
  explicit Shafts(const ShadowKernels& kernels) : kernels_(kernels) {}
  explicit Shafts(const ShadowKernels&&) = delete;

  // Shafts from the open points of layers to a light. `source`: of points of all samples (PairVectors without size).
  void begin(const LightViews& light, const PointSource& source, std::uint32_t pairs_a_sample,
             std::span<Layer* const> layers);
  // Whether a surface within the hull may matter.
  bool meet(const Hull& hull, GridCaster& grid);
  const Touched& find(std::span<const ChunkCaster> casters, GridCaster& grid);

  // The shafts' points, by face.
  const std::vector<Points>& points() const { return points_; }

 private:
  // Those of the light: there may be room for more.
  std::size_t faces() const { return light_->middle.size(); }
  void touch(const ChunkCaster& caster, std::size_t face, GridCaster& grid);
  void touch_all(std::size_t face);
  // `bit` is set in `touching` where the piece of a large triangle meets shafts.
  void touch(const LargeTriangle& piece, std::size_t face, std::uint64_t& touching, std::uint64_t bit);
  void keep_batches(const ChunkCaster& caster);
  void keep_parts();

  const ShadowKernels& kernels_;
  std::uint32_t samples_ = 0;
  const LightViews* light_ = nullptr;
  std::span<Layer* const> layers_;
  std::vector<float> high_z_;                       // by face
  std::vector<ShaftReach> reach_;                   // by face
  std::vector<Points> points_;                      // by face
  std::vector<std::vector<std::uint8_t>> touched_;  // vectors
  std::vector<std::uint64_t> batches_;              // of a caster, one bit each
  std::vector<Caster> surfaces_;
  std::vector<shape::Batch> kept_;
  std::vector<std::uint32_t> found_by_large_;
  Touched found_;
};

}  // namespace mars::shadow
