// Who draws what: the frames asked for, cut into units of one interval each, and the machine's nodes, cut
// into cubes that take one unit after another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/cube.h"
#include "node/wire/film.h"

namespace mars::host {

// Frames of one interval for one cube: the first is the keyframe, drawn by all its nodes.
struct Unit {
  std::uint32_t interval;
  std::vector<std::uint32_t> frames;  // ascending
  std::uint64_t first_inbetween;      // inbetweens in all units before: round robin goes over the whole film
};

// `frames`: ascending, within the film. Without coherence every frame is a unit of its own.
std::vector<Unit> make_units(const node::FilmView& film, std::span<const std::uint32_t> frames, bool coherence);

// `nodes` nodes as `cubes` cubes of about equal size, side by side. 0 cubes: as many as pay, that is enough
// units for each to even out their differences (4 a cube), else one cube of all nodes as in the thesis.
std::vector<hal::Cube> make_cubes(int nodes, int cubes, std::size_t units);

}  // namespace mars::host
