// Gaits of figures with four legs as actions: walk and turn as people's, trot and gallop.
#pragma once

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion walk_on_four(const Scene& scene);
Motion turn_on_four(const Scene& scene);
Motion trot(const Scene& scene);  // refuses figures with two legs
Motion gallop(const Scene& scene);

}  // namespace mars::motion
