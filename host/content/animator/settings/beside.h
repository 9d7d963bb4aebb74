// A place for an actor where it stands inside no other.
#pragma once

#include <cstdint>
#include <string>

#include "host/content/animator/pose/film.h"
#include "host/content/document/json_file.h"

namespace mars::animator {

// Moves the actor, which stands still, along y to the first place from its own on where its box meets none of the
// others' at the frame and at those before it (of long films with many actors, at some 5000 of their poses). In a
// stage, which is much larger, an actor may stand between its segments; grounds may lie in one another. `meaning` is
// what `film` was read as.
void place_beside(document::Json& film, const Film& meaning, const std::string& actor, std::uint32_t frame);

}  // namespace mars::animator
