// What a film file holds, for people who change it by commands: by the names that the commands take.
#pragma once

#include <string>

#include "host/content/animator/pose/film.h"
#include "host/content/document/json_file.h"

namespace mars::animator {

// `film` is what `meaning` was read from.
std::string film_summary(document::Json& film, const Film& meaning);

}  // namespace mars::animator
