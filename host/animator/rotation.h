// Rotations as matrices (column vectors), and the one turn that takes an orientation to another (thesis 3.4).
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace mars::host {

// About `axis`, a unit vector, by an angle in radians: cos I + (1 - cos) n n^T + sin N.
glm::dmat3 rotation(const glm::dvec3& axis, double angle);

// In degrees; quarter turns are exact.
glm::dmat3 rotation_by_degrees(const glm::dvec3& axis, double degrees);

struct Turn {
  glm::dvec3 axis;  // a unit vector, seen from outside both orientations
  double angle;     // radians, 0..pi; exactly 0 if nothing turns
};

// The smallest turn R with last = R first. Half a turn's axis has its largest component positive.
Turn turn_between(const glm::dmat3& first, const glm::dmat3& last);

}  // namespace mars::host
