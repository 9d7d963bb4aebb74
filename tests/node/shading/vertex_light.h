// The vertex kernel as a probe: what single places send to the eye.
#pragma once

#include <array>
#include <vector>

#include "node/shading/kernels.h"
#include "tests/node/shading/plain_light.h"

namespace mars::shading {

// A frame with room for its material and lights.
struct Frame {
  Shading shading{};
  wire::Material material{{1, 1, 1}, 0, 1, 1, 32, 2};
  std::vector<geometry::EyeLight> lights;

  Frame();
  const Shading& view();
};

using Colors = std::array<std::vector<float>, 3>;

// With normals as seen from outside.
Colors light_of(Frame& frame, const std::vector<Spot>& spots, simd::InstructionSet set);

}  // namespace mars::shading
