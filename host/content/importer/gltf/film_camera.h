// A camera of a glTF file as a film's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/content/importer/gltf/film_clock.h"
#include "host/content/modeler/joint.h"

namespace mars::importer {

struct FilmCamera {
  document::Json json;
  std::optional<std::array<std::uint32_t, 2>> size;  // of the picture, where the file's camera has another form of it
};

// The first camera that moves, else the first one. `cameras` is not empty; `seen`: all that is seen at any frame.
FilmCamera film_camera(const std::vector<GltfCamera>& cameras, const NodesInFilm& nodes, const modeler::Box& seen,
                       double factor);

}  // namespace mars::importer
