// Shafts: which casters may block points of a light that has a size from any place of it, and the squares of points
// that they may block, so that the light's points are asked about these alone (E. Haines, J. Wallace, "Shaft culling
// for efficient ray-traced radiosity", 1991). A shaft is wider than all rays from a point to the light, on the grid of
// the light's middle: what is left out is what no point of the light finds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "node/shadow/band.h"
#include "node/shadow/casters.h"
#include "node/shadow/grid_caster.h"
#include "node/shadow/light_views.h"
#include "node/shadow/points.h"

namespace mars::shadow {

// What shafts find. Its casters are good until the next time.
struct Touched {
  std::vector<ChunkCaster> casters;          // with those of their batches that matter
  std::vector<std::vector<TilePart>> parts;  // by layer
};

// Towards a light that has a size.
Shaft shaft_of(const LightViews& light);

class Shafts {
 public:
  explicit Shafts(const ShadowKernels& kernels) : kernels_(kernels) {}

  // Shafts from the open points of layers to a light. `source`: of points of all samples (PairVectors without size).
  void begin(const LightViews& light, const PointSource& source, std::uint32_t pairs_a_sample,
             std::span<Layer* const> layers);
  // Whether a surface within the hull may matter.
  bool meet(const Hull& hull, GridCaster& grid);
  const Touched& find(std::span<const ChunkCaster> casters, GridCaster& grid);

  // The shafts' points, by face.
  const std::vector<Points>& points() const { return points_; }

 private:
  bool is_near(const Hull& hull) const;
  void touch(const ChunkCaster& caster, std::size_t face, GridCaster& grid);
  void keep_batches(const ChunkCaster& caster);

  void keep_parts();

  const ShadowKernels& kernels_;
  std::uint32_t samples_ = 0;
  const LightViews* light_ = nullptr;
  std::span<Layer* const> layers_;
  Shaft shaft_{};
  bool is_open_ = false;                            // any place may be met: points or casters are too near the light
  std::vector<Points> points_;                      // by face
  std::vector<std::vector<std::uint8_t>> touched_;  // vectors
  std::vector<std::uint64_t> batches_;              // of a caster, one bit each
  std::vector<Caster> surfaces_;
  std::vector<shape::Batch> kept_;
  Touched found_;
};

}  // namespace mars::shadow
