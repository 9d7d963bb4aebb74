// Remarks of check.h about a film's pictures.
#pragma once

#include <string>
#include <vector>

#include "host/content/animator/pose/film.h"

namespace mars::animator {

// Adds lines of materials on which no shadow falls, and of sizes of lights that cast none.
void find_lost_shadows(const Film& film, std::vector<std::string>& lines);

// Adds lines of planes of the camera between which it does not look, or which are so far apart that shadows visibly
// stand off what casts them: a film in kilometres or millimetres with the usual planes. Quick, however long the film.
void find_unfit_planes(const Film& film, std::vector<std::string>& lines);

}  // namespace mars::animator
