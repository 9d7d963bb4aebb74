// Light for what nobody lit: a warm key from the left, before and above; a cool fill from the right; a rim from
// behind; and light from above and below.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "host/content/animator/pose/film.h"

namespace mars::animator {

// Key, fill and rim: unit directions to them, as they stand for a camera at `eye` that looks at `at`.
std::array<glm::dvec3, 3> rig_directions(const glm::dvec3& eye, const glm::dvec3& at, const glm::dvec3& up);

// The rig's lights, still, as they stand for the camera's first frame.
std::vector<LightMotion> rig_lights(const Film& film);

Ambient rig_ambient(wire::ColorSpace color);

}  // namespace mars::animator
