// What peers read of a film beside its triangles.
#pragma once

#include <string>

#include "node/geometry/scene.h"
#include "tests/bench/peers/mesh.h"

namespace mars::bench {

// Throws a Failure that says what the peers cannot show.
[[noreturn]] void refuse(const std::string& what, const std::string& where);

// Refuses other light than one direction, and materials that differ in more than colour.
void check_look(const wire::PackedFilm& film, const std::string& where);

// Of the scene's camera and light; counts are 0.
MeshHead head_of(const geometry::Scene& scene);

}  // namespace mars::bench
