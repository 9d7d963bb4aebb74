// Arms at rest: which figures are drawn with their arms held out, and how far beside a body arms hang.
#pragma once

#include "host/content/animator/motion/body/body.h"

namespace mars::motion {

inline constexpr double kSlimHang = 8;  // degrees from straight down of a slim body's arms

// Whether the model draws this upper arm far from hanging, as the T- and A-poses of other programs' figures do.
bool is_drawn_out(const Body& body, modeler::Side side);

// Degrees of the upper arm from straight down, to its own side, with which it hangs clear of the body: kSlimHang at
// least.
double hang_beside(const Body& body, modeler::Side side);

}  // namespace mars::motion
