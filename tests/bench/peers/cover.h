// Which pixels a mesh's patches can cover, so that peers look at no others.
#pragma once

#include <array>
#include <vector>

#include "tests/bench/peers/mesh.h"

namespace mars::bench {

struct Area {
  int left, top, right, bottom;  // pixels, half open
};

// Points in eye space round one patch: the corners of its box; its vertices where it moves, for a turned box is large.
using Outline = std::vector<std::array<float, 3>>;

// Of all patches that move, or of all that stand still.
std::vector<Outline> outlines_of(const Mesh& mesh, bool moving);

// The pixels that lie within an outline moved so, at least.
Area cover(const Outline& outline, const MeshHead& head, const Motion& motion);

}  // namespace mars::bench
