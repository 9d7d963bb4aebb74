// The part of a film that some of its frames show: all of it, but of the T-matrices of things that move only those of
// these frames. Nodes that draw few frames of a long film need no more, and the host keeps gigabytes to itself.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "host/content/film/compiled_film.h"

namespace mars::film {

// A film of as many frames. The given frames, which ascend, and the first frames of their intervals are as in `film`,
// and so is where everything was in the frame before each. Other frames show anything. None if the excerpt is more than
// half as large as the film.
std::optional<CompiledFilm> excerpt_of(const CompiledFilm& film, std::span<const std::uint32_t> frames);

}  // namespace mars::film
