// Other looks for the films of films.h: samples, light and colours for tests.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "node/wire/film.h"

namespace mars::test {

wire::FilmData with_samples(wire::FilmData film, std::uint32_t samples);

// Without lights, each segment in one of the seven pure colours that its background, magenta, is not; nothing is
// shaded: a pixel tells how many of its samples show which segment.
wire::FilmData in_pure_colors(wire::FilmData film);

// In linear light, exposed, with the filmic curve, in fog, lit from above and below and by a spot besides; the segments
// take turns with all reflection models and interpolations.
wire::FilmData richly_lit(wire::FilmData film);

// Its first lights cast shadows and are as large as said here; negative: does not cast.
wire::FilmData casting(wire::FilmData film, std::initializer_list<float> sizes);

// In parallel projection: what is as far away as the world's origin is as large as before.
wire::FilmData orthographic(wire::FilmData film);

// By widths and heights of the picture.
wire::FilmData shifted(wire::FilmData film, double right, double up);

}  // namespace mars::test
