// Clipping of one triangle in eye space against near, far and the four planes of the guard band.
#pragma once

#include <array>

#include "node/shape/vertices.h"

namespace mars::geometry {

struct ClipVertex {
  float place[3];
  float varying[3];  // its normal or its colour
};

// Six planes add at most one corner each.
struct ClipPolygon {
  std::array<ClipVertex, 9> vertex;
  int count = 0;
};

// Cuts in place; count is 0 where nothing is left. A cut's place depends on the two ends of the edge alone,
// not on which of them comes first.
void clip(const shape::Projection& projection, ClipPolygon& polygon);

}  // namespace mars::geometry
