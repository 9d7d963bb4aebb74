// The views of one light (light_view.h): of its points, and of its middle.
#pragma once

#include <cstdint>
#include <vector>

#include "node/geometry/eye_light.h"
#include "node/shadow/light_view.h"
#include "node/shape/vertices.h"

namespace mars::shadow {

// Points of a light that has a size: a fixed set, of which each pixel has as many as its pairs (pairs.h).
inline constexpr std::uint32_t kLightPoints = 64;

// One light, seen from its points.
struct LightViews {
  std::uint32_t points;           // 1 or kLightPoints
  std::uint32_t faces;            // views of a point
  std::vector<LightView> views;   // point by point
  std::vector<LightView> middle;  // views of its middle
  float size;                     // as in geometry::EyeLight
  float spread;  // grid steps between what the middle and another point see, for each unit of z from caster to point
  PointFrame frame;
};

// `light` casts. `room`: views that are seen no more, the memory of which is used again.
LightViews light_views(const geometry::EyeLight& light, const shape::Projection& projection, LightViews room = {});

}  // namespace mars::shadow
