// A turn about an axis as it stands now, after all three numbers of a pose: the thesis's R = (model, segment, axis,
// angle) (2.1, 3.3). Its result is a pose again, in three numbers.
#pragma once

#include <glm/vec3.hpp>

#include "host/content/modeler/joint.h"

namespace mars::animator {

struct Turned {
  glm::dvec3 pose;
  double missed;  // degrees by which the pose misses the turn, where skewed axes do not reach it; else rounding

  bool reached() const { return missed < 1e-3; }
};

// The joint's own axis (0 x, 1 y, 2 z), a unit vector in its parent's frame, as the pose has turned it.
glm::dvec3 present_axis(const modeler::Joint& joint, const glm::dvec3& pose, int axis);

// The joint turned by a number of degrees about a unit vector in its parent's frame. Of the poses that give the same
// orientation the result is one within the limits if there is one, and among such the nearest to `near` (pose_of()).
Turned turned_about(const modeler::Joint& joint, const glm::dvec3& pose, const glm::dvec3& axis, double degrees,
                    const glm::dvec3& near);

// Whether a turn about the joint's own present axis is one of that number alone, also beyond half a turn: the joint has
// at most one freedom, and the axes that turn after this one are locked at 0.
bool turns_by_number(const modeler::Joint& joint, const glm::dvec3& pose, int axis);

// The same as turned_about(), about the joint's own present axis, nearest to `pose`, or by its number.
Turned turned_about_own(const modeler::Joint& joint, const glm::dvec3& pose, int axis, double degrees);

}  // namespace mars::animator
