// Sitting down: where the figure is, or on a seat of the film, to which it walks first.
#pragma once

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion sit(const Scene& scene);

}  // namespace mars::motion
