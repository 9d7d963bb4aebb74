#include "host/content/animator/pose/within_limits.h"

#include "hal/failure/failure.h"
#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/figure.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

// "-170 degrees about y is beyond its limits -150 to 0".
std::string beyond_limits(const modeler::Limits& limits, int axis, double angle) {
  const std::string text = document::shown(angle) + " degrees about " + "xyz"[axis];
  return limits.free()
             ? text + " is beyond its limits " + document::shown(limits.lower) + " to " + document::shown(limits.upper)
             : text + ", where it is locked at " + document::shown(limits.lower);
}

}  // namespace

glm::dvec3 within_limits(const std::string& thing, const modeler::Joint& joint, const glm::dvec3& pose, Beyond beyond,
                         Remarks& remarks, const std::string& asked) {
  const glm::dvec3 nearest = clamped(joint, pose);
  if (largest_excess(joint, pose) <= kAngleRounding) return nearest;
  const std::string name = thing + ", joint '" + joint.name + "'", by = asked.empty() ? "" : asked + ", ";
  if (beyond == Beyond::refused)
    throw Failure(by + *broken_limit(joint, pose), name,
                  "--clamp takes the nearest allowed, or widen the limits in its model");
  for (int axis = 0; axis < 3; ++axis)
    if (excess_of(joint, pose)[axis] > kAngleRounding)
      remarks.push_back(name + ": " + by + beyond_limits(joint.limits[axis], axis, pose[axis]) + ": keyed as " +
                        document::shown(nearest[axis]));
  return nearest;
}

}  // namespace mars::animator
