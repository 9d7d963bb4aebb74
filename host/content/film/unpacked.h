// Makes films of compiled films: their parts as vectors, and back.
#pragma once

#include <span>

#include "host/content/film/compiled_film.h"
#include "node/wire/film.h"

namespace mars::film {

// What is the same at all frames, and the values that tracks name, but for matrices; without intervals.
wire::FilmData unpacked(const wire::PackedFilm& film);

// `like`: what it is made of.
CompiledFilm packed(const wire::FilmData& data, std::span<const wire::Matrix> matrices, const CompiledFilm& like);

}  // namespace mars::film
