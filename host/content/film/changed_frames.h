// Which frames of an edited film show something else than before. A frame's pixels are decided by the film's settings
// but its length and rate; by the camera and all lights at this frame; by each segment's shape, matrix and material at
// this frame; and by which segments move in its interval (docs/exactness.md). These are compared bit by bit. What only
// says where they lie in the film, names of segments, and where intervals begin and end decide nothing; but names
// decide the layer of identities, and the frame before that of motion.
#pragma once

#include <cstdint>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/pixel_format.h"

namespace mars::film {

// Frames of `now`, ascending, that `before` does not have, or not the same. A number that the frame's light does not
// use, such as a direction of a point light, counts too. `layers`: of the frames' files.
std::vector<std::uint32_t> changed_frames(const wire::PackedFilm& before, const wire::PackedFilm& now,
                                          wire::LayerSet layers = 0);

}  // namespace mars::film
