// The library of primitive shapes, as bicubic Bezier patches that fill the unit cube. Closed: every patch
// edge is the same four control points, bit for bit, in exactly one other patch, or collapsed to a point
// (poles, the middle of a cap). Outside is where d/du x d/dv points. Round things are 45 degree arcs: their
// radius is true to 4.3e-6 of itself. Axis of the round ones: z through the middle of the cube.
#pragma once

#include <vector>

#include "node/film.h"

namespace mars::host {

std::vector<node::Patch> make_box();
std::vector<node::Patch> make_sphere();
std::vector<node::Patch> make_cylinder();

// `top`: radius of the upper cap over that of the lower, 0..1; 0 ends in a point.
std::vector<node::Patch> make_cone(double top);

// `tube`: radius of the tube across, over the width of the cube, below 0.25. Its height fills the cube, so
// that an sbb of height 2 * tube * width makes it round.
std::vector<node::Patch> make_torus(double tube);

}  // namespace mars::host
