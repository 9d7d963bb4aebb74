// The lights of a glTF file (KHR_lights_punctual) as lights of a film (docs/importing.md has the rules).
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/content/importer/gltf/film_clock.h"

namespace mars::importer {

struct FilmLights {
  document::Json json;       // the film's "lights"; null: the file has none
  std::size_t lights = 0;    // in it
  double dimmed = 1;         // factor for all of the file's intensities
  std::size_t too_many = 0;  // that a film cannot have
};

// `middle` of what is seen at any frame, `size` of it, `factor` from metres to the film's units.
FilmLights film_lights(const std::vector<GltfLight>& lights, const NodesInFilm& nodes, const glm::dvec3& middle,
                       double size, double factor);

}  // namespace mars::importer
