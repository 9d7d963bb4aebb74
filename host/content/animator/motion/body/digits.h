// The fingers and the thumb of a hand, which the names of the joints below it tell apart: where each bends, about what,
// how far, and how thick it is.
#pragma once

#include <vector>

#include "host/content/animator/motion/body/body.h"
#include "host/content/animator/motion/body/hand.h"

namespace mars::motion {

// A part of the surface on the side to which a digit bends.
struct Pad {
  glm::dvec3 middle;  // in the phalanx' joint's frame, on the bone
  double radius;      // of the ball that touches things
};

struct Phalanx {
  std::size_t joint;
  glm::dvec3 hinge;   // a unit vector in its parent's frame, drawn: turns about it of more than 0 bend the digit
  int axis;           // of the joint, 0 to 2, if it is this hinge; else -1: several axes make the turn
  double sign;        // of the joint's own number, if it has this axis
  double open, shut;  // degrees from how it is drawn: straight, and as far as it bends
  std::vector<Pad> pads;
};

struct Digit {
  std::vector<Phalanx> phalanges;  // from the palm outwards, one at least
};

// None where no joint below the hand is named as one of a finger. Joints that move no surface are left out. A thumb
// bends towards `thing`, a place in the frame of the hand's end, other fingers towards the palm.
std::vector<Digit> digits_of(const modeler::Model& model, const Hand& hand, const glm::dvec3& thing);

// The numbers of a phalanx' joint that is bent from how it is drawn. Numbers about other axes than its own hinge stay
// as they are `now`.
glm::dvec3 bent(const modeler::Model& model, const Phalanx& phalanx, double degrees, const glm::dvec3& now);

}  // namespace mars::motion
