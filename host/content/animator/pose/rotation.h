// The one turn that takes an orientation to another (thesis 3.4). Rotations are matrices for column vectors, made by
// host/content/modeler/frames.h.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "host/content/modeler/frames.h"

namespace mars::animator {

struct Turn {
  glm::dvec3 axis;  // a unit vector, seen from outside both orientations
  double angle;     // radians, 0..pi; exactly 0 if nothing turns
};

// The smallest turn R with last = R first. Half a turn's axis has its largest component positive.
Turn turn_between(const glm::dmat3& first, const glm::dmat3& last);

}  // namespace mars::animator
