// A hand that swings back and forward and lets go of what it holds, which flies and bounces.
#pragma once

#include <span>

#include "host/content/animator/motion/scene/parameter.h"
#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion toss(const Scene& scene);

std::span<const Parameter> toss_parameters();

}  // namespace mars::motion
