// What films take of glTF and GLB files, which MARS reads itself: nodes, an animation, cameras, lights.
#include <glm/mat3x3.hpp>

#include "host/content/importer/gltf/film_clock.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::gltf_film {

void take(std::string_view input) {
  const auto path = scratch().file("scene.gltf", input);
  const importer::GltfScene scene = importer::read_gltf_scene(path, "");
  const importer::FilmClock clock = importer::film_clock(path, scene, {});
  const importer::NodesInFilm nodes(scene, clock, glm::dmat3(1), 1);
  nodes.at_rest(importer::rest_of_nodes(scene, clock));
  nodes.at(clock.frames - 1);
}

const Target target("gltf_film", Form::text, take);

}  // namespace mars::fuzz::gltf_film
