// How people's joints turn: about which axes, and how far. The numbers of a pose then mean the same in every figure, as
// in those of MARS's library: y bends (a hip and an elbow forward with less, a knee back with more), x moves aside,
// about the direction forward, z twists about the bone.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "host/content/importer/limbs/figure_tree.h"

namespace mars::importer {

// Of a limb's joint, in the model's axes.
struct JointAnatomy {
  glm::dmat3 axes;                                         // unit vectors at right angles, z along x cross y
  std::optional<std::array<modeler::Limits, 3>> limits{};  // none: it turns freely
};

// By joint of the tree: limbs, and what lies between them; none of other joints, and where the figure does not
// determine axes: both hips must be known, beside each other. Limits are people's, counted from how the figure stands
// at rest: an arm that is held out at rest turns 90 degrees down to hang. Figures whose arms reach as low as their feet
// have four legs, and no limits.
std::vector<std::optional<JointAnatomy>> anatomy_of(const FigureTree& tree, const modeler::Limbs& limbs);

}  // namespace mars::importer
