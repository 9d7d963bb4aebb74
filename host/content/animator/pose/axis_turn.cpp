#include "host/content/animator/pose/axis_turn.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/rotation.h"
#include "host/content/modeler/frames.h"

namespace mars::animator {
namespace {

glm::dvec3 unit_axis(const modeler::Joint& joint, int axis) {
  if (axis == 2) return glm::normalize(glm::cross(joint.x_axis, joint.y_axis));
  return axis == 0 ? joint.x_axis : joint.y_axis;
}

Turned reached(const modeler::Joint& joint, const glm::dmat3& turn, const glm::dvec3& near) {
  const glm::dvec3 pose = pose_of(joint, turn, near);
  return {pose, turn_between(modeler::orientation(joint, pose), turn).angle / modeler::kDegree};
}

}  // namespace

glm::dvec3 present_axis(const modeler::Joint& joint, const glm::dvec3& pose, int axis) {
  return modeler::orientation(joint, pose) * unit_axis(joint, axis);
}

Turned turned_about(const modeler::Joint& joint, const glm::dvec3& pose, const glm::dvec3& axis, double degrees,
                    const glm::dvec3& near) {
  return reached(joint, modeler::rotation_by_degrees(axis, degrees) * modeler::orientation(joint, pose), near);
}

bool turns_by_number(const modeler::Joint& joint, const glm::dvec3& pose, int axis) {
  if (joint.freedoms() > 1) return false;
  for (int later = axis + 1; later < 3; ++later)
    if (pose[later] != 0) return false;
  return true;
}

Turned turned_about_own(const modeler::Joint& joint, const glm::dvec3& pose, int axis, double degrees) {
  if (turns_by_number(joint, pose, axis)) {
    glm::dvec3 turned = pose;
    turned[axis] += degrees;
    return {turned, 0};
  }
  const glm::dmat3 own = modeler::rotation_by_degrees(unit_axis(joint, axis), degrees);
  return reached(joint, modeler::orientation(joint, pose) * own, pose);
}

}  // namespace mars::animator
