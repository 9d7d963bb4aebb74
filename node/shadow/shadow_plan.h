// The memory in which a node draws shadows, planned before it has any of it: by nodes, and by the host, which shares a
// node's memory out. Less memory means fewer lines at a time, and casters that are diced more often.
#pragma once

#include <cstddef>
#include <cstdint>

#include "node/wire/film.h"

namespace mars::shadow {

// What the memory depends on.
struct ShadowNeeds {
  std::uint32_t width = 0;
  std::uint32_t samples = 0;  // of a pixel
  std::uint32_t casting = 0;  // lights; 0: there are no shadows
  std::uint64_t patches = 0;  // and meshlets, of all segments
  bool has_layers = false;    // its pictures
};
ShadowNeeds shadow_needs(const wire::PackedFilm& film, bool has_layers = false);

// Bytes of each kind.
struct ShadowPlan {
  std::size_t band = 0;    // what is seen on the lines that are drawn at a time
  std::size_t points = 0;  // of some rows of the band's squares (pairs.h), on the grids of one light
  std::size_t chunk = 0;   // of casters that stream by
  std::size_t diced = 0;   // surfaces that the camera sees, so that they are not diced again
  std::size_t fixed = 0;   // whatever the memory is

  std::size_t bytes() const { return band + points + chunk + diced + fixed; }
};

// Of as many bytes as there are, but not less than is needed and not more than is of use. Nothing where no light casts.
ShadowPlan plan_shadows(const ShadowNeeds& needs, std::uint64_t bytes);
std::size_t least_shadow_bytes(const ShadowNeeds& needs);
std::size_t most_shadow_bytes(const ShadowNeeds& needs);

// A bound for one line of a band.
std::size_t band_bytes_of_line(const ShadowNeeds& needs);
// Squares whose points fit `bytes`; those of a row at least. Every other vector of points (point_vector.h) may be split
// in two, because some are far behind the others or on another grid.
std::size_t squares_of_points(const ShadowNeeds& needs, std::size_t bytes);
// And the lines of as many squares, if all squares of a line have points.
std::uint32_t lines_of_points(const ShadowNeeds& needs, std::size_t bytes);

}  // namespace mars::shadow
