// Motion by kinematic laws (thesis 3.2.1), and the plain motions that scripts start: spinning and going
// straight.
#pragma once

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion fling(const Scene& scene);   // a velocity and an acceleration
Motion bounce(const Scene& scene);  // on a floor, until it lies
Motion spin(const Scene& scene);
Motion go(const Scene& scene);

}  // namespace mars::motion
