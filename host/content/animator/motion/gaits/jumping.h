// Jumping: from both feet to both feet, by the law of falling bodies.
#pragma once

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion jump(const Scene& scene);

}  // namespace mars::motion
