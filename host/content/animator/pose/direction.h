// Directions of lights: from key to key on the great circle; on a spline by their numbers, made as long as 1.
#pragma once

#include <glm/vec3.hpp>

#include "host/content/animator/pose/channel.h"

namespace mars::animator {

// `channel` holds unit vectors, at least one. Half a turn goes about any axis across.
glm::dvec3 direction_at(const Channel<glm::dvec3>& channel, std::uint32_t frame);

}  // namespace mars::animator
