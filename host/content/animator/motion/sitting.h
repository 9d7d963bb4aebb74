// Sitting down on a seat and standing up again; feet stay where they are.
#pragma once

#include "host/content/animator/motion/scene.h"

namespace mars::motion {

Motion sit(const Scene& scene);
Motion stand(const Scene& scene);

}  // namespace mars::motion
