// Sitting down on a seat behind and standing up again; feet stay where they are.
#pragma once

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion sit_down(const Scene& scene);
Motion stand(const Scene& scene);

// How far behind its ankles the hips of a figure are that sits on a seat so high above the floor, shins upright.
double hips_behind(const Scene& scene, double seat_height);

}  // namespace mars::motion
