// Makes films of compiled films: their parts as vectors, and back.
#pragma once

#include <span>

#include "host/content/film/compiled_film.h"
#include "node/wire/film.h"

namespace mars::film {

// Copies everything that is the same at all frames, and the values of tracks; leaves out matrices, changes and
// intervals.
wire::FilmData unpacked(const wire::PackedFilm& film);

// `like`: the film that `data` was copied from, whose source and counts the result has.
CompiledFilm packed(const wire::FilmData& data, std::span<const wire::Matrix> matrices, const CompiledFilm& like);

}  // namespace mars::film
