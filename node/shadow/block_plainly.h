// Casters that are large on a view's grid or not all on it, one by one: the plain twin of the kernels, whatever the
// size. Places on the grid are whole numbers of 64 bits, edge functions of 128.
#pragma once

#include <cstdint>
#include <span>

#include "node/shadow/casters.h"
#include "node/shadow/kernels.h"

namespace mars::shadow {

// Blocks those of the points `found` that triangle `number` of the caster is before. `vertices`: the caster's, on the
// view's grid.
void block_plainly(const LightView& view, const Caster& caster, const GridVertices& vertices, std::uint32_t number,
                   PointVector* points, std::span<const std::uint32_t> found);

}  // namespace mars::shadow
