// The library of primitive shapes, as bicubic Bezier patches that fill the unit cube. Closed: every patch
// edge is the same four control points, bit for bit, in exactly one other patch, or collapsed to a point
// (poles, the middle of a cap). Outside is where d/du x d/dv points. Round things are 45 degree arcs, true
// to 4.3e-6 of their radius, a sphere, which is round twice, to 8.5e-6. Axis of the round ones: z through the
// middle of the cube. Options are shares of the cube, and so of the sbb: what is to be round in the world
// depends on both.
#pragma once

#include <array>
#include <vector>

#include "node/wire/film_parts.h"

namespace mars::modeler {

std::vector<wire::Patch> make_box();
std::vector<wire::Patch> make_sphere();
std::vector<wire::Patch> make_cylinder();

// `top`: radius of the upper cap over that of the lower, 0..1; 0 ends in a point.
std::vector<wire::Patch> make_cone(double top);

// `tube`: radius of the tube across, over the width of the cube, below 0.25. Its height fills the cube, so
// that an sbb of height 2 * tube * width makes it round.
std::vector<wire::Patch> make_torus(double tube);

// A cylinder with half an ellipsoid at either end. `ends`: the height of each over that of the cube, above 0
// to 0.5; round where that times the sbb's height is half its width.
std::vector<wire::Patch> make_capsule(double ends);

// Flat above and below, with a rim that is half a round. `rim`: its radius across over the width of the cube,
// above 0 to 0.49; like a torus's tube it fills the height, round at height 2 * rim * width.
std::vector<wire::Patch> make_disc(double rim);

// A box with rounded edges and corners. `edge`: their radius along each axis over the cube's size, above 0 to
// 0.5.
std::vector<wire::Patch> make_rounded_box(const std::array<double, 3>& edge);

}  // namespace mars::modeler
