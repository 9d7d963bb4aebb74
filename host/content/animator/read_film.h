// Film files (docs/film-format.md): from JSON to a Film. Every name is resolved, every range and limit
// checked.
#pragma once

#include <filesystem>
#include <span>

#include "host/content/animator/film.h"
#include "host/content/document/fields.h"

namespace mars::animator {

// Model files are found beside the film file.
Film read_film(const std::filesystem::path& path);
Film read_film(const document::Element& element, const std::filesystem::path& folder);

// What the objects of a film file may hold, as docs/schema/film.schema.json names them.
std::span<const document::Keys> film_keys();

}  // namespace mars::animator
