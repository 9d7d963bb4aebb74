// Walking and turning (thesis 3.2.2, 3.2.4): plans of steps for a gait, of two legs or four.
#pragma once

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion walk(const Scene& scene);
Motion turn(const Scene& scene);

}  // namespace mars::motion
