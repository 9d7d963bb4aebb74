// Panoramas: films whose camera shows all directions, in equirectangular pictures (docs/cameras.md). Nodes draw the six
// faces of a cube around the eye, square pictures in perspective, as a film of six times the frames: frame n of face f
// is frame f N + n of the film of faces, so that each face has the intervals of the panorama. host/render/panorama
// joins the faces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/content/film/compiled_film.h"
#include "node/wire/film.h"

namespace mars::film {

// Unit vectors along the camera's own axes: to the right, up, and ahead.
struct FaceAxes {
  std::array<int, 3> right, up, ahead;
};

inline constexpr std::size_t kFaces = 6;
// Ahead, right, behind, left, above, below.
inline constexpr std::array<FaceAxes, kFaces> kFaceAxes{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                         {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
                                                         {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                                                         {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
                                                         {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                                         {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}};

// Pixels of a face beyond its 90 degrees, on each side: neighbours of those at its edge.
inline constexpr std::uint32_t kFaceBorder = 1;
// Pixels of 90 degrees of a face of a panorama of this width: at least such that the middle of a face, where it has the
// fewest for an angle, has as many as the panorama has along its horizon. Even.
std::uint32_t face_pixels(std::uint32_t width);
inline std::uint32_t face_side(std::uint32_t width) { return face_pixels(width) + 2 * kFaceBorder; }

bool is_panorama(const wire::PackedFilm& film);

// Throws Failure unless the panorama is twice as wide as high, and its film of faces short enough.
void check_panorama(const CompiledFilm& panorama);
// Its film of faces. Throws Failure as check_panorama().
CompiledFilm faces_of(const CompiledFilm& panorama);
// The faces of `frames`, ascending, of a panorama of `film_frames`: their numbers in its film of faces, ascending.
std::vector<std::uint32_t> face_frames(const std::vector<std::uint32_t>& frames, std::uint32_t film_frames);

}  // namespace mars::film
