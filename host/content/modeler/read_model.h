// Model files (docs/model-format.md): from JSON to a Model. Every name is resolved and every range checked
// here, so that what follows may trust a Model.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "host/content/document/fields.h"
#include "host/content/modeler/model.h"

namespace mars::modeler {

// `film_materials`: names that segments may use beside the model's own. A model derived from another file names it
// from the folder of the element's document.
Model read_model(const document::Element& element, std::span<const std::string_view> film_materials = {});
Model load_model(const std::filesystem::path& path, std::span<const std::string_view> film_materials = {});

// A joint's, material's or shape's name: no longer than 100 bytes, without '/'.
std::string read_name(const document::Element& element);
std::string checked_name(const document::Element& element, std::string_view name);

}  // namespace mars::modeler
