// What an animator would want to know of a film before it is rendered: joints that leave their limits between
// keys (those with several freedoms make the smallest turn, which may), keys behind the end, what is keyed and
// never moves, places that jump.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/animator/film.h"

namespace mars::host {

// A joint outside its limits in some frames of the film; none between frames is looked at.
struct LimitsLeft {
  std::size_t actor, joint;  // numbers in the film, in the actor's model
  std::uint32_t frames;      // so many
  std::uint32_t first, last;
  // The worst of them, and which axis it is about: 0, 1, 2; 3: skewed axes that do not reach.
  std::uint32_t worst;
  int axis;
  double angle;    // degrees about the axis; for 3 as `outside`
  double outside;  // degrees outside the limits, or from the nearest that skewed axes reach
};
std::vector<LimitsLeft> limits_left(const Film& film);

struct Findings {
  std::vector<std::string> lines;  // most with what to type
  bool trouble = false;            // something that a person would see
};
Findings check_film(const Film& film);

// One line if joints leave their limits so far that it is seen; "" if none does, or if there is so much motion that
// looking takes long.
std::string limits_remark(const Film& film);

}  // namespace mars::host
