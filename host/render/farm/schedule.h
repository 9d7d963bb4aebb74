// Who draws what: the frames asked for, cut into units of one interval each, and the machine's nodes, cut
// into groups that take one unit after another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/wire/film.h"

namespace mars::host {

// Frames of one interval for one group: the first is the keyframe, drawn by all its nodes.
struct Unit {
  std::uint32_t interval;
  std::vector<std::uint32_t> frames;  // ascending
  std::uint64_t first_inbetween;      // inbetweens in all units before: round robin goes over the whole film
};

// `frames`: ascending, within the film. Without coherence every frame is a unit of its own.
std::vector<Unit> make_units(const node::FilmView& film, std::span<const std::uint32_t> frames, bool coherence);

// `nodes` nodes as `groups` groups of about equal size, side by side. 0 groups: as many as pay, that is enough
// units for each to even out their differences (4 a group), else one group of all nodes as in the thesis.
std::vector<hal::Group> make_groups(int nodes, int groups, std::size_t units);

}  // namespace mars::host
