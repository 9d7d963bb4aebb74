// Skeletons and motions of files that have no shapes (BVH, ASF with AMC): joints as a model has them, and what each
// does frame by frame. Both are in the file's axes and units until placed() turns and scales them.
#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "host/content/modeler/joint.h"

namespace mars::importer {

struct Skeleton {
  std::vector<modeler::Joint> joints;         // the first has no parent, all others do; no segments
  std::vector<std::vector<glm::dvec3>> ends;  // of each joint: where bones end that carry nothing, in its frame
};

struct Motion {
  double rate = 0;                             // frames a second
  std::vector<glm::dvec3> places;              // where the first joint is, by frame
  std::vector<std::vector<glm::dvec3>> poses;  // by frame and joint: degrees about the joint's own axes
};

// Which axes a joint has, and which of its numbers have the other sign, so that Rot(x, a) Rot(y, b) Rot(z, c) are the
// turns of a file.
struct TurnAxes {
  glm::dvec3 x_axis{1, 0, 0}, y_axis{0, 1, 0};
  double third = 1;  // -1: the file's third axis is against the joint's z
};

// `axes`: at most three unit vectors, each perpendicular to the one before it and not the same twice, the turn about
// the first being outermost: a column vector is first turned about the last. `distinct()` must hold.
TurnAxes turn_axes(std::span<const glm::dvec3> axes);
bool distinct(std::span<const glm::dvec3> axes);

// Turned by `upright` and scaled.
Skeleton placed(Skeleton skeleton, const glm::dmat3& upright, double factor);
Motion placed(Motion motion, const glm::dmat3& upright, double factor);

struct SkeletonBox {
  glm::dvec3 min, max;
};
// Of all joints and ends at rest, in the frame in which the first joint's place is given.
SkeletonBox rest_box(const Skeleton& skeleton);

// Where every joint is, the first at `place`; the turns of all joints are in `pose`.
std::vector<glm::dvec3> places_of(const Skeleton& skeleton, const glm::dvec3& place, std::span<const glm::dvec3> pose);

}  // namespace mars::importer
