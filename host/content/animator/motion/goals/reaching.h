// Limbs that go to a place, and limbs that stay at one while the rest of the figure moves.
#pragma once

#include <span>

#include "host/content/animator/motion/scene/parameter.h"
#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion reach(const Scene& scene);
Motion plant(const Scene& scene);

std::span<const Parameter> reach_parameters();
std::span<const Parameter> plant_parameters();

}  // namespace mars::motion
