#include "host/content/modeler/joint.h"

#include <algorithm>

namespace mars::modeler {

Box thickened(Box box) {
  for (int axis = 0; axis < 3; ++axis)
    if (box.min[axis] == box.max[axis]) box.max[axis] += 1;
  return box;
}

glm::dvec3 Joint::rest() const {
  glm::dvec3 pose;
  for (int axis = 0; axis < 3; ++axis) pose[axis] = std::clamp(0.0, limits[axis].lower, limits[axis].upper);
  return pose;
}

int Joint::freedoms() const {
  return static_cast<int>(std::count_if(limits.begin(), limits.end(), [](const Limits& l) { return l.free(); }));
}

bool is_at_or_below(std::span<const Joint> joints, std::size_t joint, std::size_t above) {
  while (joint != kNone && joint != above) joint = joints[joint].parent;
  return above != kNone && joint == above;
}

}  // namespace mars::modeler
