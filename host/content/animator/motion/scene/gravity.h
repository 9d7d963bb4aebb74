// How quickly things fall in a film where nobody gives their gravity. A film does not say how long a metre is; its
// figures do: the legs of a man of 1.75 m are 0.835 m long.
#pragma once

#include "host/content/animator/pose/film.h"

namespace mars::motion {

inline constexpr double kGravity = 9.81;                    // metres a second and second
inline constexpr double kGravityOfLegs = kGravity / 0.835;  // for legs of length 1

// What helps say of it.
inline constexpr const char* kGravityMeaning =
    "units a second and second; default: by the longest legs of the film's figures, 9.81 where they are 0.835 long";

// Units a second and second, the same for all that falls in the film: by the longest legs of its figures on two legs.
// Without such a figure a unit is a metre.
double gravity_in(const animator::Film& film);

}  // namespace mars::motion
