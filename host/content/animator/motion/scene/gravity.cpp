#include "host/content/animator/motion/scene/gravity.h"

#include <algorithm>

#include "host/content/animator/motion/body/body.h"

namespace mars::motion {

double gravity_in(const animator::Film& film) {
  double longest = 0;
  for (const animator::Actor& actor : film.actors)
    longest = std::max(longest, length_of_two_legs(film.models[actor.model]));
  return longest > 0 ? kGravityOfLegs * longest : kGravity;
}

}  // namespace mars::motion
