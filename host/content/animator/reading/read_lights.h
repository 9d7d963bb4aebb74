// Lights of a film file, and its light from all around.
#pragma once

#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/document/fields.h"

namespace mars::animator {

std::vector<LightMotion> read_lights(const document::Element& list);

// One colour, or one from above and one from below.
Ambient read_ambient(const document::Element& element);

// Without a colour it has that of the background.
Fog read_fog(const document::Element& element, const glm::dvec3& background);

}  // namespace mars::animator
