// Film files (docs/film-format.md): from JSON to a Film. Every name is resolved, every range and limit
// checked.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/content/animator/film.h"
#include "host/content/document/fields.h"
#include "host/content/document/json_file.h"

namespace mars::animator {

// Model files are found beside the film file.
Film read_film(const std::filesystem::path& path);
Film read_film(const document::Element& element, const std::filesystem::path& folder);

// Whether films of these files have the same models, as long as nobody changes other files.
bool same_models(const document::Json& one, const document::Json& two);

// A film with the same models as one read before, whose `models` are not read again: they become the
// film's, or stay where they are if it throws.
Film read_film(const document::Element& element, std::vector<modeler::Model>& models);

}  // namespace mars::animator
