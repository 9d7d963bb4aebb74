// The pelvis of a body that walks on legs of one piece.
#pragma once

#include <vector>

#include "host/content/animator/motion/body/stance.h"

namespace mars::motion {

// Moves the pelvis of a walk's stances, one a frame: where both feet stand, to where both legs reach them;
// between, smoothly on; always as high as the legs that stand hold it.
void stand_stiffly(const Body& body, const Posture& start, std::vector<Stance>& stances);

}  // namespace mars::motion
