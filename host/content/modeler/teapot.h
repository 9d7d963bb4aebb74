// Martin Newell's teapot of 1975: 32 bicubic Bezier patches, the bottom among them, z up, spout towards x,
// scaled from the bounds of its control points into the unit cube.
#pragma once

#include <vector>

#include "host/content/modeler/joint.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

// The bounds of Newell's own coordinates: as sbb, they give the teapot the size it had.
inline const Box kTeapotBounds{{-3, -2, 0}, {3.525, 2, 3.15}};

// `lid` scales the lid across; 1 is Newell's own, whose lid leaves a gap, 1.077 makes it meet the rim.
std::vector<wire::Patch> make_teapot(double lid);

}  // namespace mars::modeler
