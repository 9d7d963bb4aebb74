// A ray tracer in double precision, which says of a pair whether anything is between its sample and its point of the
// light, but where that hangs on the roundings that node/shadow/light_view.h states: where the ray passes within two
// grid steps of an edge, or what it meets is about as far before the sample as the bound e (1 + s).
#pragma once

#include <span>
#include <vector>

#include "tests/render/shadow_rig.h"

namespace mars::test {

enum class Sight { open, blocked, unsure };

class ShadowRays {
 public:
  explicit ShadowRays(std::span<const CastingSurface> surfaces);

  // Of a point at `place`, `w` along the view axis.
  Sight trace(const shadow::LightView& view, const shadow::PointFrame& frame, const shape::Vec3& place, double w) const;

 private:
  struct Body {
    shape::Vec3 middle;
    double radius;
    std::span<const std::array<shape::Vec3, 3>> triangles;
  };
  std::vector<Body> bodies_;
};

}  // namespace mars::test
