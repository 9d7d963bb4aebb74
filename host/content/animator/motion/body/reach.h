// Inverse kinematics: the turns of a chain of joints, within their limits, that bring its end where it shall
// be. Any axes and any freedoms: damped least squares (Levenberg, Marquardt) on the numbers of the pose
// themselves.
#pragma once

#include <optional>
#include <span>

#include "host/content/animator/motion/body/posture.h"

namespace mars::motion {

// What a joint's frame shall do, in the world. Weights say how long an error of one radian counts as.
struct Goal {
  std::size_t joint;
  std::optional<glm::dvec3> place{};
  std::optional<glm::dmat3> turn{};
  double turn_weight = 1;
  glm::dvec3 held{0, 0, 0};  // the place in the joint's frame that shall be there
  double place_weight = 1;
  // A direction of the joint's own frame that shall lie across `across`.
  std::optional<glm::dvec3> direction{};
  glm::dvec3 across{0, 0, 0};
};

// What may change, and how it would rather not.
struct Search {
  std::span<const std::size_t> joints;
  bool moves_actor = false;  // the actor's place, too
  // Of all postures that meet the goals as nearly, the one nearest to `rest`, if there is one: `stiffness` says, for
  // each of `joints`, how long an error of one radian away from it counts as; the place's, of one unit.
  const Posture* rest = nullptr;
  std::span<const double> stiffness{};
  double place_stiffness = 0;
  double small_step = 1e-9;  // radians: nothing more to gain
  double small_gain = 0;     // as little of the error as a round must gain for another one
};

void reach(const modeler::Model& model, Posture& posture, const Search& search, std::span<const Goal> goals);

// Turns `joints`, each an ancestor of a goal's or itself, from where they are to where the goals are met as
// nearly as limits allow.
void reach(const modeler::Model& model, Posture& posture, std::span<const std::size_t> joints,
           std::span<const Goal> goals);

// The numbers within the joint's limits whose turn is nearest to `turn`, found from `near`.
glm::dvec3 nearest_turns(const modeler::Joint& joint, const glm::dmat3& turn, const glm::dvec3& near);

}  // namespace mars::motion
