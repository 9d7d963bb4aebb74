// Inverse kinematics: the turns of a chain of joints, within their limits, that bring its end where it shall
// be. Any axes and any freedoms: damped least squares (Levenberg, Marquardt) on the numbers of the pose
// themselves.
#pragma once

#include <optional>
#include <span>

#include "host/content/animator/motion/posture.h"

namespace mars::motion {

// What a joint's frame shall do, in the world. Weights say how long an error of one radian counts as.
struct Goal {
  std::size_t joint;
  std::optional<glm::dvec3> place{};
  std::optional<glm::dmat3> turn{};
  double turn_weight = 1;
  // A direction of the joint's own frame that shall lie across `across`.
  std::optional<glm::dvec3> direction{};
  glm::dvec3 across{0, 0, 0};
};

// Turns `joints`, each an ancestor of a goal's or itself, from where they are to where the goals are met as
// nearly as limits allow.
void reach(const modeler::Model& model, Posture& posture, std::span<const std::size_t> joints,
           std::span<const Goal> goals);

// The numbers within the joint's limits whose turn is nearest to `turn`, found from `near`.
glm::dvec3 nearest_turns(const modeler::Joint& joint, const glm::dmat3& turn, const glm::dvec3& near);

}  // namespace mars::motion
