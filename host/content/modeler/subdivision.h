// Catmull-Clark surfaces (Catmull, Clark 1978), approximated by one bicubic Bezier patch for each quad of a subdivided
// cage (Loop, Schaefer 2008): exact where four quads meet in each corner; elsewhere neighbours join without a gap, and
// at the corner itself with the surface's own place. Points of open borders follow the border's B-spline; a corner that
// has one face alone is sharp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/content/modeler/control_net.h"

namespace mars::modeler {

inline constexpr int kMostLevels = 3;
inline constexpr std::size_t kMostCagePatches = 1'000'000;
inline constexpr std::size_t kMostAround = 64;  // corners of a face, faces that meet in a point: time grows as its cube

// Faces are numbers of points, counter-clockwise as seen from outside, each with 3 to kMostAround different ones.
struct Cage {
  std::size_t points = 0;
  std::vector<std::vector<std::uint32_t>> faces;
};

// What makes a cage no surface.
struct CageFault {
  std::optional<std::size_t> face;  // where it is; else at a point
  std::size_t point = 0;
  std::string problem, remedy;
};

std::optional<CageFault> fault_of(const Cage& cage);

// `cage` without fault; with level 0 of quads alone. Patches face by face.
MeanPatches subdivided(const Cage& cage, int level);

}  // namespace mars::modeler
