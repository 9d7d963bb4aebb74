// Casters that are large on a view's grid or not all on it, one by one: the plain twin of the kernels, whatever the
// size. Places on the grid are whole numbers of 64 bits, edge functions of 128.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "node/shadow/casters.h"
#include "node/shadow/kernels.h"

namespace mars::shadow {

struct GridPlace {
  std::int64_t x, y;
  double z;
};

// On a view's grid.
struct LargeTriangle {
  GridPlace a, b, c;
  double per_step;  // the view's

  GridBox box() const;  // as far as its numbers reach
};

// visit(piece) for the parts of triangle `number` of the caster that are far enough from the light: it, or two where it
// is cut. `vertices`: the caster's, on the view's grid.
void for_each_piece(const LightView& view, const Caster& caster, const GridVertices& vertices, std::uint32_t number,
                    const std::function<void(const LargeTriangle&)>& visit);

// Calls visit(number) for those of the vectors `found` of which it may block points from places of a light whose shafts
// these are.
void visit_behind(const LargeTriangle& triangle, const Shaft& shaft, const PointVector* points,
                  std::span<const std::uint32_t> found, const std::function<void(std::uint32_t)>& visit);

// Blocks those of the points `found` that the triangle is before.
void block_plainly(const LargeTriangle& triangle, PointVector* points, std::span<const std::uint32_t> found);

}  // namespace mars::shadow
