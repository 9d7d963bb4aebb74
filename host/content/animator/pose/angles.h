// From an orientation back to a pose: the turns about a joint's own three axes that give it, orientation()'s
// inverse, also for skewed axes. Two poses give the same orientation (and those whole turns away): it is
// within the joint's limits if any of them is.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "host/content/modeler/joint.h"

namespace mars::animator {

// Degrees; less is the rounding of the way back.
inline constexpr double kAngleRounding = 1e-5;

// How far a pose is outside the limits, degrees about each axis, never negative.
glm::dvec3 excess_of(const modeler::Joint& joint, const glm::dvec3& pose);
double largest_excess(const modeler::Joint& joint, const glm::dvec3& pose);

// The pose with orientation(joint, pose) == turn: one within the limits if there is one, else the one that
// leaves them least; among such the one nearest to `near`. Axes that are skewed do not reach every
// orientation: then the pose about as near as they come.
glm::dvec3 pose_of(const modeler::Joint& joint, const glm::dmat3& turn, const glm::dvec3& near);

// The nearest pose that the limits allow, axis by axis.
glm::dvec3 clamped(const modeler::Joint& joint, const glm::dvec3& pose);

}  // namespace mars::animator
