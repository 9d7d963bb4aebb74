// Joints that leave their limits between keys: those with several freedoms make the smallest turn from pose to pose,
// which may. Counted in every frame, or in the worst frame alone, which costs little.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/content/animator/pose/film.h"

namespace mars::animator {

inline constexpr double kExcessNoticed = 0.001;  // degrees outside the limits: less is rounding
inline constexpr double kExcessSeen = 0.5;       // degrees: a person sees it

// A joint in the frame in which it is farthest outside its limits.
struct WorstExcess {
  std::size_t actor, joint;  // numbers in the film, in the actor's model
  std::uint32_t frame;
  int axis;        // which it is about: 0, 1, 2; 3: skewed axes that do not reach
  double angle;    // degrees about the axis; for 3 as `outside`
  double outside;  // degrees outside the limits, or from the nearest that skewed axes reach
};

// All frames in which a joint is outside its limits by more than kExcessNoticed.
struct LimitsLeft {
  WorstExcess worst;
  std::uint32_t frames;  // how many
  std::uint32_t first, last;
};
std::vector<LimitsLeft> limits_left(const Film& film);

// The joints that leave their limits by more than kExcessSeen, in the order of the film. Looks only at frames between
// which the turn is too large to rule that out, so that it may be asked of every film before it is compiled.
std::vector<WorstExcess> worst_excesses(const Film& film);

}  // namespace mars::animator
