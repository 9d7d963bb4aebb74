// Which points of a figure's surface which joints move.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "host/content/animator/motion/body/posture.h"

namespace mars::motion {

// In the world: of the segments of joints for which `counts(joint)` holds, and of skins the vertices that follow such a
// joint more than any other. Patches give a few points each.
std::vector<glm::dvec3> points_of(const modeler::Model& model, const Posture& posture,
                                  const std::function<bool(std::size_t joint)>& counts);

// How far the vertices of skins that follow these joints more than any other reach from the joint `from`, drawn, along
// a direction of the model's axes; 0 where there are none.
double reach_of_skin(const modeler::Model& model, std::size_t from, const glm::dvec3& direction,
                     const std::function<bool(std::size_t joint)>& counts);

}  // namespace mars::motion
