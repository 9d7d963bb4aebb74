// Gestures: what a figure does with its head or an arm where it stands or sits.
#pragma once

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion nod(const Scene& scene);
Motion wave(const Scene& scene);

}  // namespace mars::motion
