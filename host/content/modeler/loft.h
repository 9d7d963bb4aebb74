// Surfaces lofted through rings, as the human's shapes are: tables of cross sections become the control net
// of a bicubic B-spline, periodic around and clamped at both ends, which is converted exactly to Bezier
// patches. Closed, curvature-continuous; each end is one collapsed edge in the plane of the last ring, and
// smooth. Lengths in any unit: fill_cube scales into the unit cube at last.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "host/content/modeler/bspline.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

// A cross section: an oval across the axis, half of it in front, half behind its middle.
struct Ring {
  double at;          // along the axis; tables begin at its lower end
  double front;       // depth in front of the middle
  double back;        // depth behind it
  double width;       // half, to either side
  double middle = 0;  // where the middle lies, towards the front
  double tilt = 0;    // how much further along the axis for each unit towards the front
  double square = 0;  // of the front half: 0 an ellipse, 1 nearly a rectangle
  double square_back = 0;
};

// A swelling (or, with negative height, a hollow) of some rings, symmetrical to the middle, fading to
// nothing at its bounds.
struct Swelling {
  double at;     // along the axis
  double below;  // how far it reaches there
  double above;
  double angle;   // degrees from the front, to both sides
  double reach;   // degrees
  double height;  // outward
};

// Where rings lie: front x side = axis for the outside to be outside; they need not be square.
struct LoftFrame {
  glm::dvec3 origin{0, 0, 0};
  glm::dvec3 front{1, 0, 0};
  glm::dvec3 side{0, 1, 0};
  glm::dvec3 axis{0, 0, 1};
};

// `around`: patches in a turn, at least 4; `crowding` 0..1 draws them towards the front. At least 2 rings.
struct Loft {
  std::span<const Ring> rings;
  int around = 12;
  LoftFrame frame{};
  std::span<const Swelling> swellings{};
  double crowding = 0;
};

// Adds patches in the table's unit.
void add_loft(Net& net, const Loft& loft);

// The patches scaled so that their control points fill the unit cube, axis by axis.
std::vector<wire::Patch> fill_cube(const Net& net);

}  // namespace mars::modeler
