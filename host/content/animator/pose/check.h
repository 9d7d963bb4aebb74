// What an animator would want to know of a film before it is rendered: joints that leave their limits between
// keys (those with several freedoms make the smallest turn, which may), keys behind the end, what is keyed and
// never moves, places that jump, materials on which no shadow falls, sizes of lights that cast none, planes of the
// camera that do not fit what it looks at, a sound that is missing.
#pragma once

#include <string>
#include <vector>

#include "host/content/animator/pose/film.h"

namespace mars::animator {

struct Findings {
  std::vector<std::string> lines;  // most with what to type
  bool trouble = false;            // something that a person would see
};
Findings check_film(const Film& film);

// Lines to print when the film is rendered or compiled: one a joint that leaves its limits so far that it is seen, with
// what to type, ten at most and one that counts the others; and those of the camera's planes and of the sound. Quick,
// however long the film is (worst_excesses()).
std::vector<std::string> warnings_of(const Film& film);

}  // namespace mars::animator
