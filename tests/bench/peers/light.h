// The scene as its light sees it: where shadows of what moves may fall, and which window a map of depths needs.
#pragma once

#include <array>
#include <vector>

#include "tests/bench/peers/cover.h"
#include "tests/bench/peers/mesh.h"

namespace mars::bench {

// Unit axes in eye space: across the light's rays twice, and towards the light.
struct LightAxes {
  std::array<std::array<float, 3>, 3> axis;
};

// Those whose window round `outlines`, each moved so, is smallest.
LightAxes light_axes(const MeshHead& head, const std::vector<Outline>& outlines);

// Along each of the axes.
struct LightBox {
  std::array<float, 3> low, high;
};

LightBox light_box(const LightAxes& axes, const Outline& outline, const Motion& motion);
LightBox round(const LightBox& a, const LightBox& b);

// Whether a shadow of `caster` can fall on `receiver`. `sun`: the tangent of half the angle that the light takes up.
bool may_shade(const LightBox& caster, const LightBox& receiver, float sun);

// The pixels of patches that stand, and which of them the mover may shade.
class ShadedAreas {
 public:
  ShadedAreas(const Mesh& mesh, float sun);

  // Of patches on which a shadow of what moves can fall, in its place of `motion`.
  std::vector<Area> of(const Motion& motion) const;

 private:
  struct Receiver {
    LightBox box;
    Area area;
  };

  float sun_;
  std::vector<Outline> mover_;
  LightAxes axes_;
  std::vector<Receiver> receivers_;
};

}  // namespace mars::bench
