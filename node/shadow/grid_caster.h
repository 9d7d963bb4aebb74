// A caster on the grid of one view.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "node/shadow/casters.h"
#include "node/shadow/kernels.h"
#include "node/shadow/light_view.h"
#include "node/shadow/points.h"

namespace mars::shadow {

class GridCaster {
 public:
  explicit GridCaster(const ShadowKernels& kernels);
  explicit GridCaster(const ShadowKernels&&) = delete;

  // Puts a hull on the grid: the box round surfaces within it.
  GridBox put(const LightView& view, const Hull& hull);
  // Puts a surface on the grid, the hull of which was the last: the box round it, empty where the light does not meet
  // it.
  GridBox put(const LightView& view, const Caster& surface);

  const GridVertices& vertices() const { return vertices_; }
  // Numbers of vectors with open points whose shafts a surface within `box` and the hull may meet. Changed by the next
  // call.
  std::span<std::uint32_t> find_below(const GridBox& box, const Shaft& shaft, Points& points);

  // Calls visit(batches, first) for the triangles of the surface, kMostBatches at a time, of which `first` is the
  // number of the first batch; before, visit_large(triangle, batch) for those that are not small. Others that do not
  // meet `where` may be left out.
  template <typename Visit, typename VisitLarge>
  void visit_batches(const LightView& view, const Caster& surface, const GridBox& where, const Visit& visit,
                     const VisitLarge& visit_large);

 private:
  const ShadowKernels& kernels_;
  GridHull hull_{};
  bool hull_is_on_grid_ = false;
  std::vector<std::int32_t> x_, y_;
  std::vector<float> z_;
  GridVertices vertices_;
  std::unique_ptr<SmallBatches> small_;
  std::vector<std::uint32_t> found_;
};

template <typename Visit, typename VisitLarge>
void GridCaster::visit_batches(const LightView& view, const Caster& surface, const GridBox& where, const Visit& visit,
                               const VisitLarge& visit_large) {
  const shape::Triangles& triangles = surface.triangles;
  for (std::uint32_t first = 0; first < triangles.batch_count; first += kMostBatches) {
    const std::uint32_t last = std::min(first + kMostBatches, triangles.batch_count);
    small_->count = 0;
    for (std::uint32_t b = first; b < last; ++b) {
      const shape::Batch& batch = triangles.batches[b];
      std::uint32_t large = kernels_.set_up(view, vertices_, triangles, batch, where, *small_);
      for (; large != 0; large &= large - 1)
        visit_large(batch.first + static_cast<std::uint32_t>(std::countr_zero(large)), b);
    }
    visit(*small_, first);
  }
}

}  // namespace mars::shadow
