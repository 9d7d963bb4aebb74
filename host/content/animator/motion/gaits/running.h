// Running (after the walk of thesis 3.2.2): a gait with a flight between steps.
#pragma once

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion run(const Scene& scene);

}  // namespace mars::motion
