// What `mars info` prints of a compiled film.
#pragma once

#include <string>

#include "host/content/film/compiled_film.h"

namespace mars::film {

std::string describe(const CompiledFilm& film);

}  // namespace mars::film
