// Render intervals: cuts a film's frames, and lists for each interval the segments and bones that move in it.
//
// What an interval costs, counted in patches (and meshlets) rendered: its first frame all patches of the film and the
// exchange of CZB (pixels / kPixelsPerPatch); each other frame the patches of the segments that change anywhere in the
// interval after its first frame, of skins those of the bones that do, or all if camera or a light does. `automatic`
// finds the cuts of least cost by dynamic programming over the frames, with intervals of at most kLongest frames:
// O(changes + frames * kLongest). Either way an interval begins wherever the camera's exposure changes.
#pragma once

#include <cstdint>
#include <span>

#include "host/content/animator/pose/film.h"
#include "node/wire/film.h"

namespace mars::film {

inline constexpr double kPixelsPerPatch = 10000;  // pixels of CZB given to all nodes in the time of one patch
inline constexpr std::uint32_t kLongest = 4096;   // frames

// Fills the film's intervals and moving from its tracks. `keyframes`: where the animator set keys, ascending.
void cut_intervals(wire::FilmData& film, animator::Cutting cutting, std::span<const std::uint32_t> keyframes);

}  // namespace mars::film
